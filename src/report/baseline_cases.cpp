#include "report/baseline_cases.h"

#include <set>

#include "core/pattern.h"
#include "core/text.h"
#include "report/case_filter.h"
#include "report/case_settings.h"
#include "report/compare.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using BaseJson = nlohmann::ordered_json;

std::string part_label(const BaseJson& result_case, const char* part) {
  return result_case.contains(part) ? result_case[part].value("label", std::string()) : std::string();
}

}  // namespace

BaselineCases::BaselineCases(const BaseJson& base, const BaseJson& result, const std::string& filter, std::string name)
    : base_(base),
      next_(result),
      name_(std::move(name)),
      is_one_scene_(base["scenes"].size() == 1 && result["scenes"].size() == 1) {
  std::set<std::string> now;
  for (const BaseJson& result_case : result["cases"]) now.insert(key_of(result_case));
  const Pattern wanted(filter, "--filter");
  for (const BaseJson& base_case : base["cases"]) {
    const std::string key = key_of(base_case), case_name = base_case["name"].get<std::string>();
    by_key_.try_emplace(key, &base_case);
    if (now.contains(key) || !is_selected(wanted, base_case)) continue;
    gone_.push_back(case_name);
    gone_cases_.push_back(&base_case);
  }
}

std::string BaselineCases::key_of(const BaseJson& result_case) const {
  const BaseJson key{is_one_scene_ ? BaseJson() : result_case["scene"],
                     result_case["camera"],
                     result_case["viewport"],
                     result_case["grid"]["name"],
                     result_case["assigner"]["label"],
                     result_case["storage"],
                     part_label(result_case, "precision"),
                     part_label(result_case, "pre_cull"),
                     result_case.value("preset", std::string())};
  return key.dump();
}

const BaseJson* BaselineCases::case_of(const BaseJson& result_case) const {
  const auto found = by_key_.find(key_of(result_case));
  return found == by_key_.end() ? nullptr : found->second;
}

std::string BaselineCases::what_changed(const BaseJson& result_case) const {
  const BaseJson* base_case = case_of(result_case);
  if (base_case == nullptr) return "";
  std::vector<std::string> changes;
  if ((*base_case)["id"] != result_case["id"]) changes = differing_settings(base_, *base_case, next_, result_case);
  const auto commit = [](const BaseJson& result) { return result["tool"].value("git_sha", std::string()); };
  if (commit(base_) != commit(next_))
    changes.push_back("clusterbench (" + commit(base_) + ", now " + commit(next_) + ")");
  return joined(changes);
}

std::string BaselineCases::obstacle_to_instructions(const BaseJson& result_case) const {
  const Obstacles found = obstacles(base_, next_);
  if (!found.to_instructions.empty()) return found.to_instructions.front();
  const BaseJson* base_case = case_of(result_case);
  if (base_case == nullptr) return "";
  for (const char* key : {"source", "simd_target"}) {
    const std::string pointer = std::string("/count/") + key;
    const BaseJson *before = value_at(*base_case, pointer), *now = value_at(result_case, pointer);
    if (before != nullptr && now != nullptr && *before != *now)
      return pointer + " is " + before->dump() + " and " + now->dump();
  }
  return "";
}

}  // namespace clusterbench::report
