#include "measure/truth_cells.h"

#include <atomic>
#include <cmath>

#include "core/memory.h"
#include "core/parallel.h"

namespace clusterbench::measure {

BallInSpace ball_in_space(const geom::LightVolume& volume) {
  constexpr double k_slack = 0x1p-44;
  const geom::LocalPoint center = geom::local_point(volume.apex);
  const double size = std::abs(center.at.x) + std::abs(center.at.y) + std::abs(center.at.z) + volume.range;
  return {center.at, volume.range, k_slack * size + 4.0 * center.rounding_error};
}

QuickCone::QuickCone(const geom::LightVolume& volume, const BallInSpace& ball)
    : apex(ball.center),
      axis(glm::normalize(volume.apex.rotation * volume.direction)),
      range(volume.range),
      cos_angle(std::cos(volume.half_angle_rad)),
      sin_angle(std::sin(volume.half_angle_rad)),
      slack(0x1p-30 * (std::abs(apex.x) + std::abs(apex.y) + std::abs(apex.z))) {}

Truth gathered_truth(std::size_t lights, std::uint32_t cells, int threads,
                     const std::function<LightCells(std::uint32_t light)>& find) {
  std::vector<LightCells> found(lights);
  std::atomic<std::uint64_t> runs = 0, true_pairs = 0;
  parallel_ranges(found.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t light = begin; light < end; ++light) {
      found[light] = find(static_cast<std::uint32_t>(light));
      check_memory("runs of true cells", runs += found[light].runs.size(), sizeof(LightCells::Run));
      std::uint64_t now = 0;
      for (const LightCells::Run& run : found[light].runs) now += run.count;
      check_memory("true pairs", true_pairs += now, sizeof(std::uint32_t));
    }
  });

  Truth truth;
  assign::PairBuffer pairs;
  pairs.start(cells);
  for (std::uint32_t light = 0; light < found.size(); ++light) {
    for (const LightCells::Run& run : found[light].runs) pairs.add_row(run.first_cell, run.count, light);
    truth.filter_decided += found[light].filter_decided;
    truth.exact_decided += found[light].exact_decided;
    truth.undecided += found[light].undecided;
  }
  pairs.finish(truth.lists);
  return truth;
}

}  // namespace clusterbench::measure
