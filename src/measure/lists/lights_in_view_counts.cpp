#include "measure/lists/lights_in_view_counts.h"

#include <algorithm>
#include <numeric>

#include "grid/lights_in_view.h"
#include "scene/digests.h"

namespace clusterbench::measure {

void add_frame(LightsInView& counts, const view::Frame& frame) {
  add_frame(counts, frame, grid::lights_in_view(frame));
}

void add_frame(LightsInView& counts, const view::Frame& frame, const std::vector<bool>& in_view) {
  const view::LightRanges ranges = frame.ranges();
  std::array<std::uint64_t, view::k_light_types> now{};
  counts.is_lit.resize(ranges.size());
  counts.is_seen.resize(ranges.size());
  for (std::uint32_t i = 0; i < ranges.size(); ++i) {
    const bool is_lit = !scene::is_dark(frame.lights[i]), is_here = in_view[i];
    now[ranges.type_of(i)] += is_here ? 1 : 0;
    counts.is_lit[i] = counts.is_lit[i] || is_lit;
    counts.is_seen[i] = counts.is_seen[i] || (is_lit && is_here);
    counts.shining_sum += is_lit && is_here ? 1 : 0;
  }
  const std::uint64_t all = std::accumulate(now.begin(), now.end(), std::uint64_t{0});
  if (counts.frames == 0 || all > counts.most) {
    counts.most = all;
    counts.frames_with_most = 0;
    counts.worst_frame = frame.index;
  }
  counts.frames_with_most += all == counts.most ? 1 : 0;
  counts.sum += all;
  ++counts.frames;
  for (std::size_t type = 0; type < now.size(); ++type)
    counts.most_of_type[type] = std::max(counts.most_of_type[type], now[type]);
}

}  // namespace clusterbench::measure
