#pragma once
// Number of lights in view per frame: compared with an engine's light limit.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "view/frame.h"

namespace clusterbench::measure {

// Counted by grid/lights_in_view.h, over the frames of a path, before any pre-cull: depends on camera and lights only,
// not on the grid.
struct LightsInView {
  std::uint64_t frames = 0, sum = 0, shining_sum = 0;  // all lights; those that shine in the frame
  std::uint64_t most = 0, frames_with_most = 0;
  int worst_frame = 0;                                            // first frame with the maximum
  std::array<std::uint64_t, view::k_light_types> most_of_type{};  // points, spots, boxes: each in its own frame
  std::vector<bool> is_lit, is_seen;

  std::uint64_t lit() const { return static_cast<std::uint64_t>(std::ranges::count(is_lit, true)); }
  std::uint64_t seen() const { return static_cast<std::uint64_t>(std::ranges::count(is_seen, true)); }
  double mean() const { return mean_of(sum); }
  double shining_mean() const { return mean_of(shining_sum); }

 private:
  double mean_of(std::uint64_t all) const {
    return frames == 0 ? 0.0 : static_cast<double>(all) / static_cast<double>(frames);
  }
};
void add_frame(LightsInView& counts, const view::Frame& frame);
// `in_view`: grid::lights_in_view() of the frame.
void add_frame(LightsInView& counts, const view::Frame& frame, const std::vector<bool>& in_view);

}  // namespace clusterbench::measure
