#include "run/passes/prepared_frame.h"

#include <algorithm>

namespace clusterbench::run {
namespace {

std::size_t bytes_of(const assign::Lists& lists) {
  return lists.begin.size() * sizeof(lists.begin[0]) + lists.lights.size() * sizeof(lists.lights[0]);
}

std::size_t bytes_of(const FrameSampleSet& set) {
  return set.samples.size() * sizeof(grid::Sample) + (set.picture ? set.picture->nearest.size() * sizeof(float) : 0);
}

}  // namespace

std::size_t PreparedFrame::bytes() const {
  std::size_t sum = bytes_of(truth.lists) + frame.lights.size() * 2 * sizeof(scene::WorldLight);
  if (depth) sum += depth->nearest.size() * sizeof(float);
  for (const FrameSampleSet& set : samples) sum += bytes_of(set);
  for (const std::vector<measure::NeededLights>& set : needed)
    for (const measure::NeededLights& part : set) sum += bytes_of(part.lists) + part.lux.size() * sizeof(double);
  return sum;
}

std::size_t part_count(std::span<const grid::Sample> samples) {
  return (samples.size() + k_samples_at_once - 1) / k_samples_at_once;
}
std::span<const grid::Sample> part_of(std::span<const grid::Sample> samples, std::size_t part) {
  const std::size_t begin = part * k_samples_at_once;
  return samples.subspan(begin, std::min(k_samples_at_once, samples.size() - begin));
}

}  // namespace clusterbench::run
