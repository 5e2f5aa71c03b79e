#include "measure/lights_in_view.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cull/visible_sets.h"
#include "grid/lights_in_view.h"
#include "scene/light_digest.h"

namespace clusterbench::measure {

bool is_in_view(const view::Frame& frame, const scene::WorldLight& light) {
  if (!(light.range_m > 0.0)) return false;
  scene::WorldLight ball = light;
  if (std::isfinite(light.range_m)) {
    const cull::WorldBall around = cull::ball_around(light);
    ball.position = around.center;
    ball.range_m = around.radius_m;
  }
  const Vec3d center = grid::in_view_space(frame, ball);
  return grid::may_be_in_view(frame.projection, center, ball.range_m + grid::slack_of(center, light.range_m));
}

void add_frame(LightsInView& counts, const view::Frame& frame) {
  const view::LightRanges ranges = frame.ranges();
  std::array<std::uint64_t, view::k_light_types> now{};
  counts.is_lit.resize(ranges.size());
  counts.is_seen.resize(ranges.size());
  for (std::uint32_t i = 0; i < ranges.size(); ++i) {
    const bool is_lit = !scene::is_dark(frame.lights[i]), is_here = is_in_view(frame, frame.lights[i]);
    now[ranges.type_of(i)] += is_here ? 1 : 0;
    counts.is_lit[i] = counts.is_lit[i] || is_lit;
    counts.is_seen[i] = counts.is_seen[i] || (is_lit && is_here);
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
