#include "assign/storage.h"

namespace clusterbench::assign {

// One per file in storages/.
extern const StorageRow packed_row, fixed_row, bitfield_row, linked_row;

std::span<const StorageRow* const> storage_rows() {
  static constexpr const StorageRow* k_rows[] = {&packed_row, &fixed_row, &bitfield_row, &linked_row};
  return k_rows;
}

const StorageRow* find_storage(const std::string& name) {
  for (const StorageRow* row : storage_rows())
    if (row->name == name) return row;
  return nullptr;
}

std::vector<std::string> storage_names() {
  std::vector<std::string> names;
  for (const StorageRow* row : storage_rows()) names.push_back(row->name);
  return names;
}

}  // namespace clusterbench::assign
