#pragma once
// What a page shows of a judged dump: its cells in space, and the lists of those that lose lights.

#include <string>

#include "dump/dump_frame.h"
#include "dump/lost_lights.h"
#include "result/documents/check_page.h"

namespace clusterbench::dump {

// Lengths in metres. Without sets.
result::CheckPageFrame page_frame(const DumpFrame& frame, double metres_per_unit);

// Entries of lists that a page has room for, all frames together.
inline constexpr std::size_t k_most_page_entries = 2'000'000;

// The cells of the lost pairs that are kept, with their lists in indices of the dump. `room`: entries of lists that the
// page still takes; cells beyond it are counted.
result::CheckPageSet page_set(const std::string& name, const DumpFrame& frame, const assign::Lists& truth,
                              const assign::Lists& listed, const LostLights& lost, std::size_t& room);

// The lights that the frame's sets name.
void add_lights(const DumpFrame& frame, double metres_per_unit, result::CheckPageFrame& page);

}  // namespace clusterbench::dump
