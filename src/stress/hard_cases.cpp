#include "stress/hard_cases.h"

#include <algorithm>
#include <cstdlib>

namespace clusterbench::stress {

std::vector<const assign::AssignerDescriptor*> checked_methods() {
  std::vector<const assign::AssignerDescriptor*> methods;
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors())
    if (!row->on_device) methods.push_back(row);
  return methods;
}

std::span<const HardCase> hard_cases() {
  static const std::vector<HardCase> all = [] {
    std::vector<HardCase> cases;
    for (const std::vector<HardCase>& theme :
         {depth_cases(), projection_cases(), shape_cases(), list_cases(), map_cases()})
      cases.insert(cases.end(), theme.begin(), theme.end());
    std::sort(cases.begin(), cases.end(),
              [](const HardCase& a, const HardCase& b) { return std::atoi(a.id + 1) < std::atoi(b.id + 1); });
    return cases;
  }();
  return all;
}

}  // namespace clusterbench::stress
