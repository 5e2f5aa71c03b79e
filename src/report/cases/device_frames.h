#pragma once
// The time of a frame whose samples read their lights on a device: assignment, upload and reading.

#include <vector>

#include "result/case.h"

namespace clusterbench::report {

// Computes Reading::frame_ns of each case that has a reading, and replaces an older one. A method of the processor has
// one only where config.reading.async says how much of its time the frame waits for.
void add_device_frames(std::vector<result::Case>& cases, const result::Json& config);

}  // namespace clusterbench::report
