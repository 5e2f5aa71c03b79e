#pragma once
// What one case's buffers need, as a result has it, and what cameras need together.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "result/case.h"

namespace clusterbench::report {

// What one camera path needs of a buffer, in elements and in the order of its frames.
struct PathNeed {
  std::string camera;                   // of cameras that share the buffer in one frame "left+right"
  std::uint64_t frames_per_entry = 1;   // above 1 each entry is the largest of so many successive frames
  std::vector<std::uint64_t> elements;  // one entry where all frames need the same; empty where the result has none
  // Seconds at which it begins and ends; none where the result does not tell.
  std::optional<std::pair<double, double>> span_s = {};

  bool is_same_in_all_frames() const { return elements.size() == 1; }
};

// A buffer of one camera's case, or of several cameras together.
struct CaseBuffer {
  std::string name;
  std::uint64_t element_bytes = 1, step = 1, high_water = 0, theoretical_max = 0, worst_frame = 0;
  std::optional<result::CellIndex> worst_cell;
  PathNeed path;
  std::uint64_t apart = 0;  // of several cameras: each at its own most at the same time
  std::string why_sum =
      {};  // why high_water is `apart`: "their paths go from 0 s to 20 s and from 0 s to 40 s"; "" where it is not
  bool has_times = true;        // it is known that frames of one number are at one time
  bool is_upper_bound = false;  // sums of the largest of several frames each
};

// All of a case. Results of earlier versions have no single buffers: theirs are called "entries" and "header_bytes".
std::vector<CaseBuffer> buffers_of(const result::Case& result_case);

// Of cameras that are drawn in the same frame into one buffer: their needs are added frame by frame. A camera that
// needs the same in all frames is added to each frame of the others; where the paths have different numbers of frames,
// or frames at other times, the marks are added. Of buffers with room for the longest list in every cell (step above 1)
// the longest list of any camera is taken for the cells of all. At least one.
CaseBuffer in_one_frame(const std::vector<CaseBuffer>& cameras);

// Of the same frames in several viewports: the largest need, frame by frame. At least one.
CaseBuffer over_viewports(const std::vector<CaseBuffer>& viewports);

}  // namespace clusterbench::report
