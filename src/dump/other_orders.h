#pragma once
// Where lights are lost, or most listed pairs are for nothing: is it the description? Tries the 24 orders of cells,
// other descriptions of the lists (widths of numbers, the first index, units of offsets), other cameras and ranges
// (other_frames.h).

#include <optional>

#include "dump/dump_frame.h"
#include "dump/lost_lights.h"
#include "result/documents/check.h"

namespace clusterbench::dump {

struct Readings {
  std::optional<result::OtherReading> better;
  // Without a better one: what is not likely enough to be one, in a sentence, as of engines that cull loosely. Empty:
  // nothing.
  std::string remark;
};

// `listed`: by the dump's own order, lights of `frame`; `found`: what is lost of them. Where ten pairs or more are
// lost, only a reading that loses at least 100 times fewer, with half as many true ones or more. Where most listed
// pairs are for nothing, also one that makes most of them true, half as many again as before, and loses at least 100
// times fewer than are listed. In either case lists with their lights in other cells, drawn by chance, would have to
// lose ten times as many. Of ranges it also has to leave three times fewer wrong pairs, lost and for nothing. A remark
// is of cameras and ranges that make ten times as many listed pairs true, and lose none.
Readings better_reading(const DumpFile& dump, const DumpFrame& frame, const ListSet& set, const assign::Lists& truth,
                        const assign::Lists& listed, const LostLights& found, int threads);

}  // namespace clusterbench::dump
