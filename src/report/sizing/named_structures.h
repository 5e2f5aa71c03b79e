#pragma once
// Sized structures under names that C++, HLSL and GLSL can have.

#include <cstdint>
#include <string>
#include <vector>

#include "report/sizing/allocation.h"
#include "result/case.h"

namespace clusterbench::report {

// Constants with which samples find their cells. Cameras whose grids are equal share them.
struct NamedLookup {
  std::string name;                        // "street_frustum_64px_lookup"
  std::vector<const result::Case*> cases;  // one per camera and viewport, with the same constants
};

// Constants are of a viewport; a shader's function has a form that takes any, and so is one for all.
enum class LookupsOf : std::uint8_t { each_viewport, all_viewports };

struct NamedStructure {
  SizedStructure structure;
  std::string name;                  // "street_frustum_64px"
  std::vector<std::string> buffers;  // in the structure's order: "street_frustum_64px_indices"
  std::vector<NamedLookup> lookups;  // none of a structure of a method's own, which has lookups of its own
};

// Named by scene and grid, or (`in_full`) with method and storage, too. No two of all the names that snippets are made
// of become the same: a number is added where they would.
std::vector<NamedStructure> named_structures(std::vector<SizedStructure> structures, bool in_full, LookupsOf lookups);
// The one structure under a name of the user's. Throws Error (where = "--name") if there are others, or if C++, HLSL or
// GLSL would not take the name.
std::vector<NamedStructure> named_structures(std::vector<SizedStructure> structures, const std::string& name,
                                             LookupsOf lookups);

}  // namespace clusterbench::report
