#include "report/results/result_record.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string_view>

#include "core/parallel.h"
#include "report/cases/case_costs.h"
#include "report/cases/case_samples.h"
#include "report/cases/contender.h"
#include "report/cases/device_frames.h"
#include "report/cases/nothing_seen.h"
#include "report/choosing/conclusion.h"
#include "report/presets/preset_ranking.h"
#include "result/at.h"
#include "result/rounding.h"
#include "run/findings/gate.h"
#include "run/records/records.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Case;
using result::Occupancy;
using result::Spread;

// Pairs per frame relative to the same case in float32; null if there is none.
void add_extra_pairs(std::vector<Case>& cases) {
  std::map<std::string, double> pairs;
  for (const Case& result_case : cases)
    pairs[result_case.name] =
        result::number<&Case::occupancy, &Occupancy::pairs, &Spread::mean>(result_case).value_or(result::k_none);
  for (Case& result_case : cases) {
    if (!result_case.precision) continue;
    const std::string& name = result_case.name;
    const std::string label = "/" + result_case.precision->label;
    const bool is_packed = result_case.precision->packing != "float32";
    const auto plain = pairs.find(is_packed ? name.substr(0, name.size() - label.size()) : name);
    const double mean = plain == pairs.end() ? result::k_none : plain->second, extra = pairs[name] - mean;
    result_case.precision->extra_pairs = {result::counted(extra), result::counted(extra / mean)};
  }
}

std::vector<Case> in_plan_order(const run::Result& result, const std::vector<Case>& earlier_cases, int threads) {
  std::map<std::string_view, std::function<Case()>> by_id;
  for (const Case& earlier : earlier_cases) by_id[earlier.id] = [&] { return earlier; };
  for (const run::CaseResult& fresh : result.cases) by_id[fresh.id] = [&] { return run::record_of(fresh); };
  std::vector<const std::function<Case()>*> found;
  for (const std::string& id : result.planned_ids)
    if (const auto at = by_id.find(id); at != by_id.end()) found.push_back(&at->second);
  std::vector<Case> cases(found.size());
  parallel_ranges(cases.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) cases[i] = (*found[i])();
  });
  return cases;
}

// In the order of the plan. One that is among the finished cases fails that one, which keeps its figures.
void add_broken(const run::Result& result, const std::vector<result::BrokenCase>& earlier, result::Result& out) {
  std::map<std::string, result::BrokenCase> by_id;
  for (const auto* some : {&earlier, &result.broken})
    for (const result::BrokenCase& broken : *some) by_id.insert({broken.id, broken});
  for (const std::string& id : result.planned_ids) {
    const auto found = by_id.find(id);
    if (found == by_id.end()) continue;
    const auto finished = std::ranges::find(out.cases, id, &Case::id);
    if (finished != out.cases.end()) {
      finished->failures.push_back({found->second.kind, found->second.reason});
      finished->eligible = false;
      continue;
    }
    if (!out.broken) out.broken.emplace();
    out.broken->push_back(found->second);
  }
}

std::optional<std::string> known(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

}  // namespace

std::vector<result::Front> fronts(const std::vector<result::Scene>& scenes, const std::vector<Case>& cases,
                                  const result::Result& origin) {
  std::vector<run::Contender> all;
  std::set<std::string> unknown = ids_of_nothing_seen(cases);
  unknown.merge(ids_without_samples(cases));
  for (const Case& result_case : cases)
    if (!unknown.contains(result_case.id)) all.push_back(contender_of(result_case, rank_by(origin)));
  const std::vector<std::string> ids = run::on_front(all, seed_of(origin));
  const std::set<std::string> best(ids.begin(), ids.end());
  std::vector<result::Front> list;
  for (const result::Scene& scene : scenes) {
    result::Front& front = list.emplace_back();
    front.scene = scene.name;
    for (const Case& result_case : cases)
      if (result_case.scene == scene.name && best.contains(result_case.id)) front.ids.push_back(result_case.id);
  }
  return list;
}

void add_presets(result::Result& result, const result::Result& origin) {
  std::vector<result::Preset> facts = preset_facts(result.cases, result.skipped);
  if (facts.empty()) return;
  result.preset_rankings = preset_rankings(result.scenes, result.cases, origin);
  result.presets = std::move(facts);
}

result::Result record_of(const run::Result& result, const std::vector<Case>& earlier_cases,
                         const std::vector<result::BrokenCase>& earlier_broken, int threads) {
  result::Result out;
  out.schema_version = k_schema_version;
  out.name = result.config_name;
  out.date = known(result.date);
  out.command = known(result.command);
  out.tool = run::record_of(result.tool);
  for (const plugin::LoadedPlugin* loaded : result.plugins) {
    if (!out.plugins) out.plugins.emplace();
    out.plugins->push_back(run::record_of(*loaded));
  }
  if (result.shard) out.shard = run::record_of(*result.shard);
  out.machine = run::record_of(result.machine);
  if (result.device) out.device = run::record_of(*result.device);
  if (out.device && result.arithmetic) out.device->arithmetic = run::record_of(*result.arithmetic);
  out.config = result.config;
  for (const run::SceneResult& scene : result.scenes) out.scenes.push_back(run::record_of(scene));
  out.cases = in_plan_order(result, earlier_cases, threads);
  add_broken(result, earlier_broken, out);
  add_extra_pairs(out.cases);
  add_costs(out.cases, out.config);
  add_device_frames(out.cases, out.config);
  for (const run::Skipped& skipped : result.skipped)
    out.skipped.push_back({skipped.name, skipped.reason, known(skipped.preset)});
  if (out.shard) {  // what needs all cases is told of all
    out.shard->cases = out.cases.size();
    return out;
  }
  out.pareto_front = fronts(out.scenes, out.cases, out);
  add_presets(out, out);
  out.conclusions = conclusions_of(out, out);
  conclude_failures(out, {});
  return out;
}

}  // namespace clusterbench::report
