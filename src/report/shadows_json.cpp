#include "report/shadows_json.h"

#include <limits>

#include "report/json_values.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

double share_of(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : std::numeric_limits<double>::quiet_NaN();
}

Json before_and_after(std::uint64_t before, std::uint64_t after) {
  return {{"before", before}, {"after", after}, {"removed", number_or_null(share_of(before - after, before))}};
}

Json samples(const measure::ShadowCullCounts& counts) {
  const double lost = counts.lit_lux > 0.0 ? counts.lost_lux / counts.lit_lux : 0.0;
  return {{"samples", counts.samples},       {"evaluated", before_and_after(counts.evaluated, counts.evaluated_kept)},
          {"needed", counts.needed},         {"lit", counts.lit},
          {"wrongly_removed", counts.wrong}, {"lost_irradiance", number_or_null(lost)}};
}

Json way(const config::ShadowCullRequest& request) {
  return {{"resolution", request.map.resolution},
          {"texels", depth::name_of(request.map.bound)},
          {"bias_m", number_or_null(request.bias_m)},
          {"near_m", number_or_null(request.map.near_m)}};
}

Json cull(const run::ShadowCullResult& result) {
  Json out = way(result.request);
  out["conservative"] = result.request.map.bound == depth::TexelBound::proven;
  out["pairs"] = before_and_after(result.counts.pairs, result.counts.kept);
  if (result.has_truth) out["true_pairs"] = before_and_after(result.counts.true_pairs, result.counts.true_kept);
  if (result.has_samples) out["opaque"] = samples(result.counts);
  out["maps"] = {{"lights", result.maps.lights}, {"made", result.maps.made},           {"faces", result.maps.faces},
                 {"texels", result.maps.texels}, {"unlimited", result.maps.unlimited}, {"bytes", result.maps.bytes}};
  return out;
}

Json mean_max(const measure::MeanMost& numbers) {
  return {{"mean", number_or_null(numbers.mean())},
          {"max", numbers.count > 0 ? number_or_null(numbers.most) : Json(nullptr)}};
}

Json frusta(const run::SharedFrustaResult& result) {
  const measure::SharingCounts& counts = result.counts;
  return {{"apart_m", number_or_null(result.request.apart_m)},
          {"turned_deg", number_or_null(result.request.turned_deg)},
          {"growth", number_or_null(result.request.growth)},
          {"points", mean_max(counts.points)},
          {"spots", mean_max(counts.spots)},
          {"maps", mean_max(counts.maps)},
          {"shared", mean_max(counts.shared)},
          {"saved", number_or_null(counts.saved())},
          {"most_members", counts.most_members},
          {"volume",
           {{"over_largest", mean_max(counts.volume_over_largest)}, {"over_sum", mean_max(counts.volume_over_sum)}}},
          {"solid_angle",
           {{"over_largest", mean_max(counts.angle_over_largest)}, {"over_sum", mean_max(counts.angle_over_sum)}}}};
}

}  // namespace

Json shadows_to_json(const run::CaseResult& case_result) {
  Json out = Json::object();
  if (!case_result.shadow_culls.empty()) {
    out["culls"] = Json::array();
    for (const run::ShadowCullResult& result : case_result.shadow_culls) out["culls"].push_back(cull(result));
  }
  if (case_result.shared_frusta) out["frusta"] = frusta(*case_result.shared_frusta);
  return out;
}

Json shadow_times_to_json(const std::vector<run::ShadowCullResult>& culls) {
  Json out = Json::array();
  for (const run::ShadowCullResult& result : culls) {
    out.push_back(way(result.request));
    out.back()["cast_ns"] = six_digits(result.times.cast_ns);
    out.back()["reduce_ns"] = six_digits(result.times.reduce_ns);
    out.back()["step_ns"] = {{"mean", six_digits(result.times.step_mean_ns)},
                             {"max", six_digits(result.times.step_max_ns)}};
  }
  return out;
}

}  // namespace clusterbench::report
