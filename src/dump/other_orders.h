#pragma once
// Where lights are lost: is it the description? Tries the 24 orders of cells, and cameras with matrices transposed or
// looking the other way.

#include <optional>

#include "dump/dump_frame.h"
#include "result/documents/check.h"

namespace clusterbench::dump {

// `listed`: by the dump's own order, lights of `frame`. Only a reading that loses 100 times fewer than `lost`.
std::optional<result::OtherReading> better_reading(const DumpFile& dump, const DumpFrame& frame, const ListSet& set,
                                                   const assign::Lists& truth, const assign::Lists& listed,
                                                   std::uint64_t lost, int threads);

}  // namespace clusterbench::dump
