#include "report/comparing/compared_case.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "result/at.h"
#include "result/rounding.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::ComparedCase;
using result::PerFrame;
using result::Timing;

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

const char* hint_of(measure::Verdict verdict) {
  return verdict == measure::Verdict::slower ? "longer" : verdict == measure::Verdict::faster ? "shorter" : "none";
}

void add_time(ComparedCase& out, const TimeChange& time, double corrected_p, const CompareSettings& settings) {
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

}  // namespace

ComparedCase compare_case(const Match& match, const TimeChanges& times, const result::NotComparable& left_out,
                          const CompareSettings& settings) {
  ComparedCase out{.id = match.next.id, .name = match.next.name};
  if (const auto index = times.index_of(match)) add_time(out, times.at(*index), times.corrected_p(*index), settings);
  ExactDifferences exact = exact_differences(match.base, match.next, settings.same);
  out.counts = exact.counts;
  out.differences = std::move(exact.differences);
  out.place = exact.place;
  if (settings.is_paired) add_list_difference(match, out);
  if (!left_out.instructions && are_counts_comparable(match))
    out.instructions = compared_instructions(*match.base.count, *match.next.count, settings.threshold);
  return out;
}

}  // namespace clusterbench::report
