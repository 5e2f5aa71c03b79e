#include "report/gates/baseline_cases.h"

#include <set>

#include "core/pattern.h"
#include "core/text.h"
#include "report/cases/case_filter.h"
#include "report/cases/followed_settings.h"
#include "report/comparing/case_settings.h"
#include "report/comparing/comparability.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Result;

std::string first_obstacle(const Result& base, const Result& next) {
  const Obstacles found = obstacles(base, next);
  return found.to_instructions.empty() ? "" : found.to_instructions.front();
}

std::string here_and_in(const std::vector<OtherSetting>& settings, const std::string& base_name) {
  const auto words = [](const nlohmann::ordered_json& value) { return value.is_null() ? "not set" : value.dump(); };
  std::vector<std::string> texts;
  for (const auto& [key, before, now] : settings)
    texts.push_back(key + " is " + words(now) + " here and " + words(before) + " in " + base_name);
  return joined(texts);
}

}  // namespace

BaselineCases::BaselineCases(const Result& base, const Result& result, const std::string& filter, std::string name)
    : base_(base),
      next_(result),
      name_(std::move(name)),
      obstacle_(first_obstacle(base, result)),
      is_one_scene_(base.scenes.size() == 1 && result.scenes.size() == 1) {
  std::set<std::string> now;
  for (const Case& result_case : result.cases) now.insert(key_of(result_case));
  const Pattern wanted(filter, "--filter");
  for (const Case& base_case : base.cases) {
    const std::string key = key_of(base_case);
    by_key_.try_emplace(key, &base_case);
    if (!now.contains(key) && is_selected(wanted, base_case)) gone_cases_.push_back(&base_case);
  }
}

std::string BaselineCases::key_of(const Case& result_case) const {
  const auto label_of = [](const auto& part) { return part ? part->label : std::string(); };
  const nlohmann::ordered_json key{is_one_scene_ ? std::string() : result_case.scene,
                                   result_case.camera,
                                   result_case.viewport,
                                   result_case.grid.name,
                                   result_case.assigner.label,
                                   result_case.storage,
                                   label_of(result_case.precision),
                                   label_of(result_case.pre_cull),
                                   result_case.preset.value_or("")};
  return key.dump();
}

const Case* BaselineCases::case_of(const Case& result_case) const {
  const auto found = by_key_.find(key_of(result_case));
  return found == by_key_.end() ? nullptr : found->second;
}

std::string BaselineCases::changes_of(const Case& result_case) const {
  const Case* base_case = case_of(result_case);
  if (base_case == nullptr) return "";
  std::vector<std::string> changes;
  if (base_case->id != result_case.id) changes = differing_settings(base_, *base_case, next_, result_case);
  const std::string &before = base_.tool.git_sha, &now = next_.tool.git_sha;
  if (before != now) changes.push_back("clusterbench (" + before + ", now " + now + ")");
  if (const std::string plugin = changed_plugin(result_case); !plugin.empty()) changes.push_back(plugin);
  return joined(changes);
}

// "plug-in acme (1.0, now 1.1)": of the case's method; "" without one, or where both are the same file.
std::string BaselineCases::changed_plugin(const Case& result_case) const {
  const std::string id = result_case.assigner.name.substr(0, result_case.assigner.name.find('.'));
  const auto build_in = [&](const result::Result& result) -> std::string {
    for (const result::Plugin& plugin : result.plugins.value_or(std::vector<result::Plugin>()))
      if (plugin.id == id) return plugin.version + " " + plugin.sha256.substr(0, 12);
    return "";
  };
  const std::string before = build_in(base_), now = build_in(next_);
  return before == now ? "" : "plug-in " + id + " (" + before + ", now " + now + ")";
}

std::string BaselineCases::obstacle_to_instructions(const Case& result_case) const {
  if (!obstacle_.empty()) return obstacle_;
  const Case* base_case = case_of(result_case);
  if (base_case == nullptr || !base_case->count || !result_case.count) return "";
  const auto difference = [](const std::string& what, const std::string& before, const std::string& now) {
    return before == now ? "" : what + " is \"" + before + "\" and \"" + now + "\"";
  };
  const result::Count &before = *base_case->count, &now = *result_case.count;
  const std::string source = difference("/count/source", before.source, now.source);
  return source.empty() ? difference("/count/simd_target", before.simd_target, now.simd_target) : source;
}

std::string BaselineCases::other_prices() const {
  return here_and_in(report::other_prices(base_, next_), name_);
}

std::string BaselineCases::other_weights() const {
  std::vector<OtherSetting> prices = report::other_prices(base_, next_);
  std::erase_if(prices, [](const OtherSetting& price) { return !price.key.starts_with("cost.weights."); });
  return here_and_in(prices, name_);
}

std::string BaselineCases::other_margin() const {
  return here_and_in(report::other_margin(base_, next_), name_);
}

}  // namespace clusterbench::report
