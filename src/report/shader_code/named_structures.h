#pragma once
// Sized structures with names that are valid in C++, HLSL and GLSL.

#include <cstdint>
#include <string>
#include <vector>

#include "report/sizing/sized_structure.h"
#include "result/case.h"

namespace clusterbench::report {

// Constants with which samples find their cells. Cameras whose grids are equal share them.
struct NamedLookup {
  std::string name;                        // "street_frustum_64px_lookup"
  std::vector<const result::Case*> cases;  // one per camera and viewport, with the same constants
};

// Constants depend on a viewport; a shader's function has a form for any viewport, and so is shared by all.
enum class LookupsOf : std::uint8_t { each_viewport, all_viewports };

struct NamedStructure {
  SizedStructure structure;
  std::string name;                  // "street_frustum_64px"
  std::vector<std::string> buffers;  // in the structure's order: "street_frustum_64px_indices"
  std::vector<NamedLookup> lookups;  // empty for a method's own structure, which has its own lookups
};

// Named by scene and grid, or (`in_full`) with method and storage as well. All names in the code are distinct: a number
// is added if necessary.
std::vector<NamedStructure> named_structures(std::vector<SizedStructure> structures, bool in_full, LookupsOf lookups);
// The only structure, under a name by the user. Throws Error (where = "--name") if there are several, or if the name is
// not valid in C++, HLSL or GLSL.
std::vector<NamedStructure> named_structures(std::vector<SizedStructure> structures, const std::string& name,
                                             LookupsOf lookups);

}  // namespace clusterbench::report
