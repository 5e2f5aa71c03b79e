#pragma once
// Frames that a dump may mean in place of the one that it describes: other conventions of its camera, other meanings of
// its lights' ranges.

#include <functional>
#include <string>

#include "dump/dump_frame.h"

namespace clusterbench::dump {

// Looks at a frame; true: no further one is wanted. `change`: what differs, as "camera.forward: the other way".
using TryFrame = std::function<bool(const DumpFrame& frame, const std::string& change)>;

// Matrices transposed (both, or one alone) or inverse, the other way, another depth, mirrored; those that are cameras.
void each_other_camera(const DumpFile& dump, const TryFrame& try_frame);

// Whether most ranges may become smaller, and larger.
struct WantedRanges {
  bool smaller = true, larger = true;
};

// `frame` with its lights' ranges as other values of range.is, halved and doubled; not where lights are of a scene.
void each_other_range(const DumpFile& dump, const DumpFrame& frame, const WantedRanges& wanted,
                      const TryFrame& try_frame);

// With 4, 8 and 16 times the ranges.
void each_larger_range(const DumpFile& dump, const DumpFrame& frame, const TryFrame& try_frame);

}  // namespace clusterbench::dump
