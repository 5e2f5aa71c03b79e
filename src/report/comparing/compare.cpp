#include "report/comparing/compare.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/text.h"
#include "report/cases/columns.h"
#include "report/cases/failures.h"
#include "report/cases/json_values.h"
#include "report/comparing/comparability.h"
#include "report/comparing/compare_advice.h"
#include "report/comparing/compare_warnings.h"
#include "report/comparing/compared_case.h"
#include "report/comparing/matched_cases.h"
#include "report/comparing/time_changes.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::BrokenCase;
using result::Case;
using result::ComparedCase;
using result::Comparison;
using result::PartOfOne;
using result::Result;
using result::Timing;

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

std::vector<std::string> names_of(const std::vector<const Case*>& cases) {
  std::vector<std::string> names;
  for (const Case* result_case : cases) names.push_back(result_case->name);
  return names;
}

result::ComparisonSummary summary_of(const std::vector<ComparedCase>& cases, const TimeChanges& times) {
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

// Cases of the base that broke in the new result.
std::vector<BrokenCase> broken_of(const Result& base, const Result& next) {
  std::vector<BrokenCase> out;
  if (!next.broken) return out;
  const auto is_of_base = [&](const BrokenCase& broken) {
    return std::ranges::find(base.cases, broken.id, &Case::id) != base.cases.end() ||
           (base.broken && std::ranges::find(*base.broken, broken.id, &BrokenCase::id) != base.broken->end());
  };
  std::ranges::copy_if(*next.broken, std::back_inserter(out), is_of_base);
  return out;
}

std::vector<std::string> failures_of(const Result& base, const Result& next, const std::vector<ComparedCase>& cases) {
  std::vector<std::string> failures = gate_failures(next);
  for (const BrokenCase& broken : broken_of(base, next))
    if (std::ranges::find(base.cases, broken.id, &Case::id) != base.cases.end())
      failures.push_back(shown(broken.name) + ": the base has figures of it, and the new result has none");
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

// A missing part that could have failed the comparison.
bool is_gated_part_missing(const Comparison& comparison) {
  return std::ranges::any_of(comparison.not_compared, [](const PartOfOne& part) {
    const bool is_of_times = part.part == "timing" || part.part == "device" || part.part == "reading";
    return part.only_in == "base" && !is_of_times;
  });
}

}  // namespace

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
  const LeftOut omitted = left_out(base, next, matches, is_paired, options.is_forced);
  const TimeChanges times = omitted.parts.times ? TimeChanges() : TimeChanges(matches, is_paired);
  Comparison out{.comparison_version = 1,
                 .threshold = threshold,
                 .data = is_paired ? "paired" : "separate",
                 .time = is_paired ? "assign" : "frame",
                 .base = {is_paired ? next.baseline->tool : base.tool, base.plugins},
                 .next = {next.tool, next.plugins},
                 .left_out = omitted.parts};
  const bool is_same_program = is_paired && next.baseline->is_same_program.value_or(false);
  if (is_same_program) out.is_same_program = true;
  const CompareSettings settings{threshold, options.gates_separate, same_settings(base, next), is_paired,
                                 is_same_program};
  for (const Match& match : matches) out.cases.push_back(compare_case(match, times, omitted.parts, settings));
  out.summary = summary_of(out.cases, times);
  out.only_in_base = names_of(only_in_base);
  out.only_in_new = names_of(only_in_new);
  out.renamed = renamed_cases(base, only_in_base, next, only_in_new);
  out.not_compared = parts_of_one(matches);
  if (std::vector<BrokenCase> broken = broken_of(base, next); !broken.empty()) out.broken = std::move(broken);
  out.failures = failures_of(base, next, out.cases);
  out.warnings = warnings_of(base, next, out, is_one, omitted.forced, options.gates_separate);
  if (const std::vector<std::string> advice = advice_on(out); !advice.empty()) out.advice = advice;
  return out;
}

ExitCode outcome(const Comparison& comparison, bool is_strict) {
  if (comparison.cases.empty() && !comparison.broken) return ExitCode::nothing_comparable;
  if (!comparison.failures.empty()) return ExitCode::gate_failed;
  const bool is_open = comparison.summary.inconclusive != 0 || !comparison.only_in_base.empty() ||
                       comparison.left_out.instructions || is_gated_part_missing(comparison);
  return is_strict && is_open ? ExitCode::inconclusive : ExitCode::ok;
}

}  // namespace clusterbench::report
