#include "report/choosing/answer_conclusion.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/text.h"
#include "measure/statistics/frame_cost.h"
#include "measure/statistics/time_statistics.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/cases/json_values.h"
#include "report/choosing/conclusion_words.h"
#include "result/figures.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string objective_text(const Json& record, const Json& objective) {
  return objective["figure"].get<std::string>() + " " + amount_text(number_at(record, "/objective").value_or(0.0));
}

measure::Interval interval_at(const Json& record, const char* key) {
  const Json* ends = value_at(record, key);
  if (ends == nullptr || !(*ends)[0].is_number() || !(*ends)[1].is_number()) return {};
  return {(*ends)[0].get<double>(), (*ends)[1].get<double>()};
}

bool is_cost(const Json& objective) {
  return objective["figure"].get<std::string>().ends_with("_cost_us");
}

// Modelled costs within what the model can tell, times that differ by less than their interval or, without one, by less
// than times usually do, and equal figures.
bool is_like_choice(const Json& record, const Json& objective) {
  const std::optional<double> by = number_at(record, "/by_choice");
  if (!by) return number_at(record, "/objective").value_or(0.0) <= 0.0;  // beside a choice of nothing there is no ratio
  if (is_cost(objective) && *by <= measure::k_alike_ratio) return true;
  if (const measure::Interval interval = interval_at(record, "/ci95"); interval.is_known()) return interval.low <= 1.0;
  return *by <= (objective["timed"] == true ? measure::k_alike_ratio : 1.0);
}

std::string beside_choice_text(const Json& record) {
  return shown(record["name"].get<std::string>()) + " takes " +
         more_text(record["by_choice"].get<double>(), interval_at(record, "/ci95"), interval_at(record, "/by_prices"));
}

// What the choice takes beside what it was chosen for: " (13.3 MB of buffers, 1072 us of GPU by the model)".
std::string price_text(const Json& choice, const Json& objective) {
  std::vector<std::string> prices;
  const std::optional<double> bytes = number_at(choice, "/figures/bytes"),
                              gpu_us = number_at(choice, "/figures/gpu_cost_us");
  if (bytes && objective["figure"] != "bytes") prices.push_back(bytes_text(*bytes) + " of buffers");
  if (gpu_us && !is_cost(objective)) prices.push_back(ns_text(1e3 * *gpu_us) + " of GPU by the model");
  return prices.empty() ? "" : " (" + joined(prices) + ")";
}

// Why a candidate that takes less is not known to be better than the choice.
std::string why_alike(const Json& record, const Json& objective) {
  if (is_cost(objective) && record["by_choice"].get<double>() * measure::k_alike_ratio >= 1.0)
    return "within the 5 % to which the model tells costs apart";
  const measure::Interval interval = interval_at(record, "/ci95");
  if (!interval.is_known()) return "which was not measured often enough to tell them apart";
  return "which these times do not tell from no difference (95 % interval: " + less_or_more(interval.low) + " to " +
         less_or_more(interval.high) + ")";
}

// Why the choice is not the one with least: of those that are like it, it has the fewest bytes.
std::string smallest_text(const Json& answer, const Json& objective) {
  const Json* least = nullptr;
  for (const Json& record : answer["runners_up"]) {
    const double by = number_at(record, "/by_choice").value_or(1.0);
    if (by < 1.0 && (least == nullptr || by < (*least)["by_choice"].get<double>())) least = &record;
  }
  const std::optional<double> bytes = number_at(answer["choice"], "/figures/bytes");
  const std::optional<double> more_bytes = least != nullptr ? number_at(*least, "/figures/bytes") : std::nullopt;
  if (!bytes || !more_bytes || *bytes >= *more_bytes) return "";
  const std::string name = shown((*least)["name"].get<std::string>()),
                    less = less_or_more((*least)["by_choice"].get<double>());
  // The ratio of times that were measured side by side, which the two figures' own does not give.
  const bool is_measured = interval_at(*least, "/ci95").is_known();
  return "; " + name + " takes " + less +
         (is_measured ? " where both were measured side by side" : " (" + objective_text(*least, objective) + ")") +
         ", " + why_alike(*least, objective) + ", and needs " + bytes_text(*more_bytes) + " in place of " +
         bytes_text(*bytes);
}

// ": bytes <= 1000 rejects all 32 candidates, unlit = 0 rejects 4", those that reject most.
std::string excluding_text(const Json& answer) {
  constexpr std::size_t k_most = 3;
  std::vector<std::pair<std::uint64_t, std::string>> excluding;
  const Json constraints = answer.value("constraints", Json::array());
  for (const Json& row : constraints)
    if (const auto excluded = row["excluded"].get<std::uint64_t>(); excluded > 0)
      excluding.emplace_back(excluded, shown(row["constraint"]));
  std::ranges::stable_sort(excluding, std::greater<>(), &std::pair<std::uint64_t, std::string>::first);
  std::vector<std::string> texts;
  for (const auto& [excluded, constraint] : excluding) {
    if (texts.size() == k_most) break;
    const bool is_all = excluded == answer["candidates"];
    texts.push_back(
        constraint + " rejects " +
        (is_all && excluded == 1 ? "the only candidate" : (is_all ? "all " : "") + number_of(excluded, "candidate")));
  }
  return texts.empty() ? "" : ": " + joined(texts);
}

// That nothing is to be taken, and what could be.
std::string none_text(const Json& answer, const Json& objective) {
  const Json searched = answer.value("searched", Json::array());
  if (searched.empty()) return "take none: no candidate satisfies all constraints" + excluding_text(answer);
  return "take none: no candidate with lists satisfies all constraints; " +
         shown(searched[0]["name"].get<std::string>()) + ", which samples search, does (" +
         objective_text(searched[0], objective) + "), and no GPU has measured such a search";
}

}  // namespace

std::string text_of_nothing_seen(const Json& answer) {
  const Json* why = value_at(answer, "/nothing_seen");
  return why != nullptr && why->is_string() ? "nothing to recommend: " + why->get<std::string>() : "";
}

std::string answer_conclusion(const Json& answer, const Json& objective) {
  std::string out = shown(answer["scene"].get<std::string>()) + ", " +
                    viewport_text(answer["viewport"].get<result::Counts2>()) + ": ";
  const Json& choice = answer["choice"];
  if (const std::string unseen = text_of_nothing_seen(answer); !unseen.empty()) return out + unseen + ".";
  if (choice.is_null()) return out + none_text(answer, objective) + ".";
  out += "take " + shown(choice["name"].get<std::string>()) + "; " + objective_text(choice, objective) +
         price_text(choice, objective) + smallest_text(answer, objective);
  std::vector<std::string> alike;
  const Json* against = nullptr;
  for (const Json& record : answer["runners_up"]) {
    if (is_like_choice(record, objective))
      alike.push_back(shown(record["name"].get<std::string>()));
    else if (against == nullptr && record["by_choice"].is_number())
      against = &record;
  }
  if (against != nullptr) out += "; " + beside_choice_text(*against);
  if (!alike.empty()) out += ". " + alike_title(is_cost(objective), objective["timed"] == true) + ": " + joined(alike);
  const Json* method = value_at(choice, "/assigner/name");
  if (const std::string limit = at_surfaces_text(method == nullptr ? "" : method->get<std::string>()); !limit.empty())
    out += ". It " + limit;
  if (const Json* why = value_at(answer, "/no_reader"); why != nullptr && why->is_string())
    out += ". `size --format hlsl` (glsl) has no function that reads its lists: " + shown(*why);
  const Json searched = answer.value("searched", Json::array());
  if (!searched.empty() && number_at(searched[0], "/by_choice").value_or(1.0) < 1.0)
    out += ". " + shown(searched[0]["name"].get<std::string>()) + ", which samples search, would have " +
           objective_text(searched[0], objective) + "; no GPU has measured such a search";
  if (const std::optional<double> needed = number_at(answer, "/needed_at_samples"))
    out += few_samples_text(*needed, answer.value("samples", Json::array()).get<std::vector<std::string>>());
  if (const std::optional<double> height = number_at(answer, "/ground_m"))
    out += ". Samples lie on a floor at y = " + height_text(*height) + " m, since the scene has no triangles";
  if (const Json blind = answer.value("blind_cameras", Json::array()); !blind.empty()) {
    std::vector<std::string> names;
    for (const Json& name : blind) names.push_back(shown(name));
    out += ". Without " + std::string(names.size() == 1 ? "camera " : "cameras ") + joined(names) +
           ", in whose frames no light that shines is in view";
  }
  if (answer.value("random_depths", false)) out += ". Samples are at random depths, " + remedy_text(true);
  return out + ".";
}

}  // namespace clusterbench::report
