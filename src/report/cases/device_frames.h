#pragma once
// The time of a frame whose samples read their lights on a device: assignment, upload and reading.

#include <string>
#include <vector>

#include "result/case.h"

namespace clusterbench::report {

// Whether samples of this set are of some of a frame's pixels alone, so that no sum with their reading is of a frame.
bool reads_a_part(const std::string& set, const result::Json& config);
// A device's time is that of its own structure or of packed lists. In another storage the same lists were put by the
// host, untimed.
bool is_converted_untimed(const result::Case& result_case);

// Computes Reading::frame_ns of each case that has a reading, and replaces an older one. None for the two above. A
// method of the processor has one only where config.reading.async says how much of its time the frame waits for.
void add_device_frames(std::vector<result::Case>& cases, const result::Json& config);

}  // namespace clusterbench::report
