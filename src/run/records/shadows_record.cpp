// Shadows in a case's lists, and its shadow maps.

#include "run/records/parts.h"

namespace clusterbench::run {
namespace {

using result::counted;

result::BeforeAfter before_and_after(std::uint64_t before, std::uint64_t after) {
  const double removed =
      before > 0 ? counted(static_cast<double>(before - after) / static_cast<double>(before)) : result::k_none;
  return {before, after, removed};
}

result::ShadowCullSamples cull_samples_record(const measure::ShadowCullCounts& counts) {
  result::ShadowCullSamples out;
  out.samples = counts.samples;
  out.evaluated = before_and_after(counts.evaluated, counts.evaluated_kept);
  out.needed = counts.needed;
  out.lit = counts.lit;
  out.wrongly_removed = counts.wrong;
  out.lost_irradiance = counted(counts.lit_lux > 0.0 ? counts.lost_lux / counts.lit_lux : 0.0);
  return out;
}

// The settings of a shadow cull, for its counts or its times.
template <class Record>
Record way_record(const config::ShadowCullRequest& request) {
  Record out;
  out.resolution = static_cast<std::uint64_t>(request.resolution);
  out.texels = depth::name_of(request.texels);
  out.bias_m = counted(request.bias_m);
  out.near_m = counted(request.near_m);
  return out;
}

result::ShadowCull cull_record(const ShadowCullResult& cull) {
  auto out = way_record<result::ShadowCull>(cull.request);
  out.conservative = cull.request.texels == depth::TexelBound::proven;
  out.pairs = before_and_after(cull.counts.pairs, cull.counts.kept);
  if (cull.has_truth) out.true_pairs = before_and_after(cull.counts.true_pairs, cull.counts.true_kept);
  if (cull.has_samples) out.opaque = cull_samples_record(cull.counts);
  out.maps = {cull.maps.lights, cull.maps.made,      cull.maps.faces,
              cull.maps.texels, cull.maps.unlimited, cull.maps.bytes};
  return out;
}

result::MeanMax mean_most(const measure::MeanMost& numbers) {
  return {counted(numbers.mean()), numbers.count > 0 ? counted(numbers.most) : result::k_none};
}

result::SharedFrusta frusta_record(const SharedFrustaResult& shared) {
  const measure::SharingCounts& counts = shared.counts;
  result::SharedFrusta out;
  out.apart_m = counted(shared.request.apart_m);
  out.turned_deg = counted(shared.request.turned_deg);
  out.growth = counted(shared.request.growth);
  out.points = mean_most(counts.points);
  out.spots = mean_most(counts.spots);
  out.maps = mean_most(counts.maps);
  out.shared = mean_most(counts.shared);
  out.saved = counted(counts.saved());
  out.most_members = static_cast<std::uint64_t>(counts.most_members);
  out.volume = {mean_most(counts.volume_over_largest), mean_most(counts.volume_over_sum)};
  out.solid_angle = {mean_most(counts.angle_over_largest), mean_most(counts.angle_over_sum)};
  return out;
}

}  // namespace

std::optional<result::Shadows> shadows_record(const CaseResult& found) {
  if (found.shadow_culls.empty() && !found.shared_frusta) return {};
  std::vector<result::ShadowCull> culls;
  for (const ShadowCullResult& cull : found.shadow_culls) culls.push_back(cull_record(cull));
  result::Shadows out;
  if (!culls.empty()) out.culls = std::move(culls);
  if (found.shared_frusta) out.frusta = frusta_record(*found.shared_frusta);
  return out;
}

std::vector<result::ShadowCullTimes> shadow_times_record(const std::vector<ShadowCullResult>& culls) {
  using result::measured;
  std::vector<result::ShadowCullTimes> all;
  for (const ShadowCullResult& cull : culls) {
    auto out = way_record<result::ShadowCullTimes>(cull.request);
    out.cast_ns = measured(cull.times.cast_ns);
    out.reduce_ns = measured(cull.times.reduce_ns);
    out.step_ns = {measured(cull.times.step_mean_ns), measured(cull.times.step_max_ns)};
    all.push_back(out);
  }
  return all;
}

}  // namespace clusterbench::run
