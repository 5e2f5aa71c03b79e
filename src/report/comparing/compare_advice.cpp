#include "report/comparing/compare_advice.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/text.h"
#include "report/cases/columns.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::ComparedCase;
using result::Comparison;
using result::Result;

// In percent, rounded up to one decimal.
std::string percent_up(double share) {
  return text("%g %%", std::ceil(1000.0 * share - 1e-9) / 10.0);
}

struct OpenVerdict {
  double change = 0.0, half_width = 0.0;  // of ln(new / base)
  double launches = 0.0;
};

// Inconclusive verdicts with an interval; `without`: the number of those without.
std::vector<OpenVerdict> open_verdicts(const Comparison& comparison, std::size_t& without) {
  std::vector<OpenVerdict> open;
  for (const ComparedCase& compared_case : comparison.cases) {
    if (compared_case.verdict != "inconclusive") continue;
    const auto [low, high] = *compared_case.ci95;
    const double ratio = *compared_case.ratio;
    if (std::isfinite(low) && std::isfinite(high) && std::isfinite(ratio) && low > 0.0 && ratio > 0.0)
      open.push_back({std::log(ratio), 0.5 * std::log(high / low), static_cast<double>(*compared_case.launches)});
    else
      ++without;
  }
  return open;
}

// The width of an interval falls with the square root of the number of launches.
double launches_needed(const OpenVerdict& verdict, double limit) {
  const double room = std::max(0.25 * limit, std::abs(limit - std::abs(verdict.change)));
  return verdict.launches * std::pow(verdict.half_width / room, 2.0);
}

std::string advice_on_open(const Comparison& comparison, const std::vector<OpenVerdict>& open) {
  const double limit = std::log1p(comparison.threshold);
  double widest = 0.0, shows = 0.0, launches = 0.0;
  for (const OpenVerdict& verdict : open) {
    widest = std::max(widest, verdict.half_width);
    shows = std::max(shows, std::abs(verdict.change) + verdict.half_width);
    launches = std::max(launches, launches_needed(verdict, limit));
  }
  const std::string begin =
      number_of(open.size(), "case") +
      (open.size() == 1 ? " is inconclusive: its interval reaches " : " are inconclusive: their intervals reach ") +
      percent_up(std::expm1(widest)) + " to either side, and the threshold is " +
      text("%g %%", 100.0 * comparison.threshold) + ". ";
  const std::string less = "count instructions, which hardly vary (`run --count` with both programs, then `compare`)";
  if (comparison.data != "paired")
    return begin + "Measure both programs side by side (`run --baseline-binary`), or " + less;
  constexpr double k_most = 1000.0;  // of --baseline-launches
  const double round_launches = 10.0 * std::ceil(launches / 10.0);
  const std::string more = round_launches <= k_most
                               ? "Start both programs about " + text("%.0f", round_launches) +
                                     " times (--baseline-launches " + text("%.0f", round_launches) +
                                     " --baseline-most-launches " + text("%.0f", round_launches) + "), "
                               : "Free the machine of other work, ";
  return begin + more + "ask for what these times show (--threshold " +
         percent_up(std::expm1(shows)).substr(0, percent_up(std::expm1(shows)).find(' ')) + "), or " + less;
}

std::string advice_on_same_program(const Comparison& comparison) {
  double most = 0.0;
  bool is_known = false;
  for (const ComparedCase& compared_case : comparison.cases)
    for (const double bound : compared_case.ci95.value_or(result::Pair{}))
      if (std::isfinite(bound) && bound > 0.0) {
        most = std::max(most, std::abs(bound - 1.0));
        is_known = true;
      }
  return std::string("no difference: both are the same program, byte for byte") +
         (is_known ? ", and beside itself its times differ by at most " + percent_up(most) +
                         " (95 % intervals): a change below that does not show here"
                   : "; two launches tell no interval, --baseline-launches 10 does");
}

// Whether some case of each has the same value.
template <class Get>
bool share(const Result& base, const Result& next, Get get) {
  std::set<std::string> answers;
  for (const Case& base_case : base.cases) answers.insert(get(base_case));
  return std::ranges::any_of(next.cases, [&](const Case& next_case) { return answers.contains(get(next_case)); });
}

}  // namespace

std::vector<std::string> advice_on(const Comparison& comparison) {
  if (comparison.is_same_program.value_or(false)) return {advice_on_same_program(comparison)};
  std::vector<std::string> lines;
  std::size_t without = 0;
  const std::vector<OpenVerdict> open = open_verdicts(comparison, without);
  if (!open.empty()) lines.push_back(advice_on_open(comparison, open));
  if (without > 0)
    lines.push_back(number_of(without, "case") + (without == 1 ? " is" : " are") +
                    " inconclusive for want of an interval, which takes several launches: " +
                    (comparison.data == "paired" ? "--baseline-launches 10" : "--launches 5"));
  return lines;
}

std::string advice_on_nothing(const Result& base, const Result& next, const std::string& base_name,
                              const std::string& next_name) {
  const std::string begin = "the results have no case in common: ";
  const std::string both = shown(base_name) + " " + shown(next_name);
  const std::string before_and_after =
      "of a level before and after a change `clusterbench run ... --baseline " + shown(base_name) +
      " --allow-changed-lights` says old and new figures, and fails by budgets (--fail-if 'index_entries > +5 %')";
  if (!share(base, next, [](const Case& one) { return one.scene; })) {
    const bool may_be_renamed = base.scenes.size() == 1 && next.scenes.size() == 1;
    return begin + "they are of other scenes (`clusterbench report " + both +
           " -o both.html` shows them side by side)" + (may_be_renamed ? "; " + before_and_after : "");
  }
  if (!share(base, next, [](const Case& one) { return one.grid.name; }))
    return begin +
           "their grids differ. To hold grids against each other, measure them in one run (--grid, --tiles and " +
           "--slices take lists) and ask `clusterbench ratio RESULT --across-grids`; `clusterbench report " + both +
           " -o both.html` shows both results";
  if (share(base, next, [](const Case& one) { return one.name; }))
    return begin + "the level or a setting has changed, as told above; " + before_and_after +
           "; `clusterbench history` shows how they move";
  if (!share(base, next, [](const Case& one) { return one.assigner.label; }))
    return begin + "their methods differ. Measure them in one run and ask `clusterbench ratio RESULT`";
  return begin + "they differ in camera, viewport, grid, method or storage in every case (`clusterbench report " +
         both + " -o both.html` shows them side by side)";
}

}  // namespace clusterbench::report
