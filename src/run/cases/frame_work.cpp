#include "run/cases/frame_work.h"

#include <algorithm>
#include <cmath>

#include "measure/samples/samples.h"
#include "measure/samples/shading.h"

namespace clusterbench::run {

double lights_at_a_point(const PathFrames& path, std::uint64_t seed) {
  constexpr int k_frames = 4, k_points = 256;
  const std::vector<int> some = evenly_spaced(k_frames, path.count());
  std::uint64_t reaching = 0, points = 0;
  for (const int index : some) {
    const view::Frame frame = path.frame(index);
    const std::vector<grid::Sample> samples =
        measure::volume_samples(frame, sample_far(frame, path.far_m()), k_points, seed);
    reaching += measure::lights_reaching(frame, samples).pair_count();
    points += samples.size();
  }
  return points == 0 ? 0.0 : static_cast<double>(reaching) / static_cast<double>(points);
}

int frames_within(int most, double most_lights, std::span<const scene::CameraPath> paths,
                  std::span<const double> lights_at_points) {
  constexpr int k_fewest = 6;
  double lights = 0.0;  // of one frame of each path
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (paths[i].shots.size() > 1) lights += lights_at_points[i];
  if (lights * most <= most_lights) return most;
  return std::max(std::min(k_fewest, most), static_cast<int>(most_lights / lights));
}

std::uint64_t true_pairs_about(std::uint64_t cells, double lights_at_a_point) {
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(cells) * (1.0 + lights_at_a_point)));
}

}  // namespace clusterbench::run
