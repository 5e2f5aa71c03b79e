#include "result/documents/comparison.h"
#include "result/documents/ratios.h"
#include "result/schema.h"

namespace clusterbench::result {

// Here once: each instance lists the fields of all records below it.
template const Type& type_of<Comparison>();
template const Type& type_of<Ratios>();

Json comparison_schema() {
  return schema_of<Comparison>("clusterbench comparison",
                               "What `clusterbench compare BASE NEW --json FILE` writes. Times are nanoseconds per "
                               "frame, ratios new / base.");
}

Json ratios_schema() {
  return schema_of<Ratios>("clusterbench ratios",
                           "What `clusterbench ratio RESULT --json FILE` writes: how much longer one case takes than "
                           "another, of one result.");
}

}  // namespace clusterbench::result
