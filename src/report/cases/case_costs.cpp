#include "report/cases/case_costs.h"

#include <algorithm>
#include <cmath>

#include "config/presets/preset_library.h"
#include "depth/depth_image.h"
#include "measure/samples/shading.h"
#include "measure/statistics/frame_cost.h"
#include "report/cases/contender.h"
#include "result/at.h"
#include "result/rounding.h"
#include "result/sample_sets.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Buffers;
using result::Case;
using result::Cost;
using result::counted;
using result::FrameBytes;
using result::SampleSet;
using result::Time;
using result::Timing;

// The number of picture pixels that one sampled pixel stands for.
double pixels_per_sample(const Case& result_case, const std::string& set, const Json& config) {
  const Json divisor = config.value(Json::json_pointer("/samples/" + set + "/divisor"), Json());
  if (!divisor.is_number_integer()) return 1.0;
  const Vec2i viewport{static_cast<int>(result_case.viewport[0]), static_cast<int>(result_case.viewport[1])};
  return static_cast<double>(viewport.x) * viewport.y /
         static_cast<double>(depth::PixelGrid(viewport, divisor.get<int>()).count());
}

// `wave`: "8x4" or "8x8" pixels.
double divergence_of(const Case& result_case, const SampleSet& counts, const std::string& wave) {
  const int lanes = wave == "8x4" ? 32 : 64;
  if (!counts.waves || draws_lights(result_case)) return 1.0;
  for (const result::Waves& waves : *counts.waves)
    if (waves.lanes == lanes && std::isfinite(waves.divergence)) return waves.divergence;
  return 1.0;
}

double pixels_of(const Case& result_case) {
  return static_cast<double>(result_case.viewport[0]) * static_cast<double>(result_case.viewport[1]);
}

// The number of a set's samples per frame. `weight`: a number, 0 for none, or "pixels": one sample per pixel.
double shaded_in_frame(const Case& result_case, const std::string& set, const Json& weight, double samples,
                       const Json& config) {
  if (weight.is_string()) return pixels_of(result_case);
  return weight.get<double>() * samples / static_cast<double>(result_case.frames) *
         pixels_per_sample(result_case, set, config);
}

// A set of samples that the case has and that has a weight.
struct WeightedSet {
  std::string name;
  const SampleSet* counts;
  measure::ShadedSamples shaded;
};

std::vector<WeightedSet> weighted_sets(const Case& result_case, const Json& config) {
  std::vector<WeightedSet> sets;
  const Json weights = config["cost"].value("weights", Json::object());  // results of older versions lack keys
  for (const auto& [name, weight] : weights.items()) {
    const SampleSet* counts = samples_of_set(result_case, name);
    if (weight == 0.0 || counts == nullptr) continue;
    const double per_frame = shaded_in_frame(result_case, name, weight, static_cast<double>(counts->samples), config);
    sets.push_back(
        {name, counts, shaded_samples(result_case, *counts, per_frame, config["cost"].value("wave", "8x8"))});
  }
  return sets;
}

// True if points of the whole view have a weight, but the case has none: a method for visible surfaces, which lights no
// other points.
bool lacks_weighted_points(const Case& result_case, const Json& config) {
  const bool is_requested = config.contains("shading") && config["shading"].value("samples", 0) > 0;
  return is_requested && config["cost"].value(Json::json_pointer("/weights/volume"), Json(0)) != 0.0 &&
         !result_case.shading;
}

double upload_bytes(const Case& result_case) {
  return makes_lists_on_gpu(result_case)
             ? 0.0
             : result::number<&Case::buffers, &Buffers::upload_bytes, &FrameBytes::mean>(result_case).value_or(0.0);
}

double traffic_bytes(const Case& result_case) {
  return result::number<&Case::buffers, &Buffers::traffic_bytes, &FrameBytes::mean>(result_case).value_or(0.0);
}

Cost cost_of(const Case& result_case, const std::vector<WeightedSet>& sets, const Json& config) {
  const measure::CostModel model = cost_model_of(config["cost"]);
  std::vector<measure::ShadedSamples> shaded;
  Cost out;
  out.lit = !lacks_weighted_points(result_case, config);
  double samples = 0.0, given = 0.0, needed = 0.0;
  std::uint64_t all_needed = 0;  // without weights
  for (const WeightedSet& set : sets) {
    samples += set.shaded.samples;
    given += set.shaded.samples * set.shaded.lights;
    needed += set.shaded.samples * mean_per_sample(*set.counts, result::number<&SampleSet::needed>);
    all_needed += set.counts->needed;
    shaded.push_back(set.shaded);
    out.sets.emplace_back(set.name, result::SetCost{counted(set.shaded.samples), counted(set.shaded.lights),
                                                    counted(set.shaded.divergence), counted(set.shaded.reads),
                                                    counted(set.shaded.read_bytes), counted(set.shaded.ns(model))});
    out.lit = out.lit && !(set.counts->unlit > measure::k_most_unlit);
  }
  const measure::FrameCost cost = measure::frame_cost(
      model,
      makes_lists_on_gpu(result_case) ? std::nullopt
                                      : result::number<&Case::timing, &Timing::frame_ns, &Time::median>(result_case),
      upload_bytes(result_case), traffic_bytes(result_case), shaded);
  out.frame_ns = counted(cost.frame_ns().value_or(result::k_none));
  out.assign_ns = counted(cost.assign_ns.value_or(result::k_none));
  out.gpu_ns = counted(cost.gpu_ns());
  out.upload_ns = counted(cost.upload_ns);
  out.traffic_ns = counted(cost.traffic_ns);
  out.read_ns = counted(cost.read_ns);
  out.shade_ns = counted(cost.shade_ns);
  out.lights = counted(given / samples);
  out.overshade = out.lit && all_needed >= measure::k_least_needed ? counted(given / needed) : result::k_none;
  return out;
}

}  // namespace

measure::CostModel cost_model_of(const Json& constants) {
  return {constants.value("ns_per_light", 0.0), constants.value("upload_gb_per_s", 1.0),
          constants.value("memory_gb_per_s", 1.0), constants.value("ns_per_read", 0.0),
          constants.value("read_gb_per_s", 0.0)};
}

measure::ShadedSamples shaded_samples(const Case& result_case, const SampleSet& counts, double samples,
                                      const std::string& wave) {
  measure::ShadedSamples shaded;
  shaded.samples = samples;
  shaded.lights = mean_per_sample(counts, result::number<&SampleSet::evaluated>);
  shaded.divergence = divergence_of(result_case, counts, wave);
  if (draws_lights(result_case)) return shaded;
  shaded.reads = mean_per_sample(counts, result::number<&SampleSet::reads>);
  shaded.read_bytes = mean_per_sample(counts, result::number<&SampleSet::read_bytes>);
  return shaded;
}

std::optional<WholeFrame> whole_frame(const Case& result_case, const Json& config) {
  if (const auto shade_ns = result::number<&Case::cost, &Cost::shade_ns>(result_case)) {
    const Cost& cost = *result_case.cost;
    WholeFrame frame{{{},
                      result::number<&Cost::upload_ns>(cost).value_or(0.0),
                      result::number<&Cost::traffic_ns>(cost).value_or(0.0),
                      result::number<&Cost::read_ns>(cost).value_or(0.0),
                      *shade_ns},
                     cost_of_set(cost, "volume") != nullptr && cost_of_set(cost, "opaque") == nullptr};
    if (makes_lists_on_gpu(result_case)) frame.cost.upload_ns = 0.0;  // present in older results
    return frame;
  }
  if (!config.contains("cost") || !result_case.shading || result_case.shading->samples == 0) return std::nullopt;
  return WholeFrame{
      measure::frame_cost(cost_model_of(config["cost"]), {}, upload_bytes(result_case), traffic_bytes(result_case),
                          {shaded_samples(result_case, *result_case.shading, pixels_of(result_case),
                                          config["cost"].value("wave", "8x8"))}),
      true};
}

bool makes_lists_on_gpu(const Case& result_case) {
  const config::Preset* preset = config::find_preset(result_case.preset.value_or(""));
  return runs_on_device(result_case) || (preset != nullptr && preset->assigns_on_gpu());
}

void add_costs(std::vector<Case>& cases, const Json& config) {
  if (!config.contains("cost")) return;
  for (Case& result_case : cases) {
    result_case.cost.reset();
    const std::vector<WeightedSet> sets = weighted_sets(result_case, config);
    if (!sets.empty()) result_case.cost = cost_of(result_case, sets, config);
  }
}

}  // namespace clusterbench::report
