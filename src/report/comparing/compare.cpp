#include "report/comparing/compare.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <string_view>

#include "core/text.h"
#include "measure/statistics/time_change.h"
#include "report/cases/columns.h"
#include "report/cases/failures.h"
#include "report/cases/json_values.h"
#include "report/comparing/case_settings.h"
#include "report/comparing/compare_advice.h"
#include "report/comparing/exact_differences.h"
#include "result/at.h"
#include "result/rounding.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Case;
using result::ComparedCase;
using result::Comparison;
using result::number;
using result::PartOfOne;
using result::PerFrame;
using result::RenamedCase;
using result::Result;
using result::Timing;

// A case that both results have.
struct Match {
  const Case& base;
  const Case& next;
};

std::vector<Match> matches_of(const Result& base, const Result& next) {
  std::map<std::string, const Case*> by_id;
  for (const Case& result_case : base.cases) by_id[result_case.id] = &result_case;
  std::vector<Match> matches;
  for (const Case& result_case : next.cases)
    if (const auto found = by_id.find(result_case.id); found != by_id.end())
      matches.push_back({*found->second, result_case});
  return matches;
}

// The cases of `result` that `other` does not have.
std::vector<const Case*> missing_from(const Result& other, const Result& result) {
  std::vector<const Case*> missing;
  for (const Case& result_case : result.cases)
    if (std::ranges::find(other.cases, result_case.id, &Case::id) == other.cases.end()) missing.push_back(&result_case);
  return missing;
}

std::vector<std::string> names_of(const std::vector<const Case*>& cases) {
  std::vector<std::string> names;
  for (const Case* result_case : cases) names.push_back(result_case->name);
  return names;
}

// Cases with the same name on both sides that are not the same case.
std::vector<RenamedCase> renamed(const Result& base, const std::vector<const Case*>& only_in_base, const Result& next,
                                 const std::vector<const Case*>& only_in_new) {
  std::vector<RenamedCase> out;
  for (const Case* base_case : only_in_base)
    for (const Case* next_case : only_in_new)
      if (base_case->name == next_case->name)
        out.push_back({base_case->name, differing_settings(base, *base_case, next, *next_case)});
  return out;
}

// A part that cases may not have.
struct Part {
  const char* name;
  bool (*is_in)(const Case& result_case);
};
template <auto Member>
bool has(const Case& result_case) {
  return (result_case.*Member).has_value();
}
constexpr Part k_parts[] = {
    {"occupancy", has<&Case::occupancy>}, {"error", has<&Case::error>},       {"shading", has<&Case::shading>},
    {"samples", has<&Case::samples>},     {"lookup", has<&Case::lookup>},     {"stability", has<&Case::stability>},
    {"precision", has<&Case::precision>}, {"pre_cull", has<&Case::pre_cull>}, {"fit", has<&Case::fit>},
    {"react", has<&Case::react>},         {"fallback", has<&Case::fallback>}, {"shadows", has<&Case::shadows>},
    {"timing", has<&Case::timing>},       {"count", has<&Case::count>},
};

// For each part, the number of common cases that have it in only one result.
std::vector<PartOfOne> parts_of_one(const std::vector<Match>& matches) {
  std::vector<PartOfOne> out;
  for (const Part& part : k_parts) {
    std::size_t base = 0, next = 0;
    for (const Match& match : matches) {
      base += part.is_in(match.base) && !part.is_in(match.next) ? 1 : 0;
      next += part.is_in(match.next) && !part.is_in(match.base) ? 1 : 0;
    }
    if (base > 0) out.push_back({part.name, "base", base});
    if (next > 0) out.push_back({part.name, "new", next});
  }
  return out;
}

// Equal in all recorded values.
template <class Record>
bool are_same(const Record& base, const Record& next) {
  return &base == &next || result::to_json(base) == result::to_json(next);
}

// The compared time of separate runs: the frame time.
std::optional<double> frame_time(const Case& result_case) {
  return number<&Case::timing, &Timing::frame_ns, &result::Time::median>(result_case);
}
bool are_timed(const Match& match) {
  return frame_time(match.base) && frame_time(match.next);
}
bool are_counted(const Match& match) {
  return match.base.count && match.next.count;
}

// The relation of two results.
struct Relation {
  bool is_paired = false;  // the new one was measured side by side with this base
  bool is_one = false;     // one result is compared with itself: with its own baseline
};
Relation relation_of(const Result& base, const Result& next) {
  if (!next.baseline) return {};
  const bool is_one = are_same(base, next);
  return {is_one || are_same(next.baseline->tool, base.tool), is_one};
}

// Identifies a method: its storages share the assignment time, except for a method's own structure. In separate runs
// each case has its own frame time.
std::string time_key(const Match& match, bool is_paired) {
  const Case& result_case = match.next;
  if (!is_paired) return result_case.id;
  Json key{result_case.scene, result_case.camera, result_case.viewport, result::to_json(result_case.grid),
           result_case.assigner.label};
  if (result_case.precision) key.push_back(result_case.precision->label);
  if (result_case.pre_cull) key.push_back(result_case.pre_cull->label);
  key.push_back(result_case.storage == run::k_own_structure);
  return key.dump();
}

struct TimeChange {
  measure::Change change;
  std::vector<double> launches;  // log ratios; empty for separate runs
  double base_ns = 0.0, next_ns = 0.0;
};

TimeChange paired_change(const result::BaselineTimes& paired) {
  TimeChange out;
  for (const result::BaselineLaunch& launch : paired.launches)
    out.launches.push_back(measure::launch_log_ratio(launch.base_ns, launch.new_ns));
  out.change = measure::change_over_launches(out.launches);
  out.base_ns = paired.base_ns;
  out.next_ns = paired.new_ns;
  return out;
}

// Without an interval there is no conclusion, as without samples.
measure::MedianTime median_frame_time(const Timing& timing) {
  const result::Time& time = timing.frame_ns;
  const double low = time.ci95[0], high = time.ci95[1];
  if (!std::isfinite(low) || !std::isfinite(high)) return {time.median, {}, 0, 1};
  return {time.median, {low, high}, time.samples.size(), static_cast<int>(timing.launches.value_or(1))};
}

std::optional<TimeChange> time_change(const Match& match, bool is_paired) {
  if (is_paired) {
    const auto* paired = result::part<&Case::timing, &Timing::baseline>(match.next);
    const bool is_known = paired != nullptr && std::isfinite(paired->ratio) && std::isfinite(paired->base_ns) &&
                          std::isfinite(paired->new_ns);
    return is_known ? std::optional(paired_change(*paired)) : std::nullopt;
  }
  if (!are_timed(match)) return std::nullopt;
  const Timing &base_timing = *match.base.timing, &next_timing = *match.next.timing;
  const measure::MedianTime base = median_frame_time(base_timing), next = median_frame_time(next_timing);
  if (!(base.ns > 0.0) || !(next.ns > 0.0)) return std::nullopt;
  if (are_same(base_timing.frame_ns, next_timing.frame_ns))
    return TimeChange{{0.0, 0.0, measure::k_least_freedom}, {}, base.ns, next.ns};  // one measurement, twice
  return TimeChange{measure::change_of_medians(base, next), {}, base.ns, next.ns};
}

// The changes of all methods, in the order of their first cases, with p-values by Holm's correction.
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

  // nullopt if the case has no times to compare.
  std::optional<std::size_t> index_of(const Match& match) const {
    const auto found = indices_.find(time_key(match, is_paired_));
    return found == indices_.end() ? std::nullopt : std::optional(found->second);
  }
  const TimeChange& at(std::size_t index) const { return changes_[index]; }
  double corrected_p(std::size_t index) const { return corrected_[index]; }
  std::size_t count() const { return changes_.size(); }

  // Over all methods. A disturbance of a whole launch is in that launch's mean; unknown for separate runs.
  measure::Change mean() const { return measure::change_over_launches(launch_means()); }

 private:
  // Additional launches measured only some methods.
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

// `out`: a case, or the summary.
template <class Record>
void add_ratio(Record& out, const measure::Change& change) {
  const measure::Ratio ratio = measure::ratio_of(change);
  out.ratio = result::counted(ratio.ratio);
  out.ci95 = {result::counted(ratio.ci95.low), result::counted(ratio.ci95.high)};
}

// Comparable counts: same counter, same instruction set.
bool are_counts_comparable(const Match& match) {
  if (!are_counted(match)) return false;
  const result::Count &base = *match.base.count, &next = *match.next.count;
  return base.source == next.source && base.simd_target == next.simd_target && base.frames == next.frames;
}

// Hardware counters include interrupts; even valgrind's counts depend slightly on addresses.
double count_tolerance(const result::Count& count) {
  return count.source == "callgrind" ? 0.001 : 0.01;
}

result::ComparedInstructions compared_instructions(const result::Count& base, const result::Count& next,
                                                   double threshold) {
  const auto ratio = [](double before, double now) {
    return before > 0.0 ? now / before : now > 0.0 ? std::nan("") : 1.0;
  };
  const PerFrame &base_frame = base.instructions_per_frame, &next_frame = next.instructions_per_frame;
  // A method with its own structure converts no lists.
  const double assign = ratio(base_frame.assign, next_frame.assign),
               convert =
                   base_frame.convert && next_frame.convert ? ratio(*base_frame.convert, *next_frame.convert) : 1.0,
               build = ratio(static_cast<double>(base.instructions_per_build),
                             static_cast<double>(next.instructions_per_build));
  const double limit = std::max(threshold, count_tolerance(next));
  const char* verdict = assign > 1.0 + limit || convert > 1.0 + limit   ? "more"
                        : assign < 1.0 - limit || convert < 1.0 - limit ? "fewer"
                                                                        : "same";
  return {.verdict = verdict,
          .assign_ratio = result::counted(assign),
          .convert_ratio = result::counted(convert),
          .build_ratio = result::counted(build),
          .tolerance = count_tolerance(next)};
}

// Adds the differences between the lists of two programs that were measured side by side.
void add_list_difference(const Match& match, ComparedCase& out) {
  const auto* lists = result::part<&Case::timing, &Timing::baseline, &result::BaselineTimes::lists_differ>(match.next);
  if (lists == nullptr) return;
  const bool is_better =
      lists->new_pairs < lists->base_pairs && match.next.error && match.next.error->false_negatives == 0;
  out.lists = *lists;
  if (out.counts == "same" || !is_better) out.counts = is_better ? "better" : "worse";
}

// Obstacles to a comparison of two results, other than their exact counts.
struct Scope {
  result::NotComparable left_out;
  std::vector<std::string> forced;  // obstacles that the user overrides
};

Scope scope_of(const Result& base, const Result& next, const std::vector<Match>& matches, bool is_paired,
               bool is_forced) {
  const Obstacles found = obstacles(base, next);
  Scope scope;
  const auto add = [&](std::optional<std::vector<std::string>>& what, bool (*can_be)(const Match&),
                       const std::vector<std::string>& in_the_way) {
    if (in_the_way.empty() || std::ranges::none_of(matches, can_be)) return;
    if (is_forced)
      scope.forced = in_the_way;
    else
      what = in_the_way;
  };
  std::optional<std::vector<std::string>>& instructions = scope.left_out.instructions;
  add(instructions, are_counted, found.to_instructions);
  if (std::ranges::any_of(matches,
                          [](const Match& match) { return are_counted(match) && !are_counts_comparable(match); })) {
    if (!instructions) instructions.emplace();
    instructions->push_back("/cases are counted by other means, or of other frames");
  }
  if (!is_paired) add(scope.left_out.times, are_timed, found.to_times);
  return scope;
}

const char* hint_of(measure::Verdict verdict) {
  return verdict == measure::Verdict::slower ? "longer" : verdict == measure::Verdict::faster ? "shorter" : "none";
}

struct Settings {
  double threshold = 0.0;
  bool gates_separate = false, is_margin_same = true, is_same_program = false;
};

// A program compared with itself is the same, independent of the measured times.
void add_time(ComparedCase& out, const TimeChange& time, double corrected_p, const Settings& settings) {
  const measure::Verdict verdict = settings.is_same_program
                                       ? measure::Verdict::same
                                       : measure::verdict_on(time.change, corrected_p, settings.threshold);
  if (time.launches.empty() && !settings.gates_separate) {
    out.hint = hint_of(verdict);
  } else {
    out.verdict = measure::name_of(verdict);
    out.p_corrected = corrected_p;
  }
  add_ratio(out, time.change);
  out.base_ns = time.base_ns;
  out.new_ns = time.next_ns;
  out.launches = time.launches.size();
}

Json margin_of(const Result& result) {
  const Json* margin = value_at(result.config, "/allocation/margin");
  return margin == nullptr ? Json() : *margin;
}

ComparedCase compared(const Match& match, const Times& times, const Scope& scope, const Settings& settings) {
  ComparedCase out{.id = match.next.id, .name = match.next.name};
  if (const auto index = times.index_of(match)) add_time(out, times.at(*index), times.corrected_p(*index), settings);
  ExactDifferences exact = exact_differences(match.base, match.next, settings.is_margin_same);
  out.counts = exact.counts;
  out.differences = std::move(exact.differences);
  out.place = exact.place;
  add_list_difference(match, out);
  if (!scope.left_out.instructions && are_counts_comparable(match))
    out.instructions = compared_instructions(*match.base.count, *match.next.count, settings.threshold);
  return out;
}

result::ComparisonSummary summary_of(const std::vector<ComparedCase>& cases, const Times& times) {
  const auto count_of = [&](auto member, const char* value) {
    return static_cast<std::uint64_t>(std::ranges::count(cases, value, member));
  };
  result::ComparisonSummary out{.cases = cases.size(),
                                .methods_timed = times.count(),
                                .faster = count_of(&ComparedCase::verdict, "faster"),
                                .slower = count_of(&ComparedCase::verdict, "slower"),
                                .same = count_of(&ComparedCase::verdict, "same"),
                                .inconclusive = count_of(&ComparedCase::verdict, "inconclusive"),
                                .hints_shorter = count_of(&ComparedCase::hint, "shorter"),
                                .hints_longer = count_of(&ComparedCase::hint, "longer"),
                                .counts_better = count_of(&ComparedCase::counts, "better"),
                                .counts_worse = count_of(&ComparedCase::counts, "worse")};
  if (const measure::Change mean = times.mean(); mean.is_known()) add_ratio(out, mean);
  return out;
}

std::string percent_of_ratio(double ratio) {
  return std::isfinite(ratio) ? text("%+.1f %%", 100.0 * (ratio - 1.0)) : "-";
}

std::vector<std::string> failures_of(const Result& next, const std::vector<ComparedCase>& cases) {
  std::vector<std::string> failures = gate_failures(next);
  for (const ComparedCase& compared_case : cases) {
    const std::string name = shown(compared_case.name);
    const auto& verdict = compared_case.verdict;
    if (verdict == "slower") failures.push_back(name + ": slower by " + percent_of_ratio(*compared_case.ratio));
    if (compared_case.counts == "worse") failures.push_back(name + ": what is counted has changed");
    const bool is_time_sure = verdict && compared_case.launches != 0u && verdict != "inconclusive";
    const auto& instructions = compared_case.instructions;
    if (instructions && instructions->verdict == "more" && !is_time_sure)
      failures.push_back(name + ": more instructions, " + percent_of_ratio(instructions->assign_ratio) +
                         " to assign, " + percent_of_ratio(instructions->convert_ratio) + " to convert");
  }
  return failures;
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t k_most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(k_most, names.size()); ++i) text += (i == 0 ? "" : ", ") + shown(names[i]);
  return names.size() > k_most ? text + " and " + std::to_string(names.size() - k_most) + " more" : text;
}

constexpr const char* k_separate_hints =
    "two runs of one program can differ several-fold; hints only, which fail nothing: to gate on time use `run "
    "--baseline-binary`, on a noisy machine `run --count`";
constexpr const char* k_separate_verdicts =
    "--gate-separate: two runs of one program can differ several-fold, and intervals know nothing of that; on a busy "
    "machine every second comparison of a program with itself failed";

// The names that only one side has, without cases of the same name on both sides, which are reported separately with
// the difference.
std::vector<std::string> without_renamed(std::vector<std::string> names,
                                         const std::vector<RenamedCase>& renamed_cases) {
  std::erase_if(names, [&](const std::string& name) {
    return std::ranges::find(renamed_cases, name, &RenamedCase::name) != renamed_cases.end();
  });
  return names;
}

// `is_beside`: one result, compared with its baseline program.
std::vector<std::string> warnings_of(const Result& base, const Result& next, const Comparison& comparison,
                                     bool is_beside, const std::vector<std::string>& forced, bool gates_separate) {
  std::vector<std::string> warnings;
  for (const std::string& obstacle : forced) warnings.push_back("compared all the same: " + obstacle);
  const auto& [instructions, times] = comparison.left_out;
  if (instructions) warnings.push_back("instructions are not compared: " + joined(*instructions, "; "));
  if (times) warnings.push_back("times are not compared: " + joined(*times, "; "));
  if (comparison.data == "separate" && comparison.summary.methods_timed != 0)
    warnings.emplace_back(gates_separate ? k_separate_verdicts : k_separate_hints);
  if (margin_of(base) != margin_of(next) && !comparison.cases.empty())
    warnings.push_back("allocation.margin is " + margin_of(base).dump() + " and " + margin_of(next).dump() +
                       ", another setting: what is recommended follows it and is not compared");
  const std::vector<std::string> only_in_base = without_renamed(comparison.only_in_base, comparison.renamed),
                                 only_in_new = without_renamed(comparison.only_in_new, comparison.renamed);
  if (!only_in_base.empty()) warnings.push_back("only in the base, not compared: " + listed(only_in_base));
  if (!only_in_new.empty())
    warnings.push_back(std::string(is_beside ? "the other program does not have them, not compared: "
                                             : "only in the new result, not compared: ") +
                       listed(only_in_new));
  std::map<std::string, std::vector<std::string>> by_reason;
  for (const RenamedCase& renamed_case : comparison.renamed)
    by_reason[joined(renamed_case.differs_in)].push_back(renamed_case.name);
  for (const auto& [reason, names] : by_reason)
    warnings.push_back("of one name, but not the same, so not compared: they differ in " + reason + ": " +
                       listed(names));
  for (const PartOfOne& part : comparison.not_compared)
    warnings.push_back(part.part + " is not compared in " + number_of(part.cases, "case") + ": only the " +
                       (part.only_in == "base" ? "base" : "new result") + " has it");
  if (is_beside)
    warnings.emplace_back(
        "times and lists of both programs were compared; bytes, samples and whatever else is counted were not: that "
        "takes a result of the other program");
  return warnings;
}

// "cold" or "warm"; none without times.
std::optional<std::string> caches_of_times(const Result& result) {
  for (const Case& result_case : result.cases)
    if (result_case.timing) return result_case.timing->caches.value_or("warm");
  return {};
}

// The fields that figures depend on, at their place in a result.
Json facts_of(const Result& result) {
  return {
      {"machine", result::to_json(result.machine)}, {"tool", result::to_json(result.tool)}, {"config", result.config}};
}

// A missing part that could have failed the comparison.
bool is_gated_part_missing(const Comparison& comparison) {
  return std::ranges::any_of(comparison.not_compared,
                             [](const PartOfOne& part) { return part.only_in == "base" && part.part != "timing"; });
}

}  // namespace

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
  out.to_times = differing({"/machine/cores", "/machine/ram_bytes", "/machine/os"});
  const std::optional<std::string> base_caches = caches_of_times(base), next_caches = caches_of_times(next);
  if (base_caches && next_caches && *base_caches != *next_caches)
    out.to_times.push_back("/cases/*/timing/caches is \"" + *base_caches + "\" and \"" + *next_caches + "\"");
  out.to_times.insert(out.to_times.begin(), out.to_instructions.begin(), out.to_instructions.end());
  return out;
}

Comparison compare_results(const Result& base, const Result& next, double threshold, const CompareOptions& options) {
  const auto [is_paired, is_one] = relation_of(base, next);
  std::vector<Match> matches = matches_of(base, next);
  const std::vector<const Case*> only_in_base = missing_from(next, base);
  std::vector<const Case*> only_in_new = missing_from(base, next);
  if (is_one) {  // and the baseline program's
    std::vector<Match> beside;
    for (const Match& match : matches)
      if (result::part<&Case::timing, &Timing::baseline>(match.next) != nullptr)
        beside.push_back(match);
      else
        only_in_new.push_back(&match.next);
    matches.swap(beside);
  }
  const Scope scope = scope_of(base, next, matches, is_paired, options.is_forced);
  const Times times = scope.left_out.times ? Times() : Times(matches, is_paired);
  Comparison out{.comparison_version = 1,
                 .threshold = threshold,
                 .data = is_paired ? "paired" : "separate",
                 .time = is_paired ? "assign" : "frame",
                 .base = {is_paired ? next.baseline->tool : base.tool},
                 .next = {next.tool},
                 .left_out = scope.left_out};
  const bool is_same_program = is_paired && next.baseline->is_same_program.value_or(false);
  if (is_same_program) out.is_same_program = true;
  const Settings settings{threshold, options.gates_separate, margin_of(base) == margin_of(next), is_same_program};
  for (const Match& match : matches) out.cases.push_back(compared(match, times, scope, settings));
  out.summary = summary_of(out.cases, times);
  out.only_in_base = names_of(only_in_base);
  out.only_in_new = names_of(only_in_new);
  out.renamed = renamed(base, only_in_base, next, only_in_new);
  out.not_compared = parts_of_one(matches);
  out.failures = failures_of(next, out.cases);
  out.warnings = warnings_of(base, next, out, is_one, scope.forced, options.gates_separate);
  if (const std::vector<std::string> advice = advice_on(out); !advice.empty()) out.advice = advice;
  return out;
}

ExitCode outcome(const Comparison& comparison, bool is_strict) {
  if (comparison.cases.empty()) return ExitCode::nothing_comparable;
  if (!comparison.failures.empty()) return ExitCode::gate_failed;
  const bool is_open = comparison.summary.inconclusive != 0 || !comparison.only_in_base.empty() ||
                       comparison.left_out.instructions || is_gated_part_missing(comparison);
  return is_strict && is_open ? ExitCode::inconclusive : ExitCode::ok;
}

}  // namespace clusterbench::report
