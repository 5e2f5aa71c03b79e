#include "report/frame_cost.h"

#include <algorithm>
#include <cmath>

#include "config/presets.h"
#include "depth/depth_image.h"
#include "measure/frame_cost.h"
#include "measure/shading.h"
#include "report/contender.h"
#include "report/json_values.h"
#include "report/result_json.h"
#include "report/sample_sets.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// Of the picture's pixels one that is looked through stands for so many.
double pixels_per_sample(const Json& result_case, const std::string& set, const Json& config) {
  const Json divisor = config.value(Json::json_pointer("/samples/" + set + "/divisor"), Json());
  if (!divisor.is_number_integer()) return 1.0;
  const Vec2i viewport{result_case["viewport"][0].get<int>(), result_case["viewport"][1].get<int>()};
  return static_cast<double>(viewport.x) * viewport.y /
         static_cast<double>(depth::PixelGrid(viewport, divisor.get<int>()).count());
}

// `wave`: "8x4" or "8x8" pixels.
double divergence_of(const Json& result_case, const Json& counts, const std::string& wave) {
  const int lanes = wave == "8x4" ? 32 : 64;
  if (!counts.contains("waves") || draws_lights(result_case)) return 1.0;
  for (const Json& waves : counts["waves"])
    if (waves["lanes"] == lanes && waves["divergence"].is_number()) return waves["divergence"].get<double>();
  return 1.0;
}

double pixels_of(const Json& result_case) {
  return result_case["viewport"][0].get<double>() * result_case["viewport"][1].get<double>();
}

// How many of a set's samples a frame shades. `weight`: a number, 0 for none, or "pixels": each of the picture's once.
double shaded_in_frame(const Json& result_case, const std::string& set, const Json& weight, double samples,
                       const Json& config) {
  if (weight.is_string()) return pixels_of(result_case);
  return weight.get<double>() * samples / result_case["frames"].get<double>() *
         pixels_per_sample(result_case, set, config);
}

double mean_per_sample(const Json& counts, const char* key) {
  const auto samples = counts["samples"].get<double>();
  return samples > 0.0 ? counts.value(key, 0.0) / samples : 0.0;
}

// With the set's name; those that are there and have a weight.
struct WeightedSet {
  std::string name;
  const Json* counts;
  measure::ShadedSamples shaded;
};

std::vector<WeightedSet> weighted_sets(const Json& result_case, const Json& config) {
  std::vector<WeightedSet> sets;
  for (const auto& [name, weight] : config["cost"]["weights"].items()) {
    const Json* counts = samples_of_set(result_case, name);
    if (weight == 0.0 || counts == nullptr) continue;
    const double per_frame = shaded_in_frame(result_case, name, weight, (*counts)["samples"].get<double>(), config);
    sets.push_back(
        {name, counts, shaded_samples(result_case, *counts, per_frame, config["cost"]["wave"].get<std::string>())});
  }
  return sets;
}

// Points of the whole view that have a weight, and that a method of visible surfaces does not have: it lights none.
bool lacks_weighted_points(const Json& result_case, const Json& config) {
  const bool is_asked = config.contains("shading") && config["shading"].value("samples", 0) > 0;
  return is_asked && config["cost"]["weights"].value("volume", Json(0)) != 0.0 &&
         samples_of_set(result_case, "volume") == nullptr;
}

double upload_bytes(const Json& result_case) {
  return makes_lists_on_gpu(result_case) ? 0.0 : number_at(result_case, "/buffers/upload_bytes/mean").value_or(0.0);
}

// A set that a case is ranked by; shaded: how many of its samples a frame shades.
struct RankingSet {
  const Json* counts;
  double shaded;
};

std::vector<RankingSet> ranking_sets(const Json& result_case) {
  std::vector<RankingSet> sets;
  const Json* paid = value_at(result_case, "/cost/sets");
  const bool is_paid = paid != nullptr && !paid->empty();
  for (const std::string& name : ranking_set_names(result_case))
    sets.push_back({samples_of_set(result_case, name),
                    is_paid ? number_at(result_case, "/cost/sets/" + name + "/samples").value_or(0.0) : 1.0});
  return sets;
}

Json cost_of(const Json& result_case, const std::vector<WeightedSet>& sets, const Json& config) {
  const measure::CostModel model = cost_model_of(config["cost"]);
  std::vector<measure::ShadedSamples> shaded;
  Json sets_json = Json::object();
  bool is_lit = !lacks_weighted_points(result_case, config);
  double samples = 0.0, given = 0.0, needed = 0.0, counted = 0.0;
  for (const WeightedSet& set : sets) {
    samples += set.shaded.samples;
    given += set.shaded.samples * set.shaded.lights;
    needed += set.shaded.samples * mean_per_sample(*set.counts, "needed");
    counted += number_at(*set.counts, "/needed").value_or(0.0);
    shaded.push_back(set.shaded);
    sets_json[set.name] = {
        {"samples", number_or_null(set.shaded.samples)},       {"lights", number_or_null(set.shaded.lights)},
        {"divergence", number_or_null(set.shaded.divergence)}, {"reads", number_or_null(set.shaded.reads)},
        {"read_bytes", number_or_null(set.shaded.read_bytes)}, {"ns", number_or_null(set.shaded.ns(model))}};
    const Json& unlit = (*set.counts)["unlit"];
    is_lit = is_lit && !(unlit.is_number() && unlit.get<double>() > measure::k_most_unlit);
  }
  const measure::FrameCost cost = measure::frame_cost(
      model, makes_lists_on_gpu(result_case) ? std::nullopt : number_at(result_case, "/timing/frame_ns/median"),
      upload_bytes(result_case), number_at(result_case, "/buffers/traffic_bytes/mean").value_or(0.0), shaded);
  const bool is_known = is_lit && counted >= static_cast<double>(measure::k_least_needed);
  const auto or_null = [](const std::optional<double>& ns) { return ns ? number_or_null(*ns) : Json(); };
  return {{"frame_ns", or_null(cost.frame_ns())},
          {"assign_ns", or_null(cost.assign_ns)},
          {"gpu_ns", number_or_null(cost.gpu_ns())},
          {"upload_ns", number_or_null(cost.upload_ns)},
          {"traffic_ns", number_or_null(cost.traffic_ns)},
          {"read_ns", number_or_null(cost.read_ns)},
          {"shade_ns", number_or_null(cost.shade_ns)},
          {"lights", number_or_null(given / samples)},
          {"overshade", is_known ? number_or_null(given / needed) : Json()},
          {"sets", sets_json},
          {"lit", is_lit}};
}

}  // namespace

measure::CostModel cost_model_of(const Json& constants) {
  return {constants.value("ns_per_light", 0.0), constants.value("upload_gb_per_s", 1.0),
          constants.value("memory_gb_per_s", 1.0), constants.value("ns_per_read", 0.0),
          constants.value("read_gb_per_s", 0.0)};
}

measure::ShadedSamples shaded_samples(const Json& result_case, const Json& counts, double samples,
                                      const std::string& wave) {
  measure::ShadedSamples shaded;
  shaded.samples = samples;
  shaded.lights = mean_per_sample(counts, "evaluated");
  shaded.divergence = divergence_of(result_case, counts, wave);
  if (draws_lights(result_case)) return shaded;
  shaded.reads = mean_per_sample(counts, "reads");
  shaded.read_bytes = mean_per_sample(counts, "read_bytes");
  return shaded;
}

std::optional<WholeFrame> whole_frame(const Json& result_case, const Json& config) {
  if (number_at(result_case, "/cost/shade_ns")) {
    const auto part = [&](const char* pointer) { return number_at(result_case, pointer).value_or(0.0); };
    const Json& sets = result_case["cost"]["sets"];
    WholeFrame frame{
        {{}, part("/cost/upload_ns"), part("/cost/traffic_ns"), part("/cost/read_ns"), part("/cost/shade_ns")},
        sets.contains("volume") && !sets.contains("opaque")};
    if (makes_lists_on_gpu(result_case)) frame.cost.upload_ns = 0.0;  // older results have it
    return frame;
  }
  const std::optional<double> samples = number_at(result_case, "/shading/samples");
  if (!config.contains("cost") || !samples || *samples == 0.0) return std::nullopt;
  return WholeFrame{measure::frame_cost(cost_model_of(config["cost"]), {}, upload_bytes(result_case),
                                        number_at(result_case, "/buffers/traffic_bytes/mean").value_or(0.0),
                                        {shaded_samples(result_case, result_case["shading"], pixels_of(result_case),
                                                        config["cost"].value("wave", "8x8"))}),
                    true};
}

bool makes_lists_on_gpu(const Json& result_case) {
  const config::Preset* preset = config::find_preset(result_case.value("preset", ""));
  return preset != nullptr && preset->assigns_on == config::AssignsOn::gpu;
}

std::vector<const Json*> ranking_samples(const Json& result_case) {
  std::vector<const Json*> all;
  for (const RankingSet& set : ranking_sets(result_case)) all.push_back(set.counts);
  return all;
}

double sum_at_samples(const Json& result_case, const char* count) {
  double sum = 0.0;
  for (const Json* set : ranking_samples(result_case)) sum += set->value(count, 0.0);
  return sum;
}

std::optional<double> unlit_at_samples(const Json& result_case) {
  const Json* most = most_at_sets(result_case, "/unlit");
  return most != nullptr ? number_at(*most, "/unlit") : std::nullopt;
}

std::optional<double> mean_at_samples(const Json& result_case, const char* count) {
  double sum = 0.0, shaded = 0.0;
  for (const RankingSet& set : ranking_sets(result_case)) {
    if (!set.counts->contains(count)) return std::nullopt;
    sum += set.shaded * mean_per_sample(*set.counts, count);
    shaded += set.shaded;
  }
  return shaded > 0.0 ? std::optional(sum / shaded) : std::nullopt;
}

void add_costs(Json& cases, const Json& config) {
  if (!config.contains("cost")) return;
  for (Json& result_case : cases) {
    result_case.erase("cost");
    const std::vector<WeightedSet> sets = weighted_sets(result_case, config);
    if (!sets.empty()) result_case["cost"] = cost_of(result_case, sets, config);
  }
}

}  // namespace clusterbench::report
