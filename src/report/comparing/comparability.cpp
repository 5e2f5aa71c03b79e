#include "report/comparing/comparability.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <optional>
#include <string_view>

#include "report/cases/followed_settings.h"
#include "report/cases/json_values.h"
#include "report/comparing/time_changes.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Case;
using result::Result;

bool are_counted(const Match& match) {
  return match.base.count && match.next.count;
}

// "cold" or "warm"; none without times.
std::optional<std::string> caches_of_times(const Result& result) {
  for (const Case& result_case : result.cases)
    if (result_case.timing) return result_case.timing->caches.value_or("warm");
  return {};
}

// The fields that figures depend on, at their place in a result.
Json facts_of(const Result& result) {
  Json timing = Json::object();
  for (const char* key : {"frames", "sweep_mib"})
    timing[key] = setting_of_parts(result.config, std::string("/timing/") + key);
  return {{"machine", result::to_json(result.machine)},
          {"tool", result::to_json(result.tool)},
          {"config", {{"timing", timing}}}};
}

std::vector<std::string> texts_of(const std::vector<OtherSetting>& settings) {
  std::vector<std::string> out;
  for (const auto& [key, before, now] : settings) out.push_back(key + " is " + before.dump() + " and " + now.dump());
  return out;
}

bool has_costs(const Result& result) {
  return std::ranges::any_of(result.cases, [](const Case& result_case) { return result_case.cost.has_value(); });
}

// Only where they matter.
std::vector<OtherSetting> other_prices_of_costs(const Result& base, const Result& next) {
  return has_costs(base) && has_costs(next) ? other_prices(base, next) : std::vector<OtherSetting>();
}

// The names of machines in merged results: of each case the same machine, if any result is of several.
bool are_on_same_machines(const Result& base, const Result& next) {
  if (!base.machines && !next.machines) return true;
  if (!base.machines || !next.machines || base.machines->size() != next.machines->size()) return false;
  for (std::size_t i = 0; i < base.machines->size(); ++i)
    if (!are_same((*base.machines)[i], (*next.machines)[i])) return false;
  std::map<std::string, std::optional<std::string>> machine_of;
  for (const Case& one : base.cases) machine_of[one.id] = one.machine;
  return std::ranges::all_of(next.cases, [&](const Case& one) {
    const auto found = machine_of.find(one.id);
    return found == machine_of.end() || found->second == one.machine;
  });
}

}  // namespace

std::vector<std::string> differing_margin(const Result& base, const Result& next) {
  return texts_of(other_margin(base, next));
}

std::vector<std::string> differing_prices(const Result& base, const Result& next) {
  return texts_of(other_prices_of_costs(base, next));
}

SameSettings same_settings(const Result& base, const Result& next) {
  SameSettings same{.margin = other_margin(base, next).empty()};
  for (const OtherSetting& price : other_prices_of_costs(base, next)) {
    same.prices = false;
    if (price.key == "cost.wave") same.waves = false;
    if (price.key.starts_with("cost.weights")) same.weights = false;
  }
  return same;
}

Obstacles obstacles(const Result& base, const Result& next) {
  const Json base_facts = facts_of(base), next_facts = facts_of(next);
  const auto differing = [&](std::initializer_list<const char*> pointers) {
    std::vector<std::string> out;
    for (const char* pointer : pointers) {
      const Json *before = value_at(base_facts, pointer), *now = value_at(next_facts, pointer);
      const Json left = before == nullptr ? Json() : *before, right = now == nullptr ? Json() : *now;
      // Results of older versions do not record the processor's numbers and caches.
      const bool is_unknown = left.is_null() != right.is_null() && std::string_view(pointer).starts_with("/machine/");
      if (left != right && !is_unknown)
        out.push_back(std::string(pointer) + " is " + left.dump() + " and " + right.dump());
    }
    return out;
  };
  Obstacles out;
  out.to_instructions =
      differing({"/machine/cpu", "/machine/family", "/machine/model", "/machine/stepping", "/machine/caches",
                 "/tool/compiler", "/tool/flags", "/tool/build_type", "/tool/simd_target", "/config/timing/frames"});
  if (!are_on_same_machines(base, next))
    out.to_instructions.push_back(
        "/machines differ: one has times of several machines, and its cases were not on those of the other");
  out.to_times = differing({"/machine/cores", "/machine/ram_bytes", "/machine/os"});
  const std::optional<std::string> base_caches = caches_of_times(base), next_caches = caches_of_times(next);
  if (base_caches && next_caches && *base_caches != *next_caches)
    out.to_times.push_back("/cases/*/timing/caches is \"" + *base_caches + "\" and \"" + *next_caches + "\"");
  else if (base_caches == "cold")
    std::ranges::copy(differing({"/config/timing/sweep_mib"}), std::back_inserter(out.to_times));
  out.to_times.insert(out.to_times.begin(), out.to_instructions.begin(), out.to_instructions.end());
  return out;
}

bool are_counts_comparable(const Match& match) {
  if (!are_counted(match)) return false;
  const result::Count &base = *match.base.count, &next = *match.next.count;
  return base.source == next.source && base.simd_target == next.simd_target && base.frames == next.frames;
}

LeftOut left_out(const Result& base, const Result& next, const std::vector<Match>& matches, bool is_paired,
                 bool is_forced) {
  const Obstacles found = obstacles(base, next);
  LeftOut out;
  const auto add = [&](std::optional<std::vector<std::string>>& part, bool (*can_be)(const Match&),
                       const std::vector<std::string>& reasons) {
    if (reasons.empty() || std::ranges::none_of(matches, can_be)) return;
    if (is_forced)
      out.forced = reasons;
    else
      part = reasons;
  };
  std::optional<std::vector<std::string>>& instructions = out.parts.instructions;
  add(instructions, are_counted, found.to_instructions);
  if (std::ranges::any_of(matches,
                          [](const Match& match) { return are_counted(match) && !are_counts_comparable(match); })) {
    if (!instructions) instructions.emplace();
    instructions->push_back("/cases are counted by other means, or of other frames");
  }
  if (!is_paired) add(out.parts.times, are_timed, found.to_times);
  return out;
}

}  // namespace clusterbench::report
