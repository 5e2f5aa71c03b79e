#include "report/conclusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "assign/contract/assigner.h"
#include "core/text.h"
#include "measure/side_by_side.h"
#include "report/case_filter.h"
#include "report/columns.h"
#include "report/contender.h"
#include "report/frame_cost.h"
#include "report/json_values.h"
#include "report/nothing_seen.h"
#include "report/result_json.h"
#include "report/sample_sets.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// What shades surfaces in place of points at random depths.
std::string remedy_text(bool has_no_triangles) {
  return std::string(has_no_triangles ? "since the scene has no triangles; samples.opaque.ground=lowest shades a floor"
                                      : "where no surface is; --set 'samples.opaque={}' (levels with triangles) or "
                                        "samples.opaque.ground=lowest shades surfaces") +
         ", and can change the choice";
}

// "Its samples (visible surfaces)".
std::string samples_text(const std::vector<std::string>& sets) {
  return "Its samples" + (sets.empty() ? "" : " (" + words_of_sets(sets) + ")");
}

// Of samples that need few lights. "" where they need enough.
std::string few_samples_text(double needed, const std::vector<std::string>& sets) {
  if (needed >= k_least_needed_to_choose) return "";
  return ". " + samples_text(sets) + " need only " + number_of(static_cast<std::uint64_t>(needed), "light") +
         ", summed over all samples" +
         ": costs are rough, and a light that is lost can go unseen; more frames, or samples (samples.opaque.divisor, "
         "shading.samples), tell more";
}

// A case with what it is ranked by.
struct WeighedCase {
  const Json* result_case = nullptr;
  run::Contender contender;  // whose times hold what is modelled
  measure::FrameCost cost;
  bool is_modelled = false, has_random_depths = false, is_on_front = false;
  bool has_no_triangles = false;  // where surfaces are asked for

  bool is_timed() const { return cost.assign_ns.has_value(); }
  double bytes() const { return number_at(*result_case, "/buffers/bytes/high_water").value_or(0.0); }
  double ns() const { return cost.assign_ns.value_or(0.0) + cost.gpu_ns(); }
  double weight() const { return is_timed() || is_modelled ? ns() : bytes(); }
  // The cheapest first; of equal ones that nobody timed what is known to be faster.
  auto order() const { return std::tuple(weight(), !is_timed() && !has_simd(), is_timed() ? 0 : slowness()); }
  double unlit() const { return unlit_at_samples(*result_case).value_or(0.0); }
  int slowness() const { return slowness_of(*result_case); }
  bool has_simd() const { return slowness() == 1; }
  // Of cases that cost alike the least is taken.
  auto rank() const {
    return std::tuple(unlit() > 0.0, is_at_surfaces(method()), !is_on_front, bytes(), !has_simd(), slowness());
  }
  std::string method() const { return (*result_case)["assigner"]["name"].get<std::string>(); }
};

// What is compared with each other: cases that see the same.
struct SceneView {
  std::string scene, camera;
  Json viewport;
  std::vector<WeighedCase> sound{}, searched{};  // the cheapest first
  std::size_t unsampled = 0;                     // cases of which nothing says what they cost, or what they leave unlit
  std::vector<const Json*> cases{};
};

std::string case_title(const Json& result_case) {
  const auto name = result_case["name"].get<std::string>();
  return shown(name.substr(name.find('/', name.find('/') + 1) + 1));
}

std::string ns_text(double ns) {
  const double us = 1e-3 * ns;
  return text(us < 10.0 ? "%.2f us" : us < 1000.0 ? "%.3g us" : "%.0f us", us);
}

WeighedCase weigh(const Json& result_case, const Json& config) {
  WeighedCase out;
  out.result_case = &result_case;
  out.contender = contender_of(result_case);
  if (const std::optional<WholeFrame> frame = whole_frame(result_case, config)) {
    out.cost = frame->cost;
    out.is_modelled = true;
    out.has_random_depths = frame->has_random_depths;
    out.has_no_triangles = value_at(config, "/samples/opaque") != nullptr;
  }
  out.cost.assign_ns = number_at(result_case, "/timing/frame_ns/median");
  for (double& ns : out.contender.rounds_ns) ns += out.cost.gpu_ns();
  out.contender.costs.time_ns.low += out.cost.gpu_ns();
  out.contender.costs.time_ns.high += out.cost.gpu_ns();
  return out;
}

std::vector<SceneView> scene_views(const Json& result, const Json& config) {
  std::set<std::string> front;
  for (const Json& of_scene : result["pareto_front"])
    for (const Json& id : of_scene["ids"]) front.insert(id.get<std::string>());
  const std::set<std::string> without_samples = ids_without_samples(result["cases"]);
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
    if (!loses_nothing_seen(result_case)) continue;
    WeighedCase weighed = weigh(result_case, config);
    weighed.is_on_front = front.contains(result_case["id"].get<std::string>());
    // What draws lights has no lists that could be small.
    if (without_samples.contains(result_case["id"].get<std::string>()) ||
        (draws_lights(result_case) && !weighed.is_modelled)) {
      ++view->unsampled;
      continue;
    }
    (samples_search(result_case) ? view->searched : view->sound).push_back(weighed);
  }
  for (SceneView& view : views)
    for (std::vector<WeighedCase>* cases : {&view.sound, &view.searched})
      std::ranges::stable_sort(*cases, {}, &WeighedCase::order);
  return views;
}

// The same lists in the same cells and storage: of other methods, of which nothing but times is to be told.
bool has_lists_of(const WeighedCase& a, const WeighedCase& b) {
  const auto is_equal = [&](const char* pointer) {
    const Json *of_a = value_at(*a.result_case, pointer), *of_b = value_at(*b.result_case, pointer);
    return of_a == nullptr ? of_b == nullptr : of_b != nullptr && *of_a == *of_b;
  };
  return std::ranges::all_of(std::array{"/grid/name", "/storage", "/precision/label", "/pre_cull/label", "/occupancy",
                                        "/buffers/index_entries", "/buffers/bytes", "/buffers/each"},
                             is_equal) &&
         a.cost.gpu_ns() == b.cost.gpu_ns() && a.unlit() == b.unlit();
}

// The first ones, of those with the same lists together the one that is known to be fastest.
std::string first_titles(const std::vector<const WeighedCase*>& cases) {
  constexpr std::size_t k_most = 3;
  struct SameLists {
    const WeighedCase* first;
    std::size_t count;
  };
  std::vector<SameLists> groups;
  std::size_t left_out = 0;
  for (const WeighedCase* weighed : cases) {
    const auto group =
        std::ranges::find_if(groups, [&](const SameLists& same) { return has_lists_of(*same.first, *weighed); });
    if (group == groups.end() && groups.size() == k_most) {
      ++left_out;
    } else if (group == groups.end()) {
      groups.push_back({weighed, 1});
    } else {
      ++group->count;
      if (weighed->rank() < group->first->rank()) group->first = weighed;
    }
  }
  std::vector<std::string> names;
  for (const SameLists& same : groups)
    names.push_back(case_title(*same.first->result_case) +
                    (same.count > 1 ? " (the same lists by " + std::to_string(same.count) + " methods)" : ""));
  return joined(names) + (left_out > 0 ? " and " + std::to_string(left_out) + " more" : "");
}

bool has_interval(const std::optional<measure::Ratio>& ratio) {
  return ratio && std::isfinite(ratio->ci95.low) && std::isfinite(ratio->ci95.high);
}

std::optional<measure::Ratio> measured_ratio(const WeighedCase& a, const WeighedCase& b, std::uint64_t seed) {
  if (!a.is_timed() || !b.is_timed()) return std::nullopt;
  return run::ratio_between(a.contender, b.contender, seed);
}

// Known to be dearer: beyond what a model can tell, and by the ratio of the rounds, by intervals of the costs, or where
// nothing was measured often enough for them by the costs.
bool is_known_dearer(const WeighedCase& a, const WeighedCase& b, std::uint64_t seed) {
  const bool is_estimated = a.is_modelled || b.is_modelled;
  const std::optional<measure::Ratio> ratio = measured_ratio(a, b, seed);
  const double times_as_much = ratio ? ratio->ratio : a.weight() / b.weight();
  if (is_estimated && times_as_much <= measure::k_alike_ratio) return false;
  if (!a.is_timed() || !b.is_timed()) return a.weight() > b.weight();
  const measure::Interval &of_a = a.contender.costs.time_ns, &of_b = b.contender.costs.time_ns;
  if (of_b.is_known() && a.cost.gpu_ns() > of_b.high) return true;  // even if its lists cost no time
  if (has_interval(ratio)) return measure::takes_longer(ratio);
  if (of_a.is_known() && of_b.is_known()) return of_a.low > of_b.high;
  return a.weight() > measure::k_alike_ratio * b.weight();
}

// The choice of a view, and what it is held against.
struct Choice {
  const WeighedCase* take = nullptr;
  const WeighedCase* against = nullptr;    // the cheapest that is known to be dearer
  const WeighedCase* cheapest = nullptr;   // by its figure, where that is one with other lists
  const WeighedCase* fastest = nullptr;    // to make, where that is another one
  const WeighedCase* searched = nullptr;   // where it would be cheaper
  std::optional<measure::Ratio> ratio;     // against / take
  std::vector<const WeighedCase*> alike;   // all that are not known to be dearer
  std::vector<const WeighedCase*> others;  // of them those with other lists
  std::size_t same_lists() const { return alike.size() - others.size(); }

  double times_as_much() const { return ratio ? ratio->ratio : against->weight() / take->weight(); }
};

// Of the cases that are not known to be dearer than the cheapest one whose samples lack no light before others, then
// one on the front, then the smallest.
Choice choose_of(const SceneView& view, std::uint64_t seed) {
  Choice choice;
  for (const WeighedCase& weighed : view.sound) {
    const bool is_candidate = !is_known_dearer(weighed, view.sound.front(), seed);
    if (is_candidate && (choice.take == nullptr || weighed.rank() < choice.take->rank())) choice.take = &weighed;
    if (weighed.is_timed() && (choice.fastest == nullptr || *weighed.cost.assign_ns < *choice.fastest->cost.assign_ns))
      choice.fastest = &weighed;
  }
  if (choice.take == nullptr) return choice;
  for (const WeighedCase& weighed : view.sound) {
    if (&weighed == choice.take) continue;
    if (!is_known_dearer(weighed, *choice.take, seed))
      choice.alike.push_back(&weighed);
    else if (choice.against == nullptr)
      choice.against = &weighed;
  }
  std::ranges::copy_if(choice.alike, std::back_inserter(choice.others),
                       [&](const WeighedCase* weighed) { return !has_lists_of(*weighed, *choice.take); });
  if (view.sound.front().weight() < choice.take->weight() && !has_lists_of(view.sound.front(), *choice.take))
    choice.cheapest = &view.sound.front();
  if (choice.against != nullptr) choice.ratio = measured_ratio(*choice.against, *choice.take, seed);
  if (!view.searched.empty() && view.searched.front().is_modelled && view.searched.front().ns() < choice.take->ns())
    choice.searched = &view.searched.front();
  return choice;
}

std::string bytes_text(double bytes) {
  return bytes < 1e3   ? text("%.0f B", bytes)
         : bytes < 1e6 ? text("%.3g kB", 1e-3 * bytes)
                       : text("%.3g MB", 1e-6 * bytes);
}

std::string whole_cost_text(const WeighedCase& take) {
  if (!take.is_modelled && !take.is_timed())
    return text("; %.0f bytes, and no times or samples to rank by", take.bytes());
  if (!take.is_modelled) return "; " + ns_text(take.ns()) + " a frame to make on this machine";
  const std::string model = "upload, reading and shading by the model (configuration key cost)";
  if (!take.is_timed()) return "; " + ns_text(take.ns()) + " a frame of " + model + ", and nothing was timed";
  return "; a frame costs " + ns_text(take.ns()) + ": " + ns_text(*take.cost.assign_ns) +
         " to make the lists on this machine, " + ns_text(take.cost.gpu_ns()) + " of " + model;
}

// "10 % more", "2.71 times as much"; in brackets what it can be by times and by prices, where that is known.
std::string more_text(double ratio, const measure::Interval& by_times, const measure::Interval& by_prices) {
  const bool is_share = ratio < 2.0;
  const auto amount = [&](double of) {
    const double percent = 100.0 * (of - 1.0);
    const bool is_near_alike = std::abs(of - measure::k_alike_ratio) < 5e-4;  // 5.04 % more is not within 5 %
    return !is_share ? text("%.3g", of)
                     : text(is_near_alike              ? "%.3g %%"
                            : std::abs(percent) < 99.5 ? "%.2g %%"
                                                       : "%.0f %%",
                            percent);
  };
  const auto range = [&](const measure::Interval& of) { return amount(of.low) + " to " + amount(of.high); };
  std::vector<std::string> ranges;
  if (by_times.is_known() && std::isfinite(by_times.high))
    ranges.push_back("95 % interval of the times: " + range(by_times));
  if (by_prices.is_known() && std::isfinite(by_prices.high))
    ranges.push_back("with the model's prices halved or doubled: " + range(by_prices) +
                     (by_prices.low < 1.0 ? ", so it may cost less on another GPU" : ""));
  return amount(ratio) + (is_share ? " more" : " times as much") +
         (ranges.empty() ? "" : " (" + joined(ranges, "; ") + ")");
}

// About the ratio that is told: that of rounds side by side is not quite that of the costs, whose times are medians.
measure::Interval by_prices(const Choice& choice) {
  if (!choice.against->is_modelled || !choice.take->is_modelled) return {};
  return measure::around(choice.times_as_much(), choice.against->weight() / choice.take->weight(),
                         measure::ratio_by_prices(choice.against->cost, choice.take->cost));
}

std::string against_text(const Choice& choice) {
  if (choice.against == nullptr)
    return choice.alike.empty() ? "; no other case was measured, or each loses lights" : "";
  const std::string out =
      "; " + case_title(*choice.against->result_case) + " costs " +
      more_text(choice.times_as_much(), choice.ratio ? choice.ratio->ci95 : measure::Interval{}, by_prices(choice));
  const bool is_rough = choice.take->is_timed() && !has_interval(choice.ratio);
  return out + (is_rough ? ", not measured often enough side by side for an interval" : "");
}

// Of methods that make the same lists as the choice, and take no longer as far as is known.
std::string same_lists_text(const Choice& choice) {
  const std::size_t count = choice.same_lists();
  if (count == 0) return "";
  const std::string out =
      ". " + number_of(count, "other method") + (count == 1 ? " makes" : " make") + " the same lists";
  if (choice.take->is_timed()) return out + ", in times that these do not tell apart";
  return out + ": a run without --no-timing tells which is fastest" +
         (choice.take->has_simd() ? "; until then take one that ends in -fast" : "");
}

// What leads those that cost no more than is told from the choice.
std::string alike_title(bool is_modelled, bool is_timed) {
  if (!is_modelled) return is_timed ? "Not told apart by these times" : "The same by these figures";
  return std::string("About the same cost (within 5 %") + (is_timed ? ", or not told apart by these times)" : ")");
}

// "2.1 % more", "9.6 % less".
std::string change_text(double ratio) {
  return text("%.2g %% ", 100.0 * std::abs(ratio - 1.0)) + (ratio < 1.0 ? "less" : "more");
}

// What limits how far the choice can be trusted.
std::string doubts_text(const Choice& choice) {
  const WeighedCase& take = *choice.take;
  std::string out;
  if (const double unlit = take.unlit(); unlit > 0.0)
    out += ". " + samples_text(ranking_set_names(*take.result_case)) + " lack " +
           (unlit < 1e-4 ? "less than 0.01 %" : text("%.2g %%", 100.0 * unlit)) + " of the lights that they need";
  if (take.is_modelled)
    out += few_samples_text(sum_at_samples(*take.result_case, "needed"), ranking_set_names(*take.result_case));
  if (const std::string limit = at_surfaces_text(take.method()); !limit.empty()) out += ". It " + limit;
  out += same_lists_text(choice);
  if (!choice.others.empty())
    out += ". " + alike_title(take.is_modelled, take.is_timed()) + ": " + first_titles(choice.others);
  if (choice.cheapest != nullptr)
    out += ". The least of them is " + case_title(*choice.cheapest->result_case) + ": " +
           change_text(choice.cheapest->weight() / take.weight()) + ", with " + bytes_text(choice.cheapest->bytes()) +
           (choice.cheapest->unlit() > 0.0 ? " and " + unlit_text(choice.cheapest->unlit()) + " unlit" : "");
  if (choice.fastest != nullptr && choice.fastest != choice.take && take.is_modelled)
    out += ". Fastest to make: " + case_title(*choice.fastest->result_case) + ", " +
           ns_text(*choice.fastest->cost.assign_ns);
  if (choice.searched != nullptr)
    out += ". " + case_title(*choice.searched->result_case) + ", which samples search, would cost " +
           ns_text(choice.searched->ns()) + " by the model; no GPU has measured such a search";
  if (take.has_random_depths)
    out += ". Its samples are at random depths, " + remedy_text(take.has_no_triangles) +
           (take.is_modelled && !take.result_case->contains("cost")
                ? "; --set cost.weights.volume=pixels shows each case's cost at random depths"
                : "");
  return out;
}

// "street, camera walk, 1920x1080: ", of a conclusion.
std::string view_text(const Json& conclusion) {
  return shown(conclusion["scene"]) + ", camera " + shown(conclusion["camera"]) + ", " + viewport_text(conclusion) +
         ": ";
}

// Of a run that failed.
std::string failure_text(const Json& result) {
  const std::vector<std::string> failures = run_failures(result);
  return "the run FAILED: " + shown(failures.front()) +
         (failures.size() > 1 ? " (and for " + number_of(failures.size() - 1, "other reason") + ")" : "");
}

// Why none of the cases may be taken.
std::string unsound_text(const std::vector<const Json*>& cases) {
  const auto lucky = std::ranges::count_if(cases, [](const Json* one) {
    return (*one)["loses_lights"] == false && (*one)["failures"].empty() && (*one)["eligible"] == false;
  });
  if (lucky == 0) return "each loses lights";
  return "each loses lights, or (" + std::to_string(lucky) +
         ") lost none here and is not conservative, so that it can elsewhere";
}

std::string why_none(const SceneView& view) {
  if (!view.searched.empty())
    return "nothing to take: only structures that samples search are sound here, and no GPU has measured such a search";
  if (view.unsampled > 0)
    return "nothing to take: these methods light visible surfaces, and no surface was sampled to say what they cost "
           "(--set 'samples.opaque={}' samples them)";
  return "take none of " + number_of(view.cases.size(), "case") + ": " + unsound_text(view.cases);
}

Json conclusion_of(const SceneView& view, std::uint64_t seed) {
  const std::string unseen = why_nothing_is_seen(view.cases, RankedBy::samples);
  const Choice choice = unseen.empty() ? choose_of(view, seed) : Choice{};
  Json out{{"scene", view.scene}, {"camera", view.camera}, {"viewport", view.viewport}, {"take", nullptr},
           {"against", nullptr},  {"ratio", nullptr},      {"ci95", nullptr},           {"alike", Json::array()}};
  const std::string where = view_text(out);
  if (!unseen.empty()) {
    out["text"] = where + "nothing to take: " + unseen + ".";
    return out;
  }
  if (choice.take == nullptr) {
    out["text"] = where + why_none(view) + ".";
    return out;
  }
  out["take"] = (*choice.take->result_case)["id"];
  if (choice.against != nullptr) {
    out["against"] = (*choice.against->result_case)["id"];
    out["ratio"] = six_digits(choice.times_as_much());
    if (choice.ratio) out["ci95"] = {six_digits(choice.ratio->ci95.low), six_digits(choice.ratio->ci95.high)};
    if (const measure::Interval range = by_prices(choice); range.is_known())
      out["by_prices"] = {number_or_null(range.low), number_or_null(range.high)};
  }
  for (const WeighedCase* weighed : choice.alike) out["alike"].push_back((*weighed->result_case)["id"]);
  out["text"] = where + "take " + case_title(*choice.take->result_case) + " (" + bytes_text(choice.take->bytes()) +
                ")" + whole_cost_text(*choice.take) + against_text(choice) + doubts_text(choice) + ".";
  return out;
}

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
  return "which these times do not tell from no difference (95 % interval: " + change_text(interval.low) + " to " +
         change_text(interval.high) + ")";
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
                    less = change_text((*least)["by_choice"].get<double>());
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
  std::string out = shown(answer["scene"].get<std::string>()) + ", " + viewport_text(answer) + ": ";
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

Json conclusions_of(const Json& result, const Json& origin) {
  Json out = Json::array();
  for (const SceneView& view : scene_views(result, origin["config"]))
    out.push_back(conclusion_of(view, seed_of(origin)));
  return out;
}

std::vector<std::string> run_failures(const Json& result) {
  std::vector<std::string> failures = gate_failures(result);
  for (const Json& failure : result.value("failed", Json::array())) failures.push_back(failure.get<std::string>());
  return failures;
}

void conclude_failures(Json& result, const std::vector<std::string>& failures) {
  for (const std::string& failure : failures) result["failed"].push_back(failure);
  if (run_failures(result).empty()) return;
  const std::string text = "nothing to take: " + failure_text(result);
  for (Json& conclusion : result["conclusions"]) {
    for (const char* key : {"take", "against", "ratio", "ci95"}) conclusion[key] = nullptr;
    conclusion.erase("by_prices");
    conclusion["alike"] = Json::array();
    conclusion["text"] = view_text(conclusion) + text + ".";
  }
  if (!result.contains("preset_rankings")) return;
  for (Json& ranking : result["preset_rankings"]) {
    ranking["best"] = nullptr;
    ranking["alike"] = Json::array();
    ranking["text"] = text;
  }
}

std::string failed_conclusion(const Json& result) {
  return "none, since " + failure_text(result);
}

std::vector<std::string> taken_names(const Json& result) {
  std::vector<std::string> names;
  for (const Json& conclusion : result.value("conclusions", Json::array()))
    for (const Json& result_case : result["cases"]) {
      if (conclusion["take"] != result_case["id"]) continue;
      const std::string name = run::name_without_camera(names_of_case(result_case), true);
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  return names;
}

std::string conclusions_text(const Json& result) {
  constexpr std::size_t k_most = 12;
  if (!result.contains("conclusions")) return "";
  const Json& all = result["conclusions"];
  std::string out;
  if (all.size() > k_most)
    out = "(" + number_of(all.size() - k_most, "more conclusion") + (all.size() - k_most == 1 ? " stands" : " stand") +
          " in the result and on the page)\n";
  for (std::size_t i = 0; i < std::min(all.size(), k_most); ++i)
    out += "conclusion: " + all[i]["text"].get<std::string>() + "\n";
  return out;
}

}  // namespace clusterbench::report
