#include "run/findings/pre_cull_meter.h"

#include <algorithm>
#include <limits>

#include "grid/lights_in_view.h"

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
  for (const cull::Step& step : pre_cull.spec().steps) {
    PreCullCounts::Step& counted = counts_.steps.emplace_back();
    counted.label = cull::label_of(step);
    counted.is_distance = std::holds_alternative<cull::DistanceStep>(step);
    if (const auto* most = std::get_if<cull::MostStep>(&step)) counted.limit = most->lights;
  }
  for (const measure::SampleSet set : sets) counts_.samples.push_back({set});
  counts_.bytes = pre_cull.bytes();
  counts_.view_cells = pre_cull.view_cells();
  counts_.build_ns = pre_cull.build_ns();
}

void PreCullMeter::add_frame(const cull::FrameCull& cull, const view::Frame& frame, bool is_conservative) {
  const std::size_t all_lights = frame.lights.size();
  is_kept_.assign(all_lights, false);
  for (const std::uint32_t light : cull.kept) is_kept_[light] = true;
  std::uint64_t distant = 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    steps_[i].add(cull.removed[i]);
    if (counts_.steps[i].is_distance) distant += cull.removed[i];
    if (cull.removed[i] > 0) ++counts_.steps[i].frames;
  }
  is_ever_dropped_.resize(all_lights, false);
  is_undropped_.assign(all_lights, true);
  for (const std::uint32_t light : cull.dropped) {
    is_ever_dropped_[light] = true;
    is_undropped_[light] = !grid::is_in_view(frame, frame.lights[light]);
  }
  kept_.add(cull.kept.size());
  removed_.add(all_lights - cull.kept.size());
  distant_.add(distant);
  counts_.conservative = counts_.conservative && is_conservative;
  ++frames_;
}

void PreCullMeter::add_samples(std::size_t set, const assign::Lists& needed) {
  counts_.samples[set].has_samples = true;
  counts_.samples[set].needed += needed.lights.size();
  counts_.samples[set].lost += entries_beside(needed, is_kept_);
}

void PreCullMeter::add_truth(const assign::Lists& truth) {
  counts_.lost_pairs += entries_beside(truth, is_kept_);
  counts_.lost_to_limits += entries_beside(truth, is_undropped_);
}

std::uint64_t PreCullMeter::entries_beside(const assign::Lists& lists, const std::vector<bool>& is_in) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(lists.lights, [&](std::uint32_t light) { return !is_in[light]; }));
}

PreCullCounts PreCullMeter::result() const {
  PreCullCounts out = counts_;
  out.kept = kept_.over(frames_);
  out.removed = removed_.over(frames_);
  out.distant = distant_.over(frames_);
  for (std::size_t i = 0; i < steps_.size(); ++i) out.steps[i].removed = steps_[i].over(frames_);
  for (std::uint32_t light = 0; light < is_ever_dropped_.size(); ++light)
    if (is_ever_dropped_[light]) out.dropped.push_back(light);
  return out;
}

}  // namespace clusterbench::run
