// Changes from frame to frame.

#include <limits>

#include "run/records/parts.h"

namespace clusterbench::run {
namespace {

using result::counted;

result::Extremes extremes_record(const Extremes& extremes) {
  if (extremes.count == 0) return {};
  return {counted(extremes.least), counted(extremes.mean()), counted(extremes.greatest)};
}

result::FitSide side_record(const CaseSide& side) {
  result::FitSide out;
  if (side.pairs_mean) out.pairs = counted(*side.pairs_mean);
  out.true_pairs = side.true_pairs;
  out.false_positives = side.false_positives;
  if (side.list_changes) out.lists_changed = counted(side.list_changes->share());
  out.index_entries = side.index_entries;
  out.bytes = side.bytes;
  for (const EvaluatedLights& set : side.evaluated) {
    out.evaluated.push_back({set.set, set.evaluated});
    out.missed.push_back({set.set, set.missed});
  }
  return out;
}

double share_saved(double with, double without) {
  return counted(1.0 - with / without);
}

template <class T>
std::optional<double> share_saved(const std::optional<T>& with, const std::optional<T>& without) {
  if (!with) return {};
  const auto number = [](const std::optional<T>& value) {
    return value ? static_cast<double>(*value) : result::k_none;
  };
  return share_saved(number(with), number(without));
}

// For figures that both sides have: 1 - with / without.
result::Saved saved_record(const result::FitSide& with, const result::FitSide& without) {
  result::Saved out;
  out.pairs = share_saved(with.pairs, without.pairs);
  out.false_positives = share_saved(with.false_positives, without.false_positives);
  out.lists_changed = share_saved(with.lists_changed, without.lists_changed);
  out.index_entries = share_saved(static_cast<double>(with.index_entries), static_cast<double>(without.index_entries));
  out.bytes = share_saved(static_cast<double>(with.bytes), static_cast<double>(without.bytes));
  for (std::size_t i = 0; i < with.evaluated.size(); ++i)
    out.evaluated.push_back({with.evaluated[i].first, share_saved(static_cast<double>(with.evaluated[i].second),
                                                                  static_cast<double>(without.evaluated[i].second))});
  return out;
}

result::Churn churn_record(const measure::Churn& churn) {
  return {churn.changes, counted(churn.mean_changes()), churn.most_changes};
}

std::int64_t difference(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b);
}

}  // namespace

result::Fit fit_record(const FitResult& fit) {
  const GridMoves& moves = fit.moves;
  result::Fit out;
  out.to = grid::name_of(fit.fit.to);
  out.damping = fit.fit.damping;
  out.step = fit.fit.step;
  out.asked = {counted(fit.range.near_m), counted(fit.range.far_m)};
  out.near = extremes_record(moves.near_m);
  out.far = extremes_record(moves.far_m);
  out.moves = {static_cast<std::uint64_t>(moves.steps), static_cast<std::uint64_t>(moves.changed),
               counted(moves.cells_changed / moves.steps), extremes_record(moves.moved)};
  out.fitted = side_record(fit.fitted);
  out.unfitted = side_record(fit.unfitted);
  out.saved = saved_record(out.fitted, out.unfitted);
  return out;
}

result::Reaction reaction_record(const ReactionResult& reaction) {
  const TileMoves& moves = reaction.moves;
  result::Reaction out;
  out.to = grid::name_of(reaction.reaction.to);
  out.most = static_cast<std::uint64_t>(reaction.reaction.most);
  if (!reaction.reaction.of.empty()) out.of = reaction.reaction.of;
  if (reaction.reaction.most_lights > 0) out.most_lights = static_cast<std::uint64_t>(reaction.reaction.most_lights);
  out.tiles = {counts_record(moves.requested), counts_record(moves.fewest), extremes_record(moves.tiles)};
  out.needed = extremes_record(moves.amount);
  out.frames = {static_cast<std::uint64_t>(moves.reacted), static_cast<std::uint64_t>(moves.over)};
  out.moves = {static_cast<std::uint64_t>(moves.steps), static_cast<std::uint64_t>(moves.changed)};
  out.reacting = side_record(reaction.reacting);
  if (!reaction.fixed) return out;
  out.fixed = side_record(*reaction.fixed);
  out.saved = saved_record(out.reacting, *out.fixed);
  return out;
}

result::Fallback fallback_record(const FallbackResult& fallback) {
  const result::FitSide limited = side_record(fallback.limited), roomy = side_record(fallback.roomy);
  return {static_cast<std::uint64_t>(fallback.frames), fallback.cells, limited, roomy, saved_record(limited, roomy)};
}

result::Stability stability_record(const StabilityResult& s) {
  result::Stability out;
  out.steps = static_cast<std::uint64_t>(s.method.steps);
  out.step_m = counted(s.step_m);
  out.step_deg = counted(s.step_deg);
  out.window = static_cast<std::uint64_t>(s.window);
  out.from_frame = static_cast<std::uint64_t>(s.from_frame);
  out.drift = s.is_drift;
  out.path = s.path;
  out.grids = static_cast<std::uint64_t>(s.grids);
  out.changed = {churn_record(s.method), churn_record(s.truth)};
  out.flickers = {s.method.flickers, s.truth.flickers};
  out.excess_churn = {difference(s.method.changes, s.truth.changes),
                      counted(measure::excess_ratio(s.method.changes, s.truth.changes))};
  out.excess_flickers = {difference(s.method.flickers, s.truth.flickers),
                         counted(measure::excess_ratio(s.method.flickers, s.truth.flickers))};
  out.undecided = s.undecided;
  return out;
}

}  // namespace clusterbench::run
