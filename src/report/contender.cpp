#include "report/contender.h"

#include <algorithm>

#include "assign/contract/assigner.h"
#include "report/columns.h"
#include "report/json_values.h"
#include "report/limits.h"
#include "run/sweep.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string view_of(const Json& result_case) {
  return Json{result_case["camera"], result_case["viewport"]}.dump();
}

measure::Costs costs_of(const Json& result_case, RankBy by) {
  measure::Costs costs;
  const auto low = number_at(result_case, "/timing/frame_ns/ci95/0"),
             high = number_at(result_case, "/timing/frame_ns/ci95/1");
  if (low && high) costs.time_ns = {*low, *high};
  // What is drawn has no lists to be small.
  if (!draws_lights(result_case))
    costs.bytes = number_at(result_case, "/buffers/bytes/high_water").value_or(costs.k_unknown);
  if (by == RankBy::frame_time) {
    costs.overshade = limit_figure(result_case, "overshade").value_or(costs.k_unknown);
    return costs;
  }
  const double gpu_ns = number_at(result_case, "/cost/gpu_ns").value_or(costs.k_unknown);
  if (!result_case.contains("timing")) costs.time_ns = {0.0, 0.0};
  costs.time_ns.low += gpu_ns;
  costs.time_ns.high += gpu_ns;
  costs.overshade = 0.0;  // the same for all
  return costs;
}

}  // namespace

bool loses_nothing_seen(const Json& result_case) {
  const Json* lit = value_at(result_case, "/cost/lit");
  return result_case["eligible"] == true && (lit == nullptr || *lit == true);
}

int slowness_of(const Json& result_case) {
  return assign::slowness_of(result_case["assigner"]["name"].get<std::string>());
}

bool draws_lights(const Json& result_case) {
  const assign::AssignerDescriptor* assigner =
      assign::find_assigner(result_case["assigner"]["name"].get<std::string>());
  return assigner != nullptr && assigner->draws_lights;
}

bool samples_search(const Json& result_case) {
  if (result_case.value("storage", "") != run::k_own_structure) return false;
  const assign::AssignerDescriptor* assigner =
      assign::find_assigner(result_case["assigner"]["name"].get<std::string>());
  return assigner == nullptr ? result_case.value("samples_search", false) : assigner->own_is_searched();
}

bool is_at_surfaces(const std::string& assigner) {
  const assign::AssignerDescriptor* method = assign::find_assigner(assigner);
  return method != nullptr && method->at_surfaces;
}

std::string at_surfaces_text(const std::string& assigner) {
  return is_at_surfaces(assigner)
             ? "lights visible opaque surfaces alone: transparent ones, particles and fog need lists of their own"
             : "";
}

std::vector<double> frame_rounds(const Json& result_case) {
  const Json samples = result_case.value(Json::json_pointer("/timing/frame_ns/samples"), Json::array());
  if (!std::ranges::all_of(samples, [](const Json& ns) { return ns.is_number(); })) return {};
  return samples.get<std::vector<double>>();
}

std::uint64_t seed_of(const Json& result) {
  const Json seed = result["config"].value("seed", Json());
  return seed.is_number_unsigned() ? seed.get<std::uint64_t>() : 1;
}

RankBy rank_by(const Json& result) {
  return result["config"].value("rank_by", "") == "frame_cost" ? RankBy::frame_cost : RankBy::frame_time;
}

run::Contender contender_of(const Json& result_case, RankBy by) {
  run::Contender out{result_case["id"],
                     result_case["scene"],
                     view_of(result_case),
                     costs_of(result_case, by),
                     loses_nothing_seen(result_case) && !samples_search(result_case),
                     block_of(result_case),
                     {},
                     {},
                     1,
                     false};
  const double gpu_ns = by == RankBy::frame_cost ? number_at(result_case, "/cost/gpu_ns").value_or(0.0) : 0.0;
  if (by == RankBy::frame_cost) {
    const char* cost = result_case.contains("timing") ? "/cost/frame_ns" : "/cost/gpu_ns";
    out.is_eligible = out.is_eligible && number_at(result_case, cost);
  }
  if (!result_case.contains("timing")) {
    out.costs.slowness = slowness_of(result_case);
    return out;
  }
  out.rounds_ns = frame_rounds(result_case);
  for (double& ns : out.rounds_ns) ns += gpu_ns;
  out.session = result_case["timing"].value("session", "");
  out.launches = result_case["timing"].value("launches", 1);
  out.is_cold = result_case["timing"].value("caches", "warm") == "cold";
  return out;
}

}  // namespace clusterbench::report
