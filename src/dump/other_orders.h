#pragma once
// Where lights are lost: is it the description? Tries the 24 orders of cells, cameras with matrices transposed,
// looking the other way or mirrored, and other descriptions of the lists (widths of numbers, the first index, units of
// offsets).

#include <optional>

#include "dump/dump_frame.h"
#include "dump/lost_lights.h"
#include "result/documents/check.h"

namespace clusterbench::dump {

// `listed`: by the dump's own order, lights of `frame`; `found`: what is lost of them. Only a reading that loses at
// least 100 times fewer pairs, or where hardly any pair is lost 100 times fewer than are listed, and that makes more of
// the listed pairs true.
std::optional<result::OtherReading> better_reading(const DumpFile& dump, const DumpFrame& frame, const ListSet& set,
                                                   const assign::Lists& truth, const assign::Lists& listed,
                                                   const LostLights& found, int threads);

}  // namespace clusterbench::dump
