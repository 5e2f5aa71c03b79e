#include "result/result.h"

#include "result/schema.h"

namespace clusterbench::result {

// Instantiated only here: each instance lists the fields of all records below it.
template const Type& type_of<Tool>();
template const Type& type_of<Machine>();
template const Type& type_of<Scene>();
template const Type& type_of<Case>();
template const Type& type_of<Result>();

Json result_schema() {
  return schema_of<Result>(
      "clusterbench result",
      "What `clusterbench run` writes. x-unit and x-over of a number, or of what holds it: its unit, and what it is "
      "taken "
      "over. x-written: keys that this version always writes, and that older results of the same schema_version may "
      "lack. null: not a number.");
}

}  // namespace clusterbench::result
