#pragma once
// Checks the values of a record that was read from JSON against the ranges of its fields, as its schema would.

#include "result/fields.h"

namespace clusterbench::result {

// Throws Error (where: the JSON pointer below `where`) for the first value that its field does not allow.
void check_values(const Type& type, const void* record, const std::string& where = "");

template <class Record>
void check_values(const Record& record) {
  check_values(type_of<Record>(), &record);
}

}  // namespace clusterbench::result
