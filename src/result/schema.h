#pragma once
// JSON Schema (draft-07) of a record, made from the descriptions of its fields.

#include "result/fields.h"

namespace clusterbench::result {

// `title`, `description`: of the whole document.
Json schema_of(const Type& type, const std::string& title, const std::string& description);

template <class Record>
Json schema_of(const std::string& title, const std::string& description) {
  return schema_of(type_of<Record>(), title, description);
}

}  // namespace clusterbench::result
