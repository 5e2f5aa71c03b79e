#include "report/choosing/answer_conclusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/libraries.h"
#include "core/text.h"
#include "measure/statistics/frame_cost.h"
#include "measure/statistics/time_statistics.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/cases/json_values.h"
#include "report/choosing/conclusion_words.h"

namespace clusterbench::report {
namespace {

using result::Answer;
using result::Candidate;
using result::Objective;

double finite_or(double value, double instead) {
  return std::isfinite(value) ? value : instead;
}

std::string objective_text(const Candidate& record, const Objective& objective) {
  return objective.figure + " " + amount_text(finite_or(record.objective, 0.0));
}

measure::Interval known_interval(const std::optional<result::Pair>& ends) {
  if (!ends || !std::isfinite((*ends)[0]) || !std::isfinite((*ends)[1])) return {};
  return {(*ends)[0], (*ends)[1]};
}

bool is_cost(const Objective& objective) {
  return objective.figure.ends_with("_cost_us");
}

// Whether the candidate counts as equal to the choice: costs within the precision of the model, times within their
// interval or, without one, within the usual variation of times, and equal figures.
bool is_like_choice(const Candidate& record, const Objective& objective) {
  const double by = record.by_choice;
  if (!std::isfinite(by)) return finite_or(record.objective, 0.0) <= 0.0;  // no ratio to a choice of 0
  if (is_cost(objective) && by <= measure::k_alike_ratio) return true;
  if (const measure::Interval interval = known_interval(record.ci95); interval.is_known()) return interval.low <= 1.0;
  return by <= (objective.timed ? measure::k_alike_ratio : 1.0);
}

std::string beside_choice_text(const Candidate& record) {
  return shown(record.name) + " takes " +
         more_text(record.by_choice, known_interval(record.ci95), known_interval(record.by_prices));
}

// The other costs of the choice: " (13.3 MB of buffers, 1072 us of GPU by the model)".
std::string price_text(const Candidate& choice, const Objective& objective) {
  std::vector<std::string> prices;
  const std::optional<double> bytes = candidate_figure(choice, "bytes"),
                              gpu_us = candidate_figure(choice, "gpu_cost_us");
  if (bytes && objective.figure != "bytes") prices.push_back(bytes_text(*bytes) + " of buffers");
  if (gpu_us && !is_cost(objective)) prices.push_back(ns_text(1e3 * *gpu_us) + " of GPU by the model");
  return prices.empty() ? "" : " (" + joined(prices) + ")";
}

// Why a candidate with a smaller figure is not better for certain.
std::string why_alike(const Candidate& record, const Objective& objective) {
  if (is_cost(objective) && record.by_choice * measure::k_alike_ratio >= 1.0)
    return "within the 5 % to which the model tells costs apart";
  const measure::Interval interval = known_interval(record.ci95);
  if (!interval.is_known()) return "which was not measured often enough to tell them apart";
  return "which these times do not tell from no difference (95 % interval: " + less_or_more(interval.low) + " to " +
         less_or_more(interval.high) + ")";
}

// Why the choice does not have the smallest figure: among equal candidates it has the fewest bytes.
std::string smallest_text(const Answer& answer, const Objective& objective) {
  const Candidate* least = nullptr;
  for (const Candidate& record : answer.runners_up) {
    const double by = finite_or(record.by_choice, 1.0);
    if (by < 1.0 && (least == nullptr || by < least->by_choice)) least = &record;
  }
  const std::optional<double> bytes = candidate_figure(*answer.choice, "bytes");
  const std::optional<double> more_bytes = least != nullptr ? candidate_figure(*least, "bytes") : std::nullopt;
  if (!bytes || !more_bytes || *bytes >= *more_bytes) return "";
  const std::string name = shown(least->name), less = less_or_more(least->by_choice);
  // The ratio of times measured side by side, which is not the ratio of the two figures.
  const bool is_measured = known_interval(least->ci95).is_known();
  return "; " + name + " takes " + less +
         (is_measured ? " where both were measured side by side" : " (" + objective_text(*least, objective) + ")") +
         ", " + why_alike(*least, objective) + ", and needs " + bytes_text(*more_bytes) + " in place of " +
         bytes_text(*bytes);
}

// "bytes <= 1000 rejects all 32 candidates".
std::string rejecting_text(const result::ConstraintOfAnswer& row, std::uint64_t candidates) {
  const bool is_all = row.excluded == candidates;
  const std::string rejected =
      is_all && candidates == 1 ? "the only candidate" : (is_all ? "all " : "") + number_of(row.excluded, "candidate");
  return shown(row.constraint) + " rejects " + rejected;
}

// ": bytes <= 1000 rejects all 32 candidates, unlit = 0 rejects 4", those that reject most.
std::string excluding_text(const Answer& answer) {
  constexpr std::size_t k_most = 3;
  std::vector<const result::ConstraintOfAnswer*> excluding;
  for (const result::ConstraintOfAnswer& row : answer.constraints)
    if (row.excluded > 0) excluding.push_back(&row);
  std::ranges::stable_sort(excluding, std::greater<>(), &result::ConstraintOfAnswer::excluded);
  excluding.resize(std::min(excluding.size(), k_most));
  std::vector<std::string> texts;
  for (const result::ConstraintOfAnswer* row : excluding) texts.push_back(rejecting_text(*row, answer.candidates));
  return texts.empty() ? "" : ": " + joined(texts);
}

// Why the search is no proof that no candidate satisfies all constraints; "" if it is one.
std::string provisional_text(const Answer& answer) {
  if (answer.provisional == 0) return "";
  const bool is_one = answer.provisional == 1;
  return ". " + number_of(answer.provisional, "candidate") + (is_one ? " was" : " were") +
         " measured on some frames only and could satisfy all constraints on all frames; " +
         (is_one ? "it was not" : "none of them was") + " among the best that were kept";
}

// Recommends none, and names possible candidates.
std::string none_text(const Answer& answer, const Objective& objective) {
  const std::vector<Candidate>& searched = answer.searched;
  if (searched.empty())
    return "take none: no candidate satisfies all constraints" + excluding_text(answer) + provisional_text(answer);
  return "take none: no candidate with lists satisfies all constraints; " + shown(searched[0].name) +
         ", which samples search, does (" + objective_text(searched[0], objective) +
         "), and no GPU has measured such a search";
}

}  // namespace

std::optional<double> candidate_figure(const Candidate& candidate, const std::string& name) {
  for (const auto& [figure, value] : candidate.figures)
    if (figure == name && std::isfinite(value)) return value;
  return {};
}

std::string text_of_nothing_seen(const Answer& answer) {
  return answer.nothing_seen ? "nothing to recommend: " + *answer.nothing_seen : "";
}

std::string answer_conclusion(const Answer& answer, const Objective& objective) {
  std::string out = shown(answer.scene) + ", " + viewport_text(answer.viewport) + ": ";
  if (const std::string unseen = text_of_nothing_seen(answer); !unseen.empty()) return out + unseen + ".";
  if (!answer.choice) return out + none_text(answer, objective) + ".";
  const Candidate& choice = *answer.choice;
  out += "take " + shown(choice.name) + "; " + objective_text(choice, objective) + price_text(choice, objective) +
         smallest_text(answer, objective);
  std::vector<std::string> alike;
  const Candidate* against = nullptr;
  for (const Candidate& record : answer.runners_up) {
    if (is_like_choice(record, objective))
      alike.push_back(shown(record.name));
    else if (against == nullptr && std::isfinite(record.by_choice))
      against = &record;
  }
  if (against != nullptr) out += "; " + beside_choice_text(*against);
  if (!alike.empty()) out += ". " + alike_title(is_cost(objective), objective.timed) + ": " + joined(alike);
  const result::Json* method = value_at(choice.assigner, "/name");
  if (const std::string limit = at_surfaces_text(method == nullptr ? "" : method->get<std::string>()); !limit.empty())
    out += ". It " + limit;
  if (answer.no_reader)
    out += ". `size --format hlsl` (glsl) has no function that reads its lists: " + shown(*answer.no_reader);
  const std::vector<Candidate>& searched = answer.searched;
  if (!searched.empty() && finite_or(searched[0].by_choice, 1.0) < 1.0)
    out += ". " + shown(searched[0].name) + ", which samples search, would have " +
           objective_text(searched[0], objective) + "; no GPU has measured such a search";
  if (std::isfinite(answer.needed_at_samples)) out += few_samples_text(answer.needed_at_samples, answer.samples);
  if (std::isfinite(answer.ground_m))
    out += ". Samples lie on a floor at y = " + height_text(answer.ground_m) + " m, since the scene has no triangles";
  if (!answer.blind_cameras.empty()) {
    std::vector<std::string> names;
    for (const std::string& name : answer.blind_cameras) names.push_back(shown(name));
    out += ". Without " + std::string(names.size() == 1 ? "camera " : "cameras ") + joined(names) +
           ", in whose frames no light that shines is in view";
  }
  if (answer.random_depths)
    out += ". Samples are at random depths, " +
           remedy_text(is_built_in(Library::embree) ? UnseenSurfaces::no_triangles : UnseenSurfaces::no_embree);
  return out + ".";
}

}  // namespace clusterbench::report
