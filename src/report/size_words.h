#pragma once
// How tables and code tell the same of an allocation.

#include <string>
#include <vector>

#include "report/allocation.h"

namespace clusterbench::report {

// "high water x 2, rounded up to whole pages of 4 KiB".
std::string rule_text(const AllocationRules& rules);
// "camera walk, frame 11, cell [8,4,21]"; the cell's list is the longest of that frame.
std::string worst_text(const SizedBuffer& buffer);
// "2.48 %"; "-" of nothing.
std::string share_text(std::uint64_t part, std::uint64_t whole);
// What its grid's capacities rest on, such as a far end that the camera does not have: each note of its cases once.
std::vector<std::string> grid_notes(const SizedStructure& structure);
// "7 pairs dropped in 3 cells of 1 frame"; "" if none was. Of all cameras.
std::string dropped_text(const SizedStructure& structure);

}  // namespace clusterbench::report
