#include "run/pre_cull_meter.h"

#include <algorithm>
#include <limits>

namespace clusterbench::run {

void PreCullMeter::Sum::add(std::uint64_t value) {
  sum += value;
  max = std::max(max, value);
}

measure::MeanMax PreCullMeter::Sum::over(int frames) const {
  constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
  if (frames == 0) return {k_none, k_none};
  return {static_cast<double>(sum) / frames, static_cast<double>(max)};
}

PreCullMeter::PreCullMeter(const cull::PreCull& pre_cull, const std::vector<measure::SampleSet>& sets)
    : steps_(pre_cull.spec().steps.size()) {
  for (const cull::Step& step : pre_cull.spec().steps)
    counts_.steps.push_back({cull::label_of(step), std::holds_alternative<cull::DistanceStep>(step), {}});
  for (const measure::SampleSet set : sets) counts_.samples.push_back({set});
  counts_.bytes = pre_cull.bytes();
  counts_.view_cells = pre_cull.view_cells();
  counts_.build_ns = pre_cull.build_ns();
}

void PreCullMeter::add_frame(const cull::FrameCull& cull, std::uint32_t all_lights, bool is_conservative) {
  is_kept_.assign(all_lights, false);
  for (const std::uint32_t light : cull.kept) is_kept_[light] = true;
  std::uint64_t distant = 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    steps_[i].add(cull.removed[i]);
    if (counts_.steps[i].is_distance) distant += cull.removed[i];
  }
  kept_.add(cull.kept.size());
  removed_.add(all_lights - cull.kept.size());
  distant_.add(distant);
  counts_.conservative = counts_.conservative && is_conservative;
  ++frames_;
}

void PreCullMeter::add_samples(std::size_t set, const assign::Lists& needed) {
  counts_.samples[set].is_asked = true;
  counts_.samples[set].needed += needed.lights.size();
  counts_.samples[set].lost += removed_of(needed);
}

std::uint64_t PreCullMeter::removed_of(const assign::Lists& lists) const {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(lists.lights, [&](std::uint32_t light) { return !is_kept_[light]; }));
}

PreCullCounts PreCullMeter::result() const {
  PreCullCounts out = counts_;
  out.kept = kept_.over(frames_);
  out.removed = removed_.over(frames_);
  out.distant = distant_.over(frames_);
  for (std::size_t i = 0; i < steps_.size(); ++i) out.steps[i].removed = steps_[i].over(frames_);
  return out;
}

}  // namespace clusterbench::run
