#include "run/gate.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "core/text.h"

namespace clusterbench::run {
namespace {

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100.0 * share);
  return text;
}

// Without cells there are no pairs to hold against the truth, and no cell boundary where a lookup may round.
bool has_cells(const CaseResult& one) {
  return one.occupancy.has_value();
}

std::string lost_text(const CaseResult& one) {
  const measure::ErrorCounts& error = *one.error;
  std::string text =
      "lost " + std::to_string(error.false_negatives) + " of " + number_of(error.true_pairs, "true pair");
  if (!error.deepest) return text;
  const measure::Miss& deepest = *error.deepest;
  const auto nx = one.grid["cells"][0].get<std::uint32_t>(), ny = one.grid["cells"][1].get<std::uint32_t>();
  return text + "; deepest in frame " + std::to_string(deepest.frame) + ", cell [" + std::to_string(deepest.cell % nx) +
         "," + std::to_string(deepest.cell / nx % ny) + "," + std::to_string(deepest.cell / nx / ny) + "], light " +
         std::to_string(deepest.light) + " ('" + one.deepest_miss_light + "'), " + percent(error.deepest_miss) +
         " of its range inside";
}

std::string worst_text(const CaseResult& one) {
  if (!one.shading->worst) return "";
  const measure::ShadingCounts::WorstFrame& worst = *one.shading->worst;
  return "; most in frame " + std::to_string(worst.frame) + ", " + std::to_string(worst.missed) + " of " +
         std::to_string(worst.needed);
}

// What a lookup finds whose arithmetic is that of the samples; other ways err by themselves.
const measure::LookupCounts* plain_lookup(const CaseResult& one) {
  for (const measure::LookupCounts& counts : one.lookup)
    if (counts.way.logarithm == measure::Logarithm::rounded && counts.way.depth == measure::DepthRead::given)
      return &counts;
  return nullptr;
}

bool misses_without_cells(const CaseResult& one) {
  if (has_cells(one)) return false;
  const measure::LookupCounts* lookup = plain_lookup(one);
  return (one.shading && one.shading->missed > 0) || (lookup != nullptr && lookup->missed > 0);
}

std::string missed_without_cells_text(const CaseResult& one) {
  if (one.shading && one.shading->missed > 0)
    return "lost " + std::to_string(one.shading->missed) + " of " + number_of(one.shading->needed, "light") +
           " that its samples need" + worst_text(one);
  const measure::LookupCounts& lookup = *plain_lookup(one);
  return "lost " + std::to_string(lookup.missed) + " of " + number_of(lookup.needed, "light") +
         " that the samples of its lookup need";
}

bool is_unlit(const CaseResult& one) {
  return one.shading && one.shading->needed > 0 && one.shading->unlit() > measure::k_most_unlit;
}

std::string dropped_text(const CaseResult& one) {
  const measure::Buffers& buffers = one.buffers;
  return number_of(buffers.dropped_pairs, "pair") + " dropped in " + number_of(buffers.overflowing_cells, "cell") +
         " of " + number_of(static_cast<std::uint64_t>(buffers.overflowing_frames), "frame");
}

std::string unlit_text(const CaseResult& one) {
  const measure::ShadingCounts& shading = *one.shading;
  return percent(shading.unlit()) + " of the lights that samples need are unlit, " +
         percent(shading.lost_irradiance()) +
         " of the irradiance: " + std::to_string(shading.missed - shading.missed_outside) + " in cells, " +
         std::to_string(shading.missed_outside) + " outside of the grid" + worst_text(one);
}

std::string undecided_text(const char* where, std::uint64_t pairs) {
  return std::string(where) + ": " + number_of(pairs, "undecided pair") + " counted as true";
}

}  // namespace

const char* name_of(Failure::Kind kind) {
  constexpr const char* k_names[] = {"lost_pairs", "extra_pairs", "lost_at_samples", "dropped_pairs"};
  return k_names[static_cast<std::size_t>(kind)];
}

const char* name_of(Warning::Kind kind) {
  constexpr const char* k_names[] = {"dropped_pairs", "unlit", "undecided", "lost_pairs", "unchecked"};
  return k_names[static_cast<std::size_t>(kind)];
}

std::vector<Failure> failures_of(const CaseResult& one, const config::LimitsRequest& limits) {
  using Kind = Failure::Kind;
  std::vector<Failure> failures;
  const bool may_not_lose = one.conservative || one.exact;
  if (may_not_lose && one.error && one.error->false_negatives > 0)
    failures.push_back({Kind::lost_pairs, lost_text(one)});
  if (one.exact && one.error && one.error->false_positives > 0)
    failures.push_back({Kind::extra_pairs, "reported " + number_of(one.error->false_positives, "pair") +
                                               " beside the truth, and calls itself exact"});
  if (may_not_lose && misses_without_cells(one))
    failures.push_back({Kind::lost_at_samples, missed_without_cells_text(one)});
  const measure::Buffers& buffers = one.buffers;
  if (limits.dropped_pairs && buffers.dropped_pairs > *limits.dropped_pairs)
    failures.push_back({Kind::dropped_pairs, dropped_text(one) + ", more than limits.dropped_pairs allows (" +
                                                 std::to_string(*limits.dropped_pairs) + ")"});
  return failures;
}

std::vector<Warning> warnings_of(const CaseResult& one) {
  using Kind = Warning::Kind;
  std::vector<Warning> warnings;
  if (one.buffers.dropped_pairs > 0) warnings.push_back({Kind::dropped_pairs, dropped_text(one)});
  if (is_unlit(one)) warnings.push_back({Kind::unlit, unlit_text(one)});
  if (one.error && one.error->undecided > 0)
    warnings.push_back({Kind::undecided, undecided_text("error", one.error->undecided)});
  if (one.stability && one.stability->undecided > 0)
    warnings.push_back({Kind::undecided, undecided_text("stability", one.stability->undecided)});
  if (one.error && one.error->false_negatives > 0 && !one.conservative && !one.exact)
    warnings.push_back({Kind::lost_pairs, lost_text(one)});
  if (has_cells(one) && !one.error) warnings.push_back({Kind::unchecked, "its lists were not held against the truth"});
  return warnings;
}

bool loses_lights(const CaseResult& one) {
  return (one.error && one.error->false_negatives > 0) || one.buffers.dropped_pairs > 0 || misses_without_cells(one) ||
         is_unlit(one);
}

bool is_eligible(const CaseResult& one) {
  return one.failures.empty() && !loses_lights(one);
}

std::optional<measure::Ratio> ratio_between(const Contender& one, const Contender& other, std::uint64_t seed) {
  const measure::FrameTimes own{one.rounds_ns, one.launches, one.is_cold},
      others{other.rounds_ns, other.launches, other.is_cold};
  return one.grid == other.grid ? measure::ratio_of_rounds(own, others, seed)
                                : measure::ratio_of_launches(own, others, seed);
}

std::vector<std::string> on_front(std::span<const Contender> cases, std::uint64_t seed) {
  std::map<std::pair<std::string, std::string>, std::vector<const Contender*>> views;
  for (const Contender& one : cases)
    if (one.is_eligible) views[{one.scene, one.view}].push_back(&one);
  std::vector<std::string> ids;
  for (const auto& one_view : views) {
    const std::vector<const Contender*>& seen = one_view.second;
    std::vector<measure::Costs> costs;
    for (const Contender* one : seen) costs.push_back(one->costs);
    const measure::TakesLonger by_interval = measure::intervals_apart(costs);
    const measure::TakesLonger takes_longer = [&](std::size_t one, std::size_t other) {
      const std::optional<measure::Ratio> ratio = ratio_between(*seen[one], *seen[other], seed);
      return ratio ? measure::takes_longer(ratio) : by_interval(one, other);
    };
    for (const std::size_t place : measure::pareto_front(costs, takes_longer)) ids.push_back(seen[place]->id);
  }
  return ids;
}

}  // namespace clusterbench::run
