#pragma once
// A frame of the counting pass, as all methods of a group share it, and a method's lists of it.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "assign/contract/lists.h"
#include "depth/depth_image.h"
#include "grid/grid.h"
#include "measure/samples/lookup_check.h"
#include "measure/samples/shading.h"
#include "measure/truth/truth.h"
#include "run/cases/frame_lights.h"
#include "run/cases/frame_samples.h"
#include "view/frame.h"

namespace clusterbench::run {

struct PreparedFrame {
  int at = 0;  // its place among the frames of the pass
  view::Frame frame;
  std::shared_ptr<const grid::Grid> grid;
  bool is_new_grid = false;
  FrameLights lights;
  std::shared_ptr<const depth::DepthImage> depth;  // if a method needs it
  bool has_truth = false;
  measure::Truth truth;                 // of the grid's cells, if something is compared with it
  std::vector<FrameSampleSet> samples;  // one per set of the configuration
  // The lights that parts of the samples need, per set; none for frames with many samples (has_many_samples()).
  std::vector<std::vector<measure::NeededLights>> needed;
  std::optional<measure::LookupFrame> lookup;

  // Of the parts that grow with cells, lights and samples.
  std::size_t bytes() const;
};

// A method's lists of one frame, for those that use them while the method is at other frames.
struct ListsOfFrame {
  assign::Lists filled;                    // as the method filled them
  std::optional<assign::Lists> ascending;  // if those are not, and measures need it
  std::size_t scratch_bytes = 0;
  std::uint64_t tests_done = 0, fallbacks = 0;

  const assign::Lists& cells() const { return ascending ? *ascending : filled; }
};

// Needed lights are stored for some samples at a time: those of a full-resolution image would not fit in memory.
constexpr std::size_t k_samples_at_once = 16384;
std::size_t part_count(std::span<const grid::Sample> samples);
std::span<const grid::Sample> part_of(std::span<const grid::Sample> samples, std::size_t part);

}  // namespace clusterbench::run
