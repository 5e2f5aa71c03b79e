#pragma once
// Allocation sizes for each buffer of a light structure, from a result: the semi-conservative scheme of Persson 2015.
// An engine allocates a buffer once, so all cameras of a scene count together, and the worst frame of any of them
// decides.

#include <string>
#include <vector>

#include "report/sizing/sized_buffers.h"
#include "report/sizing/sized_structure.h"
#include "result/result.h"

namespace clusterbench::report {

// The cases that one allocation serves, and further facts.
struct AllocationScope {
  // Each names cameras drawn in one frame into one buffer: "left,right"; a name may contain *.
  std::vector<std::string> views;
  std::string grid_of;          // the only camera in one frame with a grid; "": each has its own
  bool over_viewports = false;  // one allocation for all viewports
  std::vector<FoundFrame> found;
  std::vector<GuestSamples> guests;
  std::vector<GrownTiles> grown;
};

// For all cases whose name matches the regular expression `filter` ("" = all). Results of earlier versions do not
// record single buffers: theirs are called "entries" and "header_bytes". `result` must outlive the return value. Throws
// Error if the filter is no regex or matches no case, and as set_views() does.
std::vector<SizedStructure> sized_structures(const result::Result& result, const std::string& filter,
                                             const AllocationRules& rules, const AllocationScope& scope = {});

}  // namespace clusterbench::report
