#include "report/compare.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <optional>
#include <string_view>

#include "core/text.h"
#include "measure/time_change.h"
#include "report/case_settings.h"
#include "report/columns.h"
#include "report/compare_advice.h"
#include "report/exact_differences.h"
#include "report/json_values.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

// A case that both results have.
struct Match {
  const Json& base;
  const Json& next;
};

std::vector<Match> matches_of(const Json& base, const Json& next) {
  std::map<std::string, const Json*> by_id;
  for (const Json& result_case : base["cases"]) by_id[result_case["id"].get<std::string>()] = &result_case;
  std::vector<Match> matches;
  for (const Json& result_case : next["cases"])
    if (const auto found = by_id.find(result_case["id"].get<std::string>()); found != by_id.end())
      matches.push_back({*found->second, result_case});
  return matches;
}

// The cases of `result` that `other` has not.
std::vector<const Json*> missing_from(const Json& other, const Json& result) {
  std::vector<const Json*> missing;
  for (const Json& result_case : result["cases"])
    if (std::none_of(other["cases"].begin(), other["cases"].end(),
                     [&](const Json& other_case) { return other_case["id"] == result_case["id"]; }))
      missing.push_back(&result_case);
  return missing;
}

Json names_of(const std::vector<const Json*>& cases) {
  Json names = Json::array();
  for (const Json* result_case : cases) names.push_back((*result_case)["name"]);
  return names;
}

// The same name on both sides, and not the same case.
Json renamed(const Json& base, const std::vector<const Json*>& only_in_base, const Json& next,
             const std::vector<const Json*>& only_in_new) {
  Json out = Json::array();
  for (const Json* base_case : only_in_base)
    for (const Json* next_case : only_in_new)
      if ((*base_case)["name"] == (*next_case)["name"])
        out.push_back(
            {{"name", (*base_case)["name"]}, {"differs_in", differing_settings(base, *base_case, next, *next_case)}});
  return out;
}

// Of the cases of both, how many have a part in one result alone.
Json parts_of_one(const std::vector<Match>& matches) {
  Json out = Json::array();
  for (const char* part : {"occupancy", "error", "shading", "samples", "lookup", "stability", "precision", "pre_cull",
                           "fit", "react", "fallback", "shadows", "timing", "count"}) {
    std::size_t base = 0, next = 0;
    for (const Match& match : matches) {
      base += match.base.contains(part) && !match.next.contains(part) ? 1 : 0;
      next += match.next.contains(part) && !match.base.contains(part) ? 1 : 0;
    }
    if (base > 0) out.push_back({{"part", part}, {"only_in", "base"}, {"cases", base}});
    if (next > 0) out.push_back({{"part", part}, {"only_in", "new"}, {"cases", next}});
  }
  return out;
}

bool has(const Json& json, const char* pointer) {
  return value_at(json, pointer) != nullptr;
}
bool both_have(const Match& match, const char* pointer) {
  return has(match.base, pointer) && has(match.next, pointer);
}

// What is compared of two separate runs: what a frame takes.
constexpr const char* k_frame_time = "/timing/frame_ns/median";

// Did the new result measure this base beside itself? The same result twice is a question about just that.
bool is_paired(const Json& base, const Json& next) {
  return has(next, "/baseline/tool") && (next["baseline"]["tool"] == base["tool"] || base == next);
}

// What differs between methods, and not between a method's storages: those share the times of assignment, but for a
// light structure of the method's own. What a frame takes is each case's own.
std::string time_key(const Match& match, bool is_paired) {
  const Json& result_case = match.next;
  if (!is_paired) return result_case["id"].get<std::string>();
  Json key{result_case["scene"], result_case["camera"], result_case["viewport"], result_case["grid"],
           result_case["assigner"]["label"]};
  if (result_case.contains("precision")) key.push_back(result_case["precision"]["label"]);
  if (result_case.contains("pre_cull")) key.push_back(result_case["pre_cull"]["label"]);
  key.push_back(result_case["storage"] == "own");
  return key.dump();
}

struct TimeChange {
  measure::Change change;
  std::vector<double> launches;  // log ratios; empty for separate runs
  double base_ns = 0.0, next_ns = 0.0;
};

TimeChange paired_change(const Json& paired) {
  TimeChange out;
  for (const Json& launch : paired["launches"])
    out.launches.push_back(measure::launch_log_ratio(launch["base_ns"].get<std::vector<double>>(),
                                                     launch["new_ns"].get<std::vector<double>>()));
  out.change = measure::change_over_launches(out.launches);
  out.base_ns = paired["base_ns"].get<double>();
  out.next_ns = paired["new_ns"].get<double>();
  return out;
}

// Without an interval nothing can be concluded: as of no samples.
measure::MedianTime median_frame_time(const Json& timing) {
  const Json &time = timing["frame_ns"], &low = time["ci95"][0], &high = time["ci95"][1];
  if (!low.is_number() || !high.is_number()) return {time["median"], {}, 0, 1};
  return {time["median"], {low, high}, time["samples"].size(), timing.value("launches", 1)};
}

std::optional<TimeChange> time_change(const Match& match, bool is_paired) {
  const auto is_known = [&](const char* pointer) { return has(match.next, pointer); };
  if (is_paired && is_known("/timing/baseline/ratio") && is_known("/timing/baseline/base_ns") &&
      is_known("/timing/baseline/new_ns"))
    return paired_change(match.next["timing"]["baseline"]);
  if (is_paired || !both_have(match, k_frame_time)) return std::nullopt;
  const Json &base_timing = match.base["timing"], &next_timing = match.next["timing"];
  const measure::MedianTime base = median_frame_time(base_timing), next = median_frame_time(next_timing);
  if (!(base.ns > 0.0) || !(next.ns > 0.0)) return std::nullopt;
  if (base_timing["frame_ns"] == next_timing["frame_ns"])
    return TimeChange{{0.0, 0.0, measure::k_least_freedom}, {}, base.ns, next.ns};  // one measurement, twice
  return TimeChange{measure::change_of_medians(base, next), {}, base.ns, next.ns};
}

// The changes of all methods, in the order of their first cases, and what Holm's correction makes of their chances.
class Times {
 public:
  Times() = default;
  Times(const std::vector<Match>& matches, bool is_paired) : is_paired_(is_paired) {
    for (const Match& match : matches) {
      const std::string key = time_key(match, is_paired);
      if (indices_.contains(key)) continue;
      if (const std::optional<TimeChange> change = time_change(match, is_paired)) {
        indices_[key] = changes_.size();
        changes_.push_back(*change);
      }
    }
    std::vector<double> p;
    for (const TimeChange& change : changes_) p.push_back(measure::p_value(change.change));
    corrected_ = measure::holm(p);
  }

  // nullopt where the case has no times to compare.
  std::optional<std::size_t> index_of(const Match& match) const {
    const auto found = indices_.find(time_key(match, is_paired_));
    return found == indices_.end() ? std::nullopt : std::optional(found->second);
  }
  const TimeChange& at(std::size_t index) const { return changes_[index]; }
  double corrected_p(std::size_t index) const { return corrected_[index]; }
  std::size_t count() const { return changes_.size(); }

  // Over all methods. What disturbs a launch as a whole is in each launch's mean; of separate runs nothing is known.
  measure::Change mean() const { return measure::change_over_launches(launch_means()); }

 private:
  // Further launches are of some methods only.
  std::size_t launches_of_all() const {
    std::size_t least = changes_.front().launches.size();
    for (const TimeChange& change : changes_) least = std::min(least, change.launches.size());
    return least;
  }

  std::vector<double> launch_means() const {
    if (changes_.empty()) return {};
    std::vector<double> means(launches_of_all(), 0.0);
    for (const TimeChange& change : changes_)
      for (std::size_t i = 0; i < means.size(); ++i) means[i] += change.launches[i] / static_cast<double>(count());
    return means;
  }

  bool is_paired_ = false;
  std::map<std::string, std::size_t> indices_;
  std::vector<TimeChange> changes_;
  std::vector<double> corrected_;
};

void add_ratio(Json& out, const measure::Change& change) {
  const measure::Ratio ratio = measure::ratio_of(change);
  out["ratio"] = number_or_null(ratio.ratio);
  out["ci95"] = {number_or_null(ratio.ci95.low), number_or_null(ratio.ci95.high)};
}

// Counted alike: by the same means, for the same instruction set.
bool are_counts_comparable(const Match& match) {
  if (!both_have(match, "/count/instructions_per_frame/assign")) return false;
  const Json &base = match.base["count"], &next = match.next["count"];
  return base["source"] == next["source"] && base["simd_target"] == next["simd_target"] &&
         base["frames"] == next["frames"];
}

// Hardware counts interrupts, too; even valgrind's depend a little on where memory lies.
double count_tolerance(const Json& count) {
  return count["source"] == "callgrind" ? 0.001 : 0.01;
}

Json instructions(const Match& match, double threshold) {
  const auto ratio = [&](const char* pointer) {
    const double base = match.base["count"][Pointer(pointer)].get<double>();
    const double next = match.next["count"][Pointer(pointer)].get<double>();
    return base > 0.0 ? next / base : next > 0.0 ? std::nan("") : 1.0;
  };
  // What leaves its own structure converts nothing.
  const bool converts = has(match.base, "/count/instructions_per_frame/convert") &&
                        has(match.next, "/count/instructions_per_frame/convert");
  const double assign = ratio("/instructions_per_frame/assign"),
               convert = converts ? ratio("/instructions_per_frame/convert") : 1.0;
  const double limit = std::max(threshold, count_tolerance(match.next["count"]));
  const char* verdict = assign > 1.0 + limit || convert > 1.0 + limit   ? "more"
                        : assign < 1.0 - limit || convert < 1.0 - limit ? "fewer"
                                                                        : "same";
  return {{"verdict", verdict},
          {"assign_ratio", number_or_null(assign)},
          {"convert_ratio", number_or_null(convert)},
          {"build_ratio", number_or_null(ratio("/instructions_per_build"))},
          {"tolerance", count_tolerance(match.next["count"])}};
}

// What two programs that were measured side by side listed differently.
void add_list_difference(const Match& match, Json& out) {
  if (!has(match.next, "/timing/baseline/lists_differ")) return;
  const Json& lists = match.next["timing"]["baseline"]["lists_differ"];
  const bool is_better = lists["new_pairs"].get<double>() < lists["base_pairs"].get<double>() &&
                         has(match.next, "/error") && match.next["error"]["false_negatives"] == 0;
  out["lists"] = lists;
  if (out["counts"] == "same" || !is_better) out["counts"] = is_better ? "better" : "worse";
}

// What stands between two results, beside their exact counts.
struct Scope {
  Json left_out = Json::object();   // "times", "instructions": the obstacles
  std::vector<std::string> forced;  // obstacles in spite of which they are compared

  bool leaves_out(const char* what) const { return left_out.contains(what); }
};

Scope scope_of(const Json& base, const Json& next, const std::vector<Match>& matches, bool is_forced) {
  const Obstacles found = obstacles(base, next);
  Scope scope;
  const auto add = [&](const char* what, const char* pointer, const std::vector<std::string>& in_the_way) {
    if (in_the_way.empty() ||
        std::none_of(matches.begin(), matches.end(), [&](const Match& match) { return both_have(match, pointer); }))
      return;
    if (is_forced)
      scope.forced = in_the_way;
    else
      scope.left_out[what] = in_the_way;
  };
  add("instructions", "/count/source", found.to_instructions);
  if (std::any_of(matches.begin(), matches.end(), [](const Match& match) {
        return both_have(match, "/count/source") && !are_counts_comparable(match);
      }))
    scope.left_out["instructions"].push_back("/cases are counted by other means, or of other frames");
  if (!is_paired(base, next)) add("times", k_frame_time, found.to_times);
  return scope;
}

const char* hint_of(measure::Verdict verdict) {
  return verdict == measure::Verdict::slower ? "longer" : verdict == measure::Verdict::faster ? "shorter" : "none";
}

struct Settings {
  double threshold = 0.0;
  bool gates_separate = false, is_margin_same = true, is_same_program = false;
};

// A program beside itself is the same, whatever the times of this hour say.
void add_time(Json& out, const TimeChange& time, double corrected_p, const Settings& settings) {
  const measure::Verdict verdict = settings.is_same_program
                                       ? measure::Verdict::same
                                       : measure::verdict_on(time.change, corrected_p, settings.threshold);
  if (time.launches.empty() && !settings.gates_separate) {
    out["hint"] = hint_of(verdict);
  } else {
    out["verdict"] = measure::name_of(verdict);
    out["p_corrected"] = corrected_p;
  }
  add_ratio(out, time.change);
  out["base_ns"] = time.base_ns;
  out["new_ns"] = time.next_ns;
  out["launches"] = time.launches.size();
}

Json margin_of(const Json& result) {
  return result["config"].value(Pointer("/allocation/margin"), Json());
}

Json compared(const Match& match, const Times& times, const Scope& scope, const Settings& settings) {
  Json out{{"id", match.next["id"]}, {"name", match.next["name"]}};
  if (const auto index = times.index_of(match)) add_time(out, times.at(*index), times.corrected_p(*index), settings);
  out.update(exact_differences(match.base, match.next, settings.is_margin_same));
  add_list_difference(match, out);
  if (!scope.leaves_out("instructions") && are_counts_comparable(match))
    out["instructions"] = instructions(match, settings.threshold);
  return out;
}

std::size_t count_of(const Json& cases, const char* key, const char* value) {
  return static_cast<std::size_t>(std::count_if(cases.begin(), cases.end(), [&](const Json& compared_case) {
    return compared_case.contains(key) && compared_case[key] == value;
  }));
}

Json summary_of(const Json& cases, const Times& times) {
  Json out{{"cases", cases.size()}, {"methods_timed", times.count()}};
  for (const char* verdict : {"faster", "slower", "same", "inconclusive"})
    out[verdict] = count_of(cases, "verdict", verdict);
  for (const char* hint : {"shorter", "longer"}) out[std::string("hints_") + hint] = count_of(cases, "hint", hint);
  for (const char* counts : {"better", "worse"})
    out[std::string("counts_") + counts] = count_of(cases, "counts", counts);
  if (const measure::Change mean = times.mean(); mean.is_known()) add_ratio(out, mean);
  return out;
}

std::string percent_text(const Json& ratio) {
  return ratio.is_null() ? "-" : text("%+.1f %%", 100.0 * (ratio.get<double>() - 1.0));
}

Json failures_of(const Json& next, const Json& cases) {
  Json failures = Json::array();
  for (const std::string& failure : gate_failures(next)) failures.push_back(failure);
  for (const Json& compared_case : cases) {
    const std::string name = shown(compared_case["name"]);
    const bool has_verdict = compared_case.contains("verdict");
    if (has_verdict && compared_case["verdict"] == "slower")
      failures.push_back(name + ": slower by " + percent_text(compared_case["ratio"]));
    if (compared_case["counts"] == "worse") failures.push_back(name + ": what is counted has changed");
    const bool is_time_sure =
        has_verdict && compared_case["launches"] != 0 && compared_case["verdict"] != "inconclusive";
    if (compared_case.contains("instructions") && compared_case["instructions"]["verdict"] == "more" && !is_time_sure)
      failures.push_back(name + ": more instructions, " + percent_text(compared_case["instructions"]["assign_ratio"]) +
                         " to assign, " + percent_text(compared_case["instructions"]["convert_ratio"]) + " to convert");
  }
  return failures;
}

std::string listed(const Json& names) {
  constexpr std::size_t k_most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(k_most, names.size()); ++i)
    text += (i == 0 ? "" : ", ") + shown(names[i].get<std::string>());
  return names.size() > k_most ? text + " and " + std::to_string(names.size() - k_most) + " more" : text;
}

constexpr const char* k_separate_hints =
    "two runs of one program can differ several-fold; hints only, which fail nothing: to gate on time use `run "
    "--baseline-binary`, on a noisy machine `run --count`";
constexpr const char* k_separate_verdicts =
    "--gate-separate: two runs of one program can differ several-fold, and intervals know nothing of that; on a busy "
    "machine every second comparison of a program with itself failed";

// The names that stand on one side alone. What the other has under the same name is told apart, with the difference.
Json without_renamed(const Json& names, const Json& renamed_cases) {
  Json out = Json::array();
  for (const Json& name : names)
    if (std::ranges::none_of(renamed_cases, [&](const Json& renamed) { return renamed["name"] == name; }))
      out.push_back(name);
  return out;
}

Json warnings_of(const Json& base, const Json& next, const Json& comparison, const std::vector<std::string>& forced,
                 bool gates_separate) {
  Json warnings = Json::array();
  for (const std::string& obstacle : forced) warnings.push_back("compared all the same: " + obstacle);
  for (const auto& [what, in_the_way] : comparison["left_out"].items())
    warnings.push_back(what + " are not compared: " + joined(in_the_way.get<std::vector<std::string>>(), "; "));
  if (comparison["data"] == "separate" && comparison["summary"]["methods_timed"] != 0)
    warnings.push_back(gates_separate ? k_separate_verdicts : k_separate_hints);
  if (margin_of(base) != margin_of(next) && !comparison["cases"].empty())
    warnings.push_back("allocation.margin is " + margin_of(base).dump() + " and " + margin_of(next).dump() +
                       ", another setting: what is recommended follows it and is not compared");
  const bool is_beside = comparison["data"] == "paired" && base == next;
  const Json only_in_base = without_renamed(comparison["only_in_base"], comparison["renamed"]),
             only_in_new = without_renamed(comparison["only_in_new"], comparison["renamed"]);
  if (!only_in_base.empty()) warnings.push_back("only in the base, not compared: " + listed(only_in_base));
  if (!only_in_new.empty())
    warnings.push_back(std::string(is_beside ? "the other program does not have them, not compared: "
                                             : "only in the new result, not compared: ") +
                       listed(only_in_new));
  std::map<std::string, Json> by_reason;
  for (const Json& renamed_case : comparison["renamed"])
    by_reason[joined(renamed_case["differs_in"].get<std::vector<std::string>>())].push_back(renamed_case["name"]);
  for (const auto& [reason, names] : by_reason)
    warnings.push_back("of one name, but not the same, so not compared: they differ in " + reason + ": " +
                       listed(names));
  for (const Json& part : comparison["not_compared"])
    warnings.push_back(part["part"].get<std::string>() + " is not compared in " +
                       number_of(part["cases"].get<std::uint64_t>(), "case") + ": only the " +
                       (part["only_in"] == "base" ? "base" : "new result") + " has it");
  if (is_beside)
    warnings.push_back(
        "times and lists of both programs were compared; bytes, samples and whatever else is counted were not: that "
        "takes a result of the other program");
  return warnings;
}

// "cold" or "warm"; null without times.
Json caches_of_times(const Json& result) {
  for (const Json& result_case : result["cases"])
    if (has(result_case, "/timing")) return result_case["timing"].value("caches", "warm");
  return {};
}

// Something that would have failed the comparison had it become worse.
bool is_gated_part_missing(const Json& comparison) {
  return std::any_of(comparison["not_compared"].begin(), comparison["not_compared"].end(),
                     [](const Json& part) { return part["only_in"] == "base" && part["part"] != "timing"; });
}

}  // namespace

Obstacles obstacles(const Json& base, const Json& next) {
  const auto differing = [&](std::initializer_list<const char*> pointers) {
    std::vector<std::string> out;
    for (const char* pointer : pointers) {
      const Json none, &left = has(base, pointer) ? base[Pointer(pointer)] : none,
                       &right = has(next, pointer) ? next[Pointer(pointer)] : none;
      // Results of older versions do not know the processor's numbers and caches.
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
  out.to_times = differing({"/machine/cores", "/machine/ram_bytes", "/machine/os"});
  const Json base_caches = caches_of_times(base), next_caches = caches_of_times(next);
  if (!base_caches.is_null() && !next_caches.is_null() && base_caches != next_caches)
    out.to_times.push_back("/cases/*/timing/caches is " + base_caches.dump() + " and " + next_caches.dump());
  out.to_times.insert(out.to_times.begin(), out.to_instructions.begin(), out.to_instructions.end());
  return out;
}

Json compare_results(const Json& base, const Json& next, double threshold, const CompareOptions& options) {
  const bool by_pairs = is_paired(base, next);
  std::vector<Match> matches = matches_of(base, next);
  const std::vector<const Json*> only_in_base = missing_from(next, base);
  std::vector<const Json*> only_in_new = missing_from(base, next);
  if (by_pairs && base == next) {  // one result, and what the other program had beside it
    std::vector<Match> beside;
    for (const Match& match : matches)
      if (has(match.next, "/timing/baseline"))
        beside.push_back(match);
      else
        only_in_new.push_back(&match.next);
    matches.swap(beside);
  }
  const Scope scope = scope_of(base, next, matches, options.is_forced);
  const Times times = scope.leaves_out("times") ? Times() : Times(matches, by_pairs);
  Json out{{"comparison_version", 1},
           {"threshold", threshold},
           {"data", by_pairs ? "paired" : "separate"},
           {"time", by_pairs ? "assign" : "frame"},
           {"base", {{"tool", by_pairs ? next["baseline"]["tool"] : base["tool"]}}},
           {"new", {{"tool", next["tool"]}}},
           {"left_out", scope.left_out},
           {"cases", Json::array()}};
  const bool is_same_program = by_pairs && next["baseline"].value("is_same_program", false);
  if (is_same_program) out["is_same_program"] = true;
  const Settings settings{threshold, options.gates_separate, margin_of(base) == margin_of(next), is_same_program};
  for (const Match& match : matches) out["cases"].push_back(compared(match, times, scope, settings));
  out["summary"] = summary_of(out["cases"], times);
  out["only_in_base"] = names_of(only_in_base);
  out["only_in_new"] = names_of(only_in_new);
  out["renamed"] = renamed(base, only_in_base, next, only_in_new);
  out["not_compared"] = parts_of_one(matches);
  out["failures"] = failures_of(next, out["cases"]);
  out["warnings"] = warnings_of(base, next, out, scope.forced, options.gates_separate);
  if (const std::vector<std::string> advice = advice_on(out); !advice.empty()) out["advice"] = advice;
  return out;
}

ExitCode outcome(const Json& comparison, bool is_strict) {
  if (comparison["cases"].empty()) return ExitCode::nothing_comparable;
  if (!comparison["failures"].empty()) return ExitCode::gate_failed;
  const bool is_open = comparison["summary"]["inconclusive"] != 0 || !comparison["only_in_base"].empty() ||
                       comparison["left_out"].contains("instructions") || is_gated_part_missing(comparison);
  return is_strict && is_open ? ExitCode::inconclusive : ExitCode::ok;
}

}  // namespace clusterbench::report
