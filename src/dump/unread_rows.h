#pragma once
// Rows of a buffer that the description leaves unread, as where it has too few cells.

#include <string>
#include <vector>

#include "dump/dump_frame.h"

namespace clusterbench::dump {

// A sentence for each buffer of the set that has notably more rows than there are cells (or tiles, or slices): twice as
// many, or 256 bytes beyond them, which no alignment explains. Buffers that hold several things are passed over.
std::vector<std::string> unread_rows(const DumpFile& dump, const ListSet& set, Vec3i cells);

}  // namespace clusterbench::dump
