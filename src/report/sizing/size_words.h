#pragma once
// Texts on an allocation that tables and code share.

#include <string>
#include <vector>

#include "report/sizing/allocation.h"

namespace clusterbench::report {

// "high water x 2, rounded up to whole pages of 4 KiB"; with searches "the larger of high water and find x 2, ...".
std::string rule_text(const AllocationRules& rules, bool is_searched = false);
// The same for one buffer, which may be sized by a search's finding: "found by the search x 2, rounded up ...".
std::string rule_text(const SizedBuffer& buffer, const AllocationRules& rules);
// "camera walk, frame 11, cell [8,4,21]"; the cell's list is the longest of that frame.
std::string worst_text(const SizedBuffer& buffer);
// "2.48 %"; "-" if the whole is 0.
std::string share_text(std::uint64_t part, std::uint64_t whole);
// Notes on its grid that affect the capacities, such as a far end that the camera does not have: each note of its cases
// once.
std::vector<std::string> grid_notes(const SizedStructure& structure);

// Notes on the effect of reached limits on its lists: lights removed from frames, tiles that grew because lists were
// full. The capacities are those after this effect. Each note of its cases once.
std::vector<std::string> limit_notes(const SizedStructure& structure);

// One basis of a capacity: a line with its label.
struct MarkLine {
  std::string label, text;
};
// The largest need seen, the largest found by a search, the estimate beyond the path, and the upper bound, each with
// its own text. Empty for a buffer that cannot overflow.
std::vector<MarkLine> mark_lines(const SizedBuffer& buffer, const SizedStructure& structure);

// "5000 frames tried (seed 1, --keep-height)" for a search that was made, and "at (1, 2, 3) m along (0, 0, -1)" for the
// worst frame that it found.
std::string tried_text(const FoundFrame& found);
std::string place_text(const FoundFrame& found);

// Lights missed at samples of cameras without their own grid: a line each, and whether any camera misses some.
std::vector<std::string> guest_lines(const SizedStructure& structure);
// Whether some camera misses more than measure::k_most_unlit of the lights that its samples need.
bool lack_lights(const std::vector<GuestSamples>& guests);

// Why the counted frames say little about frames with lights: no light was ever in view, or no list had one; "" if some
// did.
std::string nothing_seen_text(const SizedStructure& structure);
// As above, and no search found any: the capacity would have no basis.
bool is_sized_from_nothing(const SizedStructure& structure);

// "7 pairs dropped in 3 cells of 1 frame"; "" if none was. Over all cameras.
std::string dropped_text(const SizedStructure& structure);

}  // namespace clusterbench::report
