#pragma once
// The buffer needs of one case, as a result records them, and of several cameras together.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "result/case.h"

namespace clusterbench::report {

// The need of one camera path for a buffer, in elements and in the order of its frames.
struct PathNeed {
  std::string camera;                   // for cameras that share the buffer in one frame "left+right"
  std::uint64_t frames_per_entry = 1;   // above 1 each entry is the maximum of that many consecutive frames
  std::vector<std::uint64_t> elements;  // one entry if all frames need the same; empty if the result has none
  // Start and end in seconds; none if the result does not record them.
  std::optional<std::pair<double, double>> span_s = {};

  bool is_same_in_all_frames() const { return elements.size() == 1; }
};

// A buffer of one camera's case, or of several cameras together.
struct CaseBuffer {
  std::string name;
  std::uint64_t element_bytes = 1, step = 1, high_water = 0, theoretical_max = 0, worst_frame = 0;
  std::optional<result::CellIndex> worst_cell;
  PathNeed path;
  std::uint64_t apart = 0;  // for several cameras: the sum if each had its maximum at the same time
  std::string why_sum =
      {};  // why high_water is `apart`: "their paths go from 0 s to 20 s and from 0 s to 40 s"; "" where it is not
  bool has_times = true;        // frames of the same index are known to be at the same time
  bool is_upper_bound = false;  // each is a sum of maxima over several frames
};

// All buffers of a case. Results of earlier versions do not record single buffers: theirs are called "entries" and
// "header_bytes".
std::vector<CaseBuffer> buffers_of(const result::Case& result_case);

// For cameras that are drawn in the same frame into one buffer: adds their needs frame by frame. A camera with the same
// need in all frames is added to each frame of the others; if the paths have different numbers of frames, or frames at
// other times, the marks are added. For buffers with room for the longest list in every cell (step above 1) all cells
// get the longest list of any camera. Needs at least one camera.
CaseBuffer in_one_frame(const std::vector<CaseBuffer>& cameras);

// For the same frames in several viewports: the largest need, frame by frame. Needs at least one viewport.
CaseBuffer over_viewports(const std::vector<CaseBuffer>& viewports);

}  // namespace clusterbench::report
