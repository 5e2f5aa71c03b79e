#include "run/findings/gate.h"

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

// Without cells there are no pairs to compare with the truth, and no cell boundaries at which a lookup may round.
bool has_cells(const CaseResult& result) {
  return result.occupancy.has_value() || result.cells_not_compared > 0;
}

// Conservative and exact methods may not lose a light, except for lights that a pre-cull removes.
bool may_not_lose(const CaseResult& result) {
  const bool gets_all = !result.pre_cull || result.pre_cull->counts.conservative;
  return result.conservative || (result.exact && gets_all);
}

// True pairs of lights outside the view, which a preset's engine culls: their cells are not visible.
std::uint64_t pairs_culled(const CaseResult& result) {
  if (!result.error || result.preset.empty() || !result.pre_cull) return 0;
  const PreCullCounts& counts = result.pre_cull->counts;
  return std::min(result.error->false_negatives, counts.lost_pairs - counts.lost_to_limits);
}

// True pairs that are not listed, without the culled ones.
std::uint64_t pairs_lost(const CaseResult& result) {
  return result.error ? result.error->false_negatives - pairs_culled(result) : 0;
}

// Where most pairs of a shader of the user's own are lost, its description is the likelier fault.
std::string description_text(const CaseResult& result) {
  const measure::ErrorCounts& error = *result.error;
  const assign::AssignerDescriptor* method = assign::find_assigner(result.assigner);
  if (method == nullptr || !method->origin || !method->on_device || 2 * error.false_negatives < error.true_pairs)
    return "";
  return "; --write-dump FOLDER and `clusterbench check FOLDER` find out whether another description fits better";
}

std::string lost_text(const CaseResult& result) {
  const measure::ErrorCounts& error = *result.error;
  const std::uint64_t culled = pairs_culled(result);
  std::string text = "lost " + std::to_string(pairs_lost(result)) + " of " + number_of(error.true_pairs, "true pair");
  if (culled > 0)
    return text + ", and leaves out " + std::to_string(culled) + " of lights beside the view, which it culls";
  if (!error.deepest) return text;
  const measure::Miss& deepest = *error.deepest;
  const Vec3i cells = cells_in(result, deepest.frame);
  const auto nx = static_cast<std::uint32_t>(cells.x), ny = static_cast<std::uint32_t>(cells.y);
  return text + "; deepest in frame " + std::to_string(deepest.frame) + ", cell [" + std::to_string(deepest.cell % nx) +
         "," + std::to_string(deepest.cell / nx % ny) + "," + std::to_string(deepest.cell / nx / ny) + "], light " +
         std::to_string(deepest.light) + " ('" + result.deepest_miss_light + "'), " + percent(error.deepest_miss) +
         " of its range inside" + description_text(result);
}

std::string worst_text(const CaseResult& result) {
  if (!result.shading->worst) return "";
  const measure::ShadingCounts::WorstFrame& worst = *result.shading->worst;
  return "; most in frame " + std::to_string(worst.frame) + ", " + std::to_string(worst.missed) + " of " +
         std::to_string(worst.needed);
}

// The counts of the lookup with the same arithmetic as the samples; other lookups have errors of their own.
const measure::LookupCounts* plain_lookup(const CaseResult& result) {
  for (const measure::LookupCounts& counts : result.lookup)
    if (counts.way.logarithm == measure::Logarithm::rounded && counts.way.depth == measure::DepthRead::given)
      return &counts;
  return nullptr;
}

// The first set of samples (or of samples at visible surfaces) that misses a light at a point where the structure has
// an answer; null if none does.
const SampleSetResult* missing_set(const CaseResult& result, bool at_surfaces = false) {
  const auto found = std::ranges::find_if(result.samples, [&](const SampleSetResult& set) {
    return set.counts.missed > set.counts.missed_outside && (!at_surfaces || set.set == measure::SampleSet::opaque);
  });
  return found == result.samples.end() ? nullptr : &*found;
}

bool is_at_surfaces(const CaseResult& result) {
  const assign::AssignerDescriptor* assigner = assign::find_assigner(result.assigner);
  return assigner != nullptr && assigner->at_surfaces;
}

// If cells were not compared with the truth: the samples that miss more lights than lookups can round away; null if
// none do, or if cells were compared. Slices that follow surfaces promise nothing behind them.
struct LackingSamples {
  const measure::ShadingCounts* counts = nullptr;
  measure::SampleSet set = measure::SampleSet::volume;
};
LackingSamples lacking_samples(const CaseResult& result) {
  const auto lacks = [](const measure::ShadingCounts& counts) {
    return counts.needed > 0 && counts.unlit_inside() > measure::k_most_unlit;
  };
  if (result.cells_not_compared == 0) return {};
  if (result.shading && lacks(*result.shading)) return {&*result.shading};
  const auto found = std::ranges::find_if(result.samples, [&](const SampleSetResult& set) {
    return lacks(set.counts) && (!is_at_surfaces(result) || set.set == measure::SampleSet::opaque);
  });
  return found == result.samples.end() ? LackingSamples{} : LackingSamples{&found->counts, found->set};
}

// A method that promises the lights of visible surfaces must list them, except for rounding of lookups and surfaces
// beyond the grid.
bool misses_at_surfaces(const CaseResult& result) {
  if (!is_at_surfaces(result)) return false;
  return std::ranges::any_of(result.samples, [](const SampleSetResult& set) {
    return set.set == measure::SampleSet::opaque && set.counts.unlit_inside() > measure::k_most_unlit;
  });
}

// Misses in the whole view; slices that follow surfaces promise nothing behind them.
std::uint64_t missed_in_view(const CaseResult& result) {
  if (!result.shading) return 0;
  const bool ends_at_surfaces = result.fit && result.fit->fit.needs_surfaces();
  return result.shading->missed - (ends_at_surfaces ? result.shading->missed_outside : 0);
}

bool misses_without_cells(const CaseResult& result) {
  if (has_cells(result)) return false;
  const measure::LookupCounts* lookup = plain_lookup(result);
  return missed_in_view(result) > 0 || missing_set(result, is_at_surfaces(result)) != nullptr ||
         (lookup != nullptr && lookup->missed > 0);
}

// A structure without cells is also queried outside the region of a pre-cull. The method cannot find lights that the
// pre-cull removed.
bool is_lost_by_pre_cull(const CaseResult& result) {
  if (!result.pre_cull || has_cells(result)) return false;
  const auto missed_of = [&](measure::SampleSet set) -> std::uint64_t {
    if (set == measure::SampleSet::volume) return result.shading ? result.shading->missed : 0;
    const auto found = std::ranges::find(result.samples, set, &SampleSetResult::set);
    return found == result.samples.end() ? 0 : found->counts.missed;
  };
  return std::ranges::all_of(result.pre_cull->counts.samples,
                             [&](const LostAtSamples& lost) { return missed_of(lost.set) <= lost.lost; });
}

// "random points in the view need", "opaque samples need".
std::string needing_text(measure::SampleSet set) {
  return set == measure::SampleSet::volume ? "random points in the view need"
                                           : measure::name_of(set) + std::string(" samples need");
}

std::string missed_without_cells_text(const CaseResult& result) {
  if (missed_in_view(result) > 0)
    return "lost " + std::to_string(missed_in_view(result)) + " of " + number_of(result.shading->needed, "light") +
           " that random points in the view need" + worst_text(result);
  if (const SampleSetResult* set = missing_set(result, has_cells(result) || is_at_surfaces(result)))
    return "lost " + std::to_string(set->counts.missed - set->counts.missed_outside) + " of " +
           number_of(set->counts.needed, "light") + " that its " + measure::name_of(set->set) + " samples need";
  // misses_without_cells() holds, and none of the checks above
  const measure::LookupCounts& lookup = *plain_lookup(result);
  return "lost " + std::to_string(lookup.missed) + " of " + number_of(lookup.needed, "light") +
         " that the samples of its lookup need";
}

// The samples that decide about lost lights, with a name for them: visible surfaces if there are any, else points
// anywhere in the view; null without samples.
struct DecidingSamples {
  const measure::ShadingCounts* counts = nullptr;
  const char* words = "";
};
DecidingSamples deciding_samples(const CaseResult& result) {
  for (const SampleSetResult& set : result.samples)
    if (set.set == measure::SampleSet::opaque) return {&set.counts, "visible surfaces"};
  return {result.shading ? &*result.shading : nullptr, "random points in the view"};
}

bool is_unlit(const measure::ShadingCounts& counts) {
  return counts.needed > 0 && counts.unlit() > measure::k_most_unlit;
}

// Tested at the samples that decide about lost lights; if they need no light, at those of the whole view.
bool is_unlit(const CaseResult& result) {
  const measure::ShadingCounts* seen = deciding_samples(result).counts;
  if (seen != nullptr && seen->needed == 0 && result.shading) seen = &*result.shading;
  return seen != nullptr && is_unlit(*seen);
}

std::string dropped_text(const CaseResult& result) {
  const measure::Buffers& buffers = result.buffers;
  return number_of(buffers.dropped_pairs, "pair") + " dropped in " + number_of(buffers.overflowing_cells, "cell") +
         " of " + number_of(static_cast<std::uint64_t>(buffers.overflowing_frames), "frame");
}

// The visible effect of dropped lights at the samples that miss them.
std::string lost_light_text(const CaseResult& result) {
  const auto [counts, words] = deciding_samples(result);
  if (counts == nullptr || !counts->darkest) return "";
  const auto lux = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g lx", value);
    return std::string(text);
  };
  return std::string("; ") + words + " lose " + percent(counts->lost_irradiance()) + " of their irradiance, " +
         lux(counts->lost_lux / static_cast<double>(counts->samples)) + " on average and " +
         lux(counts->darkest->lost_lux) + " at most (frame " + std::to_string(counts->darkest->frame) + ")";
}

std::string unlit_text(const CaseResult& result) {
  const measure::ShadingCounts& shading = *result.shading;
  return percent(shading.unlit()) + " of the lights that random points in the view need are unlit, " +
         percent(shading.lost_irradiance()) +
         " of the irradiance: " + std::to_string(shading.missed - shading.missed_outside) + " in cells, " +
         std::to_string(shading.missed_outside) + " outside of the grid" + worst_text(result);
}

// A light limit that removed lights in a frame.
struct ExceededLimit {
  const PreCullCounts::Step* step = nullptr;  // null if none did
  bool is_of_view = false;  // else of the whole scene: no earlier step removes lights outside the view
};
ExceededLimit exceeded_limit(const CaseResult& result) {
  if (!result.pre_cull) return {};
  bool is_of_view = false;
  for (const PreCullCounts::Step& step : result.pre_cull->counts.steps) {
    is_of_view = is_of_view || step.label == cull::label_of(cull::FrustumStep{});
    if (step.limit && step.frames > 0) return {&step, is_of_view};
  }
  return {};
}

bool misses_dropped_lights(const PreCullCounts& counts) {
  return counts.lost_to_limits > 0 ||
         std::ranges::any_of(counts.samples, [](const LostAtSamples& set) { return set.lost > 0; });
}

std::string limit_text(const CaseResult& result, const ExceededLimit& limit) {
  const PreCullCounts::Step& step = *limit.step;
  const PreCullCounts& counts = result.pre_cull->counts;
  std::string text =
      "its limit of " + number_of(static_cast<std::uint64_t>(*step.limit), "light") +
      (step.label.ends_with(",type)") ? " of each type" : "") + (limit.is_of_view ? " in view" : " in the scene") +
      " is exceeded in " + std::to_string(step.frames) + " of " +
      number_of(static_cast<std::uint64_t>(result.frames), "frame") + ", by up to " +
      std::to_string(static_cast<std::uint64_t>(step.removed.max)) + "; " + number_of(counts.dropped.size(), "light") +
      (counts.dropped.size() == 1 ? " is" : " are") + " lost at least once";
  for (const LostAtSamples& set : counts.samples)
    if (set.has_samples && set.needed > 0 && set.lost > 0)
      text += " (" + percent(static_cast<double>(set.lost) / static_cast<double>(set.needed)) + " of the lights that " +
              needing_text(set.set) + ")";
  return text;
}

// Walks of samples that met other lights than those of the structure, or another cell.
std::uint64_t wrong_readings(const CaseResult& result) {
  std::uint64_t differing = 0;
  if (result.reading)
    for (const SetReading& set : result.reading->sets) differing += set.differing;
  return differing;
}

std::string undecided_text(const char* where, std::uint64_t pairs) {
  return std::string(where) + ": " + number_of(pairs, "undecided pair") + " counted as true";
}

}  // namespace

const char* name_of(Failure::Kind kind) {
  constexpr const char* k_names[] = {"lost_pairs", "extra_pairs", "lost_at_samples", "dropped_pairs", "wrong_readings"};
  return k_names[static_cast<std::size_t>(kind)];
}

const char* name_of(Warning::Kind kind) {
  constexpr const char* k_names[] = {"dropped_pairs", "unlit",           "undecided",      "lost_pairs",
                                     "unchecked",     "too_many_lights", "repeated_lights"};
  return k_names[static_cast<std::size_t>(kind)];
}

std::vector<Failure> failures_of(const CaseResult& result, const config::LimitsRequest& limits) {
  using Kind = Failure::Kind;
  std::vector<Failure> failures;
  if (may_not_lose(result) && result.error && result.error->false_negatives > 0)
    failures.push_back({Kind::lost_pairs, lost_text(result)});
  if (result.exact && result.error && result.error->false_positives > 0)
    failures.push_back({Kind::extra_pairs, "reported " + number_of(result.error->false_positives, "pair") +
                                               " beside the truth, and calls itself exact"});
  if (may_not_lose(result) && (misses_without_cells(result) || misses_at_surfaces(result)) &&
      !is_lost_by_pre_cull(result))
    failures.push_back({Kind::lost_at_samples, missed_without_cells_text(result)});
  else if (const auto [counts, set] = lacking_samples(result); counts != nullptr && may_not_lose(result))
    failures.push_back({Kind::lost_at_samples, "lost " + std::to_string(counts->missed - counts->missed_outside) +
                                                   " of " + number_of(counts->needed, "light") + " that " +
                                                   needing_text(set)});
  if (const std::uint64_t walks = wrong_readings(result); walks > 0)
    failures.push_back({Kind::wrong_readings, "read on " + result.reading->device + ", " + number_of(walks, "walk") +
                                                  " met other lights than the structure has, or another cell: a fault "
                                                  "of the driver or of this program"});
  const measure::Buffers& buffers = result.buffers;
  if (limits.dropped_pairs && buffers.dropped_pairs > *limits.dropped_pairs)
    failures.push_back({Kind::dropped_pairs, dropped_text(result) + ", more than limits.dropped_pairs allows (" +
                                                 std::to_string(*limits.dropped_pairs) + ")"});
  return failures;
}

std::vector<Warning> warnings_of(const CaseResult& result) {
  using Kind = Warning::Kind;
  std::vector<Warning> warnings;
  if (result.buffers.dropped_pairs > 0)
    warnings.push_back({Kind::dropped_pairs, dropped_text(result) + lost_light_text(result)});
  if (result.buffers.repeated_pairs > 0)
    warnings.push_back(
        {Kind::repeated_lights, number_of(result.buffers.repeated_pairs, "time") +
                                    " a light is in a list where it is already; a shader would add it twice"});
  if (const ExceededLimit limit = exceeded_limit(result); limit.step != nullptr)
    warnings.push_back({Kind::too_many_lights, limit_text(result, limit)});
  if (result.shading && is_unlit(*result.shading)) warnings.push_back({Kind::unlit, unlit_text(result)});
  if (result.error && result.error->undecided > 0)
    warnings.push_back({Kind::undecided, undecided_text("error", result.error->undecided)});
  if (result.stability && result.stability->undecided > 0)
    warnings.push_back({Kind::undecided, undecided_text("stability", result.stability->undecided)});
  if (pairs_lost(result) > 0 && !may_not_lose(result)) warnings.push_back({Kind::lost_pairs, lost_text(result)});
  if (result.cells_not_compared > 0)
    warnings.push_back({Kind::unchecked, "its " + number_of(result.cells_not_compared, "cell") +
                                             " were not compared with the truth; its samples were"});
  else if (has_cells(result) && !result.error)
    warnings.push_back({Kind::unchecked, "its lists were not held against the truth"});
  return warnings;
}

bool loses_lights(const CaseResult& result) {
  const bool loses_to_limit = exceeded_limit(result).step != nullptr && misses_dropped_lights(result.pre_cull->counts);
  return pairs_lost(result) > 0 || result.buffers.dropped_pairs > 0 || loses_to_limit || misses_without_cells(result) ||
         lacking_samples(result).counts != nullptr || is_unlit(result);
}

bool is_sound(const CaseResult& result) {
  return result.conservative || result.exact || !result.preset.empty();
}

bool is_eligible(const CaseResult& result) {
  return is_sound(result) && result.failures.empty() && !loses_lights(result);
}

std::optional<measure::Ratio> ratio_between(const Contender& numerator, const Contender& denominator,
                                            std::uint64_t seed) {
  if (numerator.session != denominator.session) return std::nullopt;
  const measure::FrameTimes above{numerator.rounds_ns, numerator.launches, numerator.is_cold},
      below{denominator.rounds_ns, denominator.launches, denominator.is_cold};
  return numerator.grid == denominator.grid ? measure::ratio_of_rounds(above, below, seed)
                                            : measure::ratio_of_launches(above, below, seed);
}

std::vector<std::string> on_front(std::span<const Contender> cases, std::uint64_t seed) {
  std::map<std::pair<std::string, std::string>, std::vector<const Contender*>> views;
  for (const Contender& contender : cases)
    if (contender.is_eligible) views[{contender.scene, contender.view}].push_back(&contender);
  std::vector<std::string> ids;
  for (const auto& view : views) {
    const std::vector<const Contender*>& contenders = view.second;
    std::vector<measure::Costs> costs;
    for (const Contender* contender : contenders) costs.push_back(contender->costs);
    const measure::TakesLonger by_interval = measure::intervals_apart(costs);
    const measure::TakesLonger takes_longer = [&](std::size_t a, std::size_t b) {
      const std::optional<measure::Ratio> ratio = ratio_between(*contenders[a], *contenders[b], seed);
      return ratio ? measure::takes_longer(ratio) : by_interval(a, b);
    };
    for (const std::size_t index : measure::pareto_front(costs, takes_longer)) ids.push_back(contenders[index]->id);
  }
  return ids;
}

}  // namespace clusterbench::run
