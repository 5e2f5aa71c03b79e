#include "report/conclusion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "assign/contract/assigner.h"
#include "core/text.h"
#include "measure/side_by_side.h"
#include "report/columns.h"
#include "report/contender.h"
#include "report/frame_cost.h"
#include "report/json_values.h"
#include "report/nothing_seen.h"
#include "report/preset_cost.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_remedy =
    "--set 'samples.opaque={}' (levels with triangles) or samples.opaque.ground=lowest shades surfaces, and can change "
    "the "
    "choice";

// A case with what it is ranked by.
struct WeighedCase {
  const Json* result_case = nullptr;
  run::Contender contender;  // whose times hold what is modelled
  std::optional<double> frame_ns;
  std::optional<WholeFrame> modelled;
  double cost_ns = 0.0;  // of both

  double bytes() const { return number_at(*result_case, "/buffers/bytes/high_water").value_or(0.0); }
  // Share of the lights that its samples need and lack: at visible surfaces where these were asked for.
  double unlit() const {
    const bool has_surfaces = value_at(*result_case, "/samples/opaque") != nullptr;
    return number_at(*result_case, has_surfaces ? "/samples/opaque/unlit" : "/shading/unlit").value_or(0.0);
  }
  // Whether its method is the plain form of one that makes the same lists with SIMD.
  bool is_plain() const {
    return assign::find_assigner((*result_case)["assigner"]["name"].get<std::string>() + "-fast") != nullptr;
  }
  // Of cases that cost alike the least is taken.
  auto rank() const { return std::tuple(unlit() > 0.0, bytes(), is_plain()); }
};

// What is compared with each other: cases that see the same.
struct SceneView {
  std::string scene, camera;
  Json viewport;
  std::vector<WeighedCase> front{}, others{}, searched{};
  std::vector<const Json*> cases{};
};

std::string case_title(const Json& result_case) {
  const auto name = result_case["name"].get<std::string>();
  return shown(name.substr(name.find('/', name.find('/') + 1) + 1));
}

std::string first_titles(const std::vector<const WeighedCase*>& standings) {
  constexpr std::size_t k_most = 3;
  std::vector<std::string> names;
  for (const WeighedCase* standing : standings)
    if (names.size() < k_most) names.push_back(case_title(*standing->result_case));
  const std::string more =
      standings.size() > k_most ? " and " + std::to_string(standings.size() - k_most) + " more" : "";
  return joined(names) + more;
}

std::string ns_text(double ns) {
  const double us = 1e-3 * ns;
  return text(us < 10.0 ? "%.2f us" : us < 1000.0 ? "%.3g us" : "%.0f us", us);
}

WeighedCase standing_of(const Json& result_case, const Json& config) {
  WeighedCase out{&result_case, contender_of(result_case), number_at(result_case, "/timing/frame_ns/median"),
                  whole_frame(result_case, config)};
  const double gpu_ns = out.modelled ? out.modelled->gpu_ns : 0.0;
  for (double& ns : out.contender.rounds_ns) ns += gpu_ns;
  out.contender.costs.time_ns.low += gpu_ns;
  out.contender.costs.time_ns.high += gpu_ns;
  out.cost_ns = out.frame_ns.value_or(0.0) + gpu_ns;
  if (!out.frame_ns && !out.modelled) out.cost_ns = out.bytes();
  return out;
}

std::vector<SceneView> scene_views(const Json& result, const Json& config) {
  std::set<std::string> front;
  for (const Json& of_scene : result["pareto_front"])
    for (const Json& id : of_scene["ids"]) front.insert(id.get<std::string>());
  std::vector<SceneView> views;
  for (const Json& result_case : result["cases"]) {
    if (result_case.contains("preset")) continue;
    const auto is_its = [&](const SceneView& view) {
      return result_case["scene"] == view.scene && result_case["camera"] == view.camera &&
             result_case["viewport"] == view.viewport;
    };
    auto view = std::ranges::find_if(views, is_its);
    if (view == views.end())
      view = views.insert(views.end(), SceneView{result_case["scene"], result_case["camera"], result_case["viewport"]});
    view->cases.push_back(&result_case);
    const bool is_sound = result_case["eligible"] == true;
    if (front.contains(result_case["id"].get<std::string>()))
      view->front.push_back(standing_of(result_case, config));
    else if (is_sound)
      (samples_search(result_case) ? view->searched : view->others).push_back(standing_of(result_case, config));
  }
  return views;
}

std::optional<measure::Ratio> weighed_ratio(const WeighedCase& a, const WeighedCase& b, std::uint64_t seed) {
  if (!a.frame_ns || !b.frame_ns) return std::nullopt;
  return run::ratio_between(a.contender, b.contender, seed);
}

// Whether what is modelled in them leaves open which costs more, as for presets (report/preset_cost.h).
bool are_modelled_alike(const WeighedCase& a, const WeighedCase& b) {
  return (a.modelled || b.modelled) && std::max(a.cost_ns, b.cost_ns) <= k_alike_ratio * std::min(a.cost_ns, b.cost_ns);
}

// Known to be dearer: by the ratio of the rounds, else by intervals of times, or by what is counted.
bool is_known_dearer(const WeighedCase& a, const WeighedCase& b, std::uint64_t seed) {
  if (are_modelled_alike(a, b)) return false;
  if (!a.frame_ns || !b.frame_ns) return a.cost_ns > b.cost_ns;
  if (const std::optional<measure::Ratio> ratio = weighed_ratio(a, b, seed)) return measure::takes_longer(ratio);
  return a.contender.costs.time_ns.low > b.contender.costs.time_ns.high;
}

// The choice of a view, and what it is held against.
struct Choice {
  const WeighedCase* take = nullptr;
  const WeighedCase* against = nullptr;
  const WeighedCase* fastest = nullptr;  // to make, where that is another one
  const WeighedCase* searched = nullptr;
  std::optional<measure::Ratio> ratio;
  std::vector<const WeighedCase*> alike;
};

std::vector<const WeighedCase*> cheapest_first(const std::vector<WeighedCase>& all) {
  std::vector<const WeighedCase*> order;
  for (const WeighedCase& standing : all) order.push_back(&standing);
  std::ranges::stable_sort(order, {}, &WeighedCase::cost_ns);
  return order;
}

// Of the cases on the front the cheapest; of those that are not known to be dearer one whose samples lack no light
// before others, then the smallest.
Choice choose_of(const SceneView& view, std::uint64_t seed) {
  Choice choice;
  std::vector<const WeighedCase*> order = cheapest_first(view.front);
  if (order.empty()) return choice;
  const WeighedCase* best = order.front();
  for (const WeighedCase* weighed : order)
    if (!is_known_dearer(*weighed, *best, seed) && (choice.take == nullptr || weighed->rank() < choice.take->rank()))
      choice.take = weighed;
  for (const WeighedCase* weighed : cheapest_first(view.others)) order.push_back(weighed);
  for (const WeighedCase* weighed : order) {
    if (weighed == choice.take) continue;
    if (is_known_dearer(*weighed, *choice.take, seed)) {
      if (choice.against == nullptr) choice.against = weighed;
    } else if (!is_known_dearer(*choice.take, *weighed, seed)) {
      choice.alike.push_back(weighed);
    }
  }
  if (choice.against != nullptr) choice.ratio = weighed_ratio(*choice.against, *choice.take, seed);
  for (const WeighedCase& weighed : view.front)
    if (weighed.frame_ns && (choice.fastest == nullptr || *weighed.frame_ns < *choice.fastest->frame_ns))
      choice.fastest = &weighed;
  const std::vector<const WeighedCase*> searched = cheapest_first(view.searched);
  if (!searched.empty() && searched.front()->modelled && searched.front()->cost_ns < choice.take->cost_ns)
    choice.searched = searched.front();
  return choice;
}

std::string bytes_text(double bytes) {
  return bytes < 1e3   ? text("%.0f B", bytes)
         : bytes < 1e6 ? text("%.3g kB", 1e-3 * bytes)
                       : text("%.3g MB", 1e-6 * bytes);
}

std::string whole_cost_text(const WeighedCase& take) {
  if (!take.modelled && !take.frame_ns) return text("; %.0f bytes, and no times or samples to rank by", take.bytes());
  if (!take.modelled) return "; " + ns_text(*take.frame_ns) + " a frame to make on this machine";
  const std::string model = "upload, reading and shading by the model of the key cost";
  if (!take.frame_ns) return "; " + ns_text(take.modelled->gpu_ns) + " a frame of " + model + ", and nothing was timed";
  return "; a frame costs " + ns_text(take.cost_ns) + ": " + ns_text(*take.frame_ns) + " to make it on this machine, " +
         ns_text(take.modelled->gpu_ns) + " of " + model;
}

// "10 % more", "2.71 times as much"; with the interval where it is known.
std::string more_text(double ratio, std::optional<double> low, std::optional<double> high) {
  const bool is_share = ratio < 2.0;
  const auto amount = [&](double of) { return is_share ? text("%.2g %%", 100.0 * (of - 1.0)) : text("%.3g", of); };
  std::string out = amount(ratio) + (is_share ? " more" : " times as much");
  if (low && high) out += " (95 %: " + amount(*low) + " to " + amount(*high) + ")";
  return out;
}

std::string against_text(const Choice& choice) {
  if (choice.against == nullptr) return choice.alike.empty() ? "; there is nothing sound to hold it against" : "";
  std::string out = "; " + case_title(*choice.against->result_case) + " costs ";
  const auto& ratio = choice.ratio;
  if (ratio && std::isfinite(ratio->ci95.low) && std::isfinite(ratio->ci95.high))
    return out + more_text(ratio->ratio, ratio->ci95.low, ratio->ci95.high);
  out += more_text(ratio ? ratio->ratio : choice.against->cost_ns / choice.take->cost_ns, {}, {});
  return choice.take->frame_ns ? out + " (not measured often enough side by side for an interval)" : out;
}

// What limits how far the choice can be trusted.
std::string doubts_text(const Choice& choice) {
  std::string out;
  if (const double unlit = choice.take->unlit(); unlit > 0.0)
    out += ". Its samples lack " + (unlit < 1e-4 ? "less than 0.01 %" : text("%.2g %%", 100.0 * unlit)) +
           " of the lights that they need";
  if (!choice.alike.empty())
    out += std::string(". No difference that these ") + (choice.take->frame_ns ? "times" : "figures") + " can show" +
           (choice.take->modelled ? " (costs within 5 % are alike: part of them is modelled)" : "") + " to " +
           first_titles(choice.alike);
  if (choice.fastest != nullptr && choice.fastest != choice.take && choice.take->modelled)
    out += ". Fastest to make: " + case_title(*choice.fastest->result_case) + ", " + ns_text(*choice.fastest->frame_ns);
  if (choice.searched != nullptr)
    out += ". " + case_title(*choice.searched->result_case) + ", which samples search, would cost " +
           ns_text(choice.searched->cost_ns) + " by the model; no GPU has measured such a search";
  if (choice.take->modelled && choice.take->modelled->has_random_depths)
    out += std::string(". Its samples are at random depths, where no surface is; ") + k_remedy;
  return out;
}

Json conclusion_of(const SceneView& view, std::uint64_t seed) {
  const std::string unseen = why_nothing_is_seen(view.cases, RankedBy::cost);
  const Choice choice = unseen.empty() ? choose_of(view, seed) : Choice{};
  const std::string where = shown(view.scene) + ", camera " + shown(view.camera) + ", " + view.viewport[0].dump() +
                            "x" + view.viewport[1].dump() + ": ";
  Json out{{"scene", view.scene}, {"camera", view.camera}, {"viewport", view.viewport}, {"take", nullptr},
           {"against", nullptr},  {"ratio", nullptr},      {"ci95", nullptr},           {"alike", Json::array()}};
  if (!unseen.empty()) {
    out["text"] = where + "nothing to take: " + unseen + ".";
    return out;
  }
  if (choice.take == nullptr) {
    out["text"] =
        where +
        (view.searched.empty() ? "take none of " + number_of(view.cases.size(), "case") + ": each fails or loses lights"
                               : "nothing to take: only structures that samples search are sound here, and no GPU has "
                                 "measured such a search") +
        ".";
    return out;
  }
  out["take"] = (*choice.take->result_case)["id"];
  if (choice.against != nullptr) {
    out["against"] = (*choice.against->result_case)["id"];
    out["ratio"] = six_digits(choice.ratio ? choice.ratio->ratio : choice.against->cost_ns / choice.take->cost_ns);
    if (choice.ratio) out["ci95"] = {six_digits(choice.ratio->ci95.low), six_digits(choice.ratio->ci95.high)};
  }
  for (const WeighedCase* standing : choice.alike) out["alike"].push_back((*standing->result_case)["id"]);
  out["text"] = where + "take " + case_title(*choice.take->result_case) + " (" + bytes_text(choice.take->bytes()) +
                ")" + whole_cost_text(*choice.take) + against_text(choice) + doubts_text(choice) + ".";
  return out;
}

std::string objective_text(const Json& record, const Json& objective) {
  return objective["figure"].get<std::string>() + " " + amount_text(number_at(record, "/objective").value_or(0.0));
}

// Modelled costs within what the model can tell, times that differ by less than their interval, and equal figures.
bool is_like_choice(const Json& record, const Json& objective) {
  if (objective["figure"].get<std::string>().ends_with("_cost_us") &&
      number_at(record, "/by_choice").value_or(0.0) <= k_alike_ratio)
    return true;
  if (record.contains("ci95") && record["ci95"][0].is_number()) return record["ci95"][0].get<double>() <= 1.0;
  return number_at(record, "/by_choice").value_or(0.0) <= 1.0;
}

std::string beside_choice_text(const Json& record) {
  const Json interval = record.value("ci95", Json::array({nullptr, nullptr}));
  const auto end = [&](std::size_t at) {
    return interval[at].is_number() ? std::optional(interval[at].get<double>()) : std::nullopt;
  };
  return shown(record["name"].get<std::string>()) + " has " +
         more_text(record["by_choice"].get<double>(), end(0), end(1));
}

}  // namespace

std::string text_of_nothing_seen(const Json& answer) {
  const Json* why = value_at(answer, "/nothing_seen");
  return why != nullptr && why->is_string() ? "nothing to recommend: " + why->get<std::string>() : "";
}

std::string answer_conclusion(const Json& answer, const Json& objective) {
  std::string out = shown(answer["scene"].get<std::string>()) + ", " + answer["viewport"][0].dump() + "x" +
                    answer["viewport"][1].dump() + ": ";
  const Json& choice = answer["choice"];
  if (const std::string unseen = text_of_nothing_seen(answer); !unseen.empty()) return out + unseen + ".";
  if (choice.is_null())
    return out + "take none: no candidate satisfies all constraints; see what each of them excludes.";
  out += "take " + shown(choice["name"].get<std::string>()) + "; " + objective_text(choice, objective);
  std::vector<std::string> alike;
  const Json* against = nullptr;
  for (const Json& record : answer["runners_up"]) {
    if (is_like_choice(record, objective))
      alike.push_back(shown(record["name"].get<std::string>()));
    else if (against == nullptr && record["by_choice"].is_number())
      against = &record;
  }
  if (against != nullptr) out += "; " + beside_choice_text(*against);
  if (!alike.empty())
    out += std::string(". No difference that these ") + (objective["timed"] == true ? "times" : "figures") +
           " can show to " + joined(alike);
  const Json searched = answer.value("searched", Json::array());
  if (!searched.empty() && number_at(searched[0], "/by_choice").value_or(1.0) < 1.0)
    out += ". " + shown(searched[0]["name"].get<std::string>()) + ", which samples search, would have " +
           objective_text(searched[0], objective) + "; no GPU has measured such a search";
  if (const std::optional<double> height = number_at(answer, "/ground_m"))
    out += text(". Samples lie on a floor at y = %.4g m, since the scene has no triangles", *height);
  if (answer.value("random_depths", false))
    out += std::string(". Samples are at random depths, where no surface is; ") + k_remedy;
  return out + ".";
}

Json conclusions_of(const Json& result, const Json& origin) {
  Json out = Json::array();
  for (const SceneView& view : scene_views(result, origin["config"]))
    out.push_back(conclusion_of(view, seed_of(origin)));
  return out;
}

std::string conclusions_text(const Json& result) {
  constexpr std::size_t k_most = 12;
  if (!result.contains("conclusions")) return "";
  const Json& all = result["conclusions"];
  std::string out;
  if (all.size() > k_most)
    out = "(" + std::to_string(all.size() - k_most) + " more conclusions stand in the result and on the page)\n";
  for (std::size_t i = 0; i < std::min(all.size(), k_most); ++i)
    out += "conclusion: " + all[i]["text"].get<std::string>() + "\n";
  return out;
}

}  // namespace clusterbench::report
