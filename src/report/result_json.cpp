#include "report/result_json.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "report/conclusion.h"
#include "report/contender.h"
#include "report/frame_cost.h"
#include "report/json_values.h"
#include "report/machine.h"
#include "report/nothing_seen.h"
#include "report/preset_ranking.h"
#include "report/sample_sets.h"
#include "result/rounding.h"
#include "run/gate.h"
#include "run/records/records.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// Pairs per frame against the same case in float32; null where there is none.
void add_extra_pairs(Json& cases) {
  std::map<std::string, double> pairs;
  for (const Json& result_case : cases)
    pairs[result_case["name"].get<std::string>()] =
        number_at(result_case, "/occupancy/pairs/mean").value_or(std::nan(""));
  for (Json& result_case : cases) {
    if (!result_case.contains("precision")) continue;
    const std::string name = result_case["name"], label = "/" + result_case["precision"]["label"].get<std::string>();
    const bool is_packed = result_case["precision"]["packing"] != "float32";
    const auto plain = pairs.find(is_packed ? name.substr(0, name.size() - label.size()) : name);
    const double mean = plain == pairs.end() ? std::nan("") : plain->second, extra = pairs[name] - mean;
    result_case["precision"]["extra_pairs"] = {{"mean", number_or_null(extra)},
                                               {"ratio", number_or_null(extra / mean)}};
  }
}

Json in_plan_order(const run::Result& result, const std::vector<Json>& earlier_cases) {
  std::map<std::string, Json> by_id;
  for (const Json& result_case : earlier_cases) by_id[result_case.at("id").get<std::string>()] = result_case;
  for (const run::CaseResult& case_result : result.cases) by_id[case_result.id] = case_to_json(case_result);
  Json cases = Json::array();
  for (const std::string& id : result.planned_ids)
    if (const auto found = by_id.find(id); found != by_id.end()) cases.push_back(found->second);
  return cases;
}

}  // namespace

Json six_digits(double value) {
  return number_or_null(result::measured(value));
}

Json fronts(const Json& scenes, const Json& cases, const Json& origin) {
  std::vector<run::Contender> all;
  std::set<std::string> unknown = ids_of_nothing_seen(cases);
  unknown.merge(ids_without_samples(cases));
  for (const Json& result_case : cases)
    if (!unknown.contains(result_case["id"].get<std::string>()))
      all.push_back(contender_of(result_case, rank_by(origin)));
  const std::vector<std::string> ids = run::on_front(all, seed_of(origin));
  const std::set<std::string> best(ids.begin(), ids.end());
  Json list = Json::array();
  for (const Json& scene : scenes) {
    Json front = Json::array();
    for (const Json& result_case : cases)
      if (result_case["scene"] == scene["name"] && best.contains(result_case["id"].get<std::string>()))
        front.push_back(result_case["id"]);
    list.push_back({{"scene", scene["name"]}, {"ids", front}});
  }
  return list;
}

void add_presets(Json& result, const Json& origin) {
  Json facts = preset_facts(result["cases"], result["skipped"]);
  if (facts.empty()) return;
  Json rankings = preset_rankings(result["scenes"], result["cases"], origin);
  result["presets"] = std::move(facts);
  result["preset_rankings"] = std::move(rankings);
}

Json tool_to_json(const run::ToolFacts& tool) {
  return result::to_json(run::record_of(tool));
}

Json case_to_json(const run::CaseResult& case_result) {
  return result::to_json(run::record_of(case_result));
}

Json result_to_json(const run::Result& result, const std::vector<Json>& earlier_cases) {
  Json out{{"schema_version", k_schema_version}, {"name", result.config_name}};
  if (!result.date.empty()) out["date"] = result.date;
  if (!result.command.empty()) out["command"] = result.command;
  out["tool"] = tool_to_json(result.tool);
  out["machine"] = machine_to_json(result.machine);
  out["config"] = result.config;
  out["scenes"] = Json::array();
  for (const run::SceneResult& scene : result.scenes) out["scenes"].push_back(result::to_json(run::record_of(scene)));
  out["cases"] = in_plan_order(result, earlier_cases);
  add_extra_pairs(out["cases"]);
  add_costs(out["cases"], out["config"]);
  out["pareto_front"] = fronts(out["scenes"], out["cases"], out);
  out["skipped"] = Json::array();
  for (const run::Skipped& skipped : result.skipped) {
    out["skipped"].push_back({{"name", skipped.name}, {"reason", skipped.reason}});
    if (!skipped.preset.empty()) out["skipped"].back()["preset"] = skipped.preset;
  }
  add_presets(out, out);
  out["conclusions"] = conclusions_of(out, out);
  conclude_failures(out, {});
  return out;
}

std::vector<std::string> gate_failures(const Json& result) {
  std::vector<std::string> lines;
  for (const Json& result_case : result["cases"])
    for (const Json& failure : result_case["failures"])
      lines.push_back(result_case["name"].get<std::string>() + ": " + failure["text"].get<std::string>());
  return lines;
}

Json number_or_null(double value) {
  return result::number_json(result::counted(value), false);
}

}  // namespace clusterbench::report
