#include <algorithm>

#include "assign/assigner.h"

namespace clusterbench::assign {

#define CLUSTERBENCH_ASSIGNER(file) extern const AssignerRow file##_row;
#include "assign/registry.inc"
#undef CLUSTERBENCH_ASSIGNER

bool AssignerRow::takes(grid::Kind kind) const {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

bool is_conservative(const AssignerRow& row, const Params& params) {
  const auto inflation = params.values().find("inflation");
  return row.conservative && (inflation == params.values().end() || std::get<double>(inflation->second) >= 1.0);
}

std::span<const AssignerRow* const> assigner_rows() {
#define CLUSTERBENCH_ASSIGNER(file) &file##_row,
  static constexpr const AssignerRow* k_rows[] = {
#include "assign/registry.inc"
  };
#undef CLUSTERBENCH_ASSIGNER
  return k_rows;
}

const AssignerRow* find_assigner(const std::string& name) {
  for (const AssignerRow* row : assigner_rows())
    if (row->name == name) return row;
  return nullptr;
}

std::vector<std::string> assigner_names() {
  std::vector<std::string> names;
  for (const AssignerRow* row : assigner_rows()) names.push_back(row->name);
  return names;
}

std::vector<std::string> standard_assigner_names() {
  std::vector<std::string> names;
  for (const AssignerRow* row : assigner_rows())
    if (!row->naive) names.push_back(row->name);
  return names;
}

}  // namespace clusterbench::assign
