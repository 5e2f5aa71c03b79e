#pragma once
// How tables and code tell the same of an allocation.

#include <string>
#include <vector>

#include "report/sizing/allocation.h"

namespace clusterbench::report {

// "high water x 2, rounded up to whole pages of 4 KiB"; with searches "the larger of high water and find x 2, ...".
std::string rule_text(const AllocationRules& rules, bool is_searched = false);
// The same of one buffer, which may be sized by what a search found: "found by the search x 2, rounded up ...".
std::string rule_text(const SizedBuffer& buffer, const AllocationRules& rules);
// "camera walk, frame 11, cell [8,4,21]"; the cell's list is the longest of that frame.
std::string worst_text(const SizedBuffer& buffer);
// "2.48 %"; "-" of nothing.
std::string share_text(std::uint64_t part, std::uint64_t whole);
// What its grid's capacities rest on, such as a far end that the camera does not have: each note of its cases once.
std::vector<std::string> grid_notes(const SizedStructure& structure);

// What limits of its own make of its lists, where they were reached: lights that a frame may not have, tiles that grow
// for want of room. The capacities are then those of what is left. Each note of its cases once.
std::vector<std::string> limit_notes(const SizedStructure& structure);

// What a capacity rests on: a line each with its label.
struct MarkLine {
  std::string label, text;
};
// The most seen, the most that a search found, what is beyond the path, and the most that can be; each in its own
// words. None of a buffer of which nothing can overflow.
std::vector<MarkLine> mark_lines(const SizedBuffer& buffer, const SizedStructure& structure);

// "5000 frames tried (seed 1, --keep-height)" of a search that was made, and "at (1, 2, 3) m along (0, 0, -1)" of the
// worst frame that it found.
std::string tried_text(const FoundFrame& found);
std::string place_text(const FoundFrame& found);

// What samples of cameras without a grid of their own lack: a line each, and whether any lack lights.
std::vector<std::string> guest_lines(const SizedStructure& structure);
// More than measure::k_most_unlit of those that samples of some camera need.
bool lack_lights(const std::vector<GuestSamples>& guests);

// Why the frames that were counted say nothing of what frames with lights need: no light was ever in view, or no list
// had one; "" where some did.
std::string nothing_seen_text(const SizedStructure& structure);
// The same, and nothing else was found either: a capacity would be one of nothing.
bool is_sized_from_nothing(const SizedStructure& structure);

// "7 pairs dropped in 3 cells of 1 frame"; "" if none was. Of all cameras.
std::string dropped_text(const SizedStructure& structure);

}  // namespace clusterbench::report
