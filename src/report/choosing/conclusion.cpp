#include "report/choosing/conclusion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/pattern.h"
#include "core/text.h"
#include "measure/statistics/side_by_side.h"
#include "report/cases/case_costs.h"
#include "report/cases/case_filter.h"
#include "report/cases/case_samples.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/cases/failures.h"
#include "report/cases/nothing_seen.h"
#include "report/choosing/conclusion_words.h"
#include "report/choosing/device_conclusion.h"
#include "report/choosing/weighed_cases.h"
#include "result/at.h"
#include "result/rounding.h"

namespace clusterbench::report {
namespace {

using result::Case;

// The first cases; of those with the same lists only the fastest, if known.
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

// Whether `a` costs more for certain: by more than the precision of the model, and by the ratio of the rounds, else by
// intervals of the costs, else, with too few measurements for both, by the costs.
bool is_known_dearer(const WeighedCase& a, const WeighedCase& b, std::uint64_t seed) {
  const bool is_estimated = a.is_modelled || b.is_modelled;
  const std::optional<measure::Ratio> ratio = measured_ratio(a, b, seed);
  const double times_as_much = ratio ? ratio->ratio : a.weight() / b.weight();
  if (is_estimated && times_as_much <= measure::k_alike_ratio) return false;
  if (!a.is_timed() || !b.is_timed()) return a.weight() > b.weight();
  const measure::Interval &of_a = a.contender.costs.time_ns, &of_b = b.contender.costs.time_ns;
  if (of_b.is_known() && a.cost.gpu_ns() > of_b.high) return true;  // even if making its lists took no time
  if (has_interval(ratio)) return measure::takes_longer(ratio);
  if (of_a.is_known() && of_b.is_known()) return of_a.low > of_b.high;
  return a.weight() > measure::k_alike_ratio * b.weight();
}

// The choice for a view, and the cases that it is compared with.
struct Choice {
  const WeighedCase* take = nullptr;
  const WeighedCase* against = nullptr;    // the cheapest that costs more for certain
  const WeighedCase* cheapest = nullptr;   // the one with the smallest cost, if its lists differ from the choice's
  const WeighedCase* fastest = nullptr;    // the fastest to make its lists, if it is another one
  const WeighedCase* searched = nullptr;   // if it would be cheaper
  std::optional<measure::Ratio> ratio;     // against / take
  std::vector<const WeighedCase*> alike;   // all that do not cost more for certain
  std::vector<const WeighedCase*> others;  // those of them with other lists
  std::size_t same_lists() const { return alike.size() - others.size(); }

  double times_as_much() const { return ratio ? ratio->ratio : against->weight() / take->weight(); }
};

// Of the cases that do not cost more than the cheapest for certain: first those whose samples miss no light, then those
// on the front, then the smallest.
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

std::string whole_cost_text(const WeighedCase& take) {
  if (!take.is_modelled && !take.is_timed())
    return text("; %.0f bytes, and no times or samples to rank by", take.bytes());
  const std::string here = take.result_case->machine ? "" : " on this machine";  // else the sentence begins with it
  if (!take.is_modelled) return "; " + ns_text(take.ns()) + " a frame to make" + here;
  const std::string model = "upload, reading and shading by the model (configuration key cost)";
  if (!take.is_timed()) return "; " + ns_text(take.ns()) + " a frame of " + model + ", and nothing was timed";
  return "; a frame costs " + ns_text(take.ns()) + ": " + ns_text(*take.cost.assign_ns) + " to make the lists" + here +
         ", " + ns_text(take.cost.gpu_ns()) + " of " + model;
}

// Around the reported ratio: that of rounds side by side differs slightly from that of the costs, whose times are
// medians.
measure::Interval by_prices(const Choice& choice) {
  if (!choice.against->is_modelled || !choice.take->is_modelled) return {};
  return measure::around(choice.times_as_much(), choice.against->weight() / choice.take->weight(),
                         measure::ratio_by_prices(choice.against->cost, choice.take->cost));
}

std::string against_text(const Choice& choice) {
  if (choice.against == nullptr)
    return choice.alike.empty() ? "; no other case was measured that ranks beside it (on the processor, conservative, "
                                  "without lost lights)"
                                : "";
  const std::string out =
      "; " + case_title(*choice.against->result_case) + " costs " +
      more_text(choice.times_as_much(), choice.ratio ? choice.ratio->ci95 : measure::Interval{}, by_prices(choice));
  const bool is_rough = choice.take->is_timed() && !has_interval(choice.ratio);
  return out + (is_rough ? ", not measured often enough side by side for an interval" : "");
}

// On methods that make the same lists as the choice, and are not slower for certain.
std::string same_lists_text(const Choice& choice) {
  const std::size_t count = choice.same_lists();
  if (count == 0) return "";
  const std::string out =
      ". " + number_of(count, "other method") + (count == 1 ? " makes" : " make") + " the same lists";
  if (choice.take->is_timed()) return out + ", in times that these do not tell apart";
  return out + ": a run without --no-timing tells which is fastest" +
         (choice.take->has_simd() ? "; until then take one that ends in -fast" : "");
}

// Reasons to doubt the choice.
std::string doubts_text(const Choice& choice) {
  const WeighedCase& take = *choice.take;
  std::string out;
  if (const double unlit = take.unlit(); unlit > 0.0)
    out += ". " + samples_text(ranking_set_names(*take.result_case)) + " lack " +
           (unlit < 1e-4 ? "less than 0.01 %" : text("%.2g %%", 100.0 * unlit)) + " of the lights that they need";
  if (take.is_modelled)
    out += few_samples_text(sum_at_samples(*take.result_case, result::number<&result::SampleSet::needed>),
                            ranking_set_names(*take.result_case));
  if (const std::string limit = at_surfaces_text(take.method()); !limit.empty()) out += ". It " + limit;
  out += same_lists_text(choice);
  if (!choice.others.empty())
    out += ". " + alike_title(take.is_modelled, take.is_timed()) + ": " + first_titles(choice.others);
  if (choice.cheapest != nullptr)
    out += ". The least of them is " + case_title(*choice.cheapest->result_case) + ": " +
           less_or_more(choice.cheapest->weight() / take.weight()) + ", with " + bytes_text(choice.cheapest->bytes()) +
           (choice.cheapest->unlit() > 0.0 ? " and " + unlit_text(choice.cheapest->unlit()) + " unlit" : "");
  if (choice.fastest != nullptr && choice.fastest != choice.take && take.is_modelled)
    out += ". Fastest to make: " + case_title(*choice.fastest->result_case) + ", " +
           ns_text(*choice.fastest->cost.assign_ns);
  if (choice.searched != nullptr)
    out += ". " + case_title(*choice.searched->result_case) + ", which samples search, would cost " +
           ns_text(choice.searched->ns()) + " by the model; no GPU has measured such a search";
  if (take.has_random_depths)
    out += ". Its samples are at random depths, " + remedy_text(take.unseen) +
           (take.is_modelled && !take.result_case->cost
                ? "; --set cost.weights.volume=pixels shows each case's cost at random depths"
                : "");
  return out;
}

// "street, camera walk, 1920x1080: ", the prefix of a conclusion.
std::string view_text(const result::Conclusion& conclusion) {
  return shown(conclusion.scene) + ", camera " + shown(conclusion.camera) + ", " + viewport_text(conclusion.viewport) +
         (conclusion.machine ? ", " + shown(*conclusion.machine) : "") + ": ";
}

// Of a failed run.
std::string failure_text(const result::Result& result) {
  const std::vector<std::string> failures = run_failures(result);
  return "the run FAILED: " + shown(failures.front()) +
         (failures.size() > 1 ? " (and for " + number_of(failures.size() - 1, "other reason") + ")" : "");
}

// Why no case can be recommended.
std::string unsound_text(const std::vector<const Case*>& cases) {
  const auto lucky = std::ranges::count_if(
      cases, [](const Case* one) { return !one->loses_lights && one->failures.empty() && !one->eligible; });
  if (lucky == 0) return "each loses lights";
  return "each loses lights, or (" + std::to_string(lucky) +
         ") lost none here and is not conservative, so that it can elsewhere";
}

std::string why_none(const SceneView& view) {
  if (!view.on_device.empty() && view.sound.empty() && view.searched.empty() && view.unsampled == 0)
    return "nothing to take of methods that run on the processor: none was measured that is conservative and loses no "
           "lights";
  if (!view.searched.empty())
    return "nothing to take: only structures that samples search are sound here, and no GPU has measured such a search";
  if (view.unsampled > 0)
    return "nothing to take: these methods light visible surfaces, and no surface was sampled to say what they cost "
           "(--set 'samples.opaque={}' samples them)";
  return "take none of " + number_of(view.cases.size(), "case") + ": " + unsound_text(view.cases);
}

// Adds the comparison with a more expensive case.
void add_against(const Choice& choice, result::Conclusion& out) {
  using result::counted, result::measured;
  out.against = choice.against->result_case->id;
  out.ratio = measured(choice.times_as_much());
  if (choice.ratio) out.ci95 = result::Pair{measured(choice.ratio->ci95.low), measured(choice.ratio->ci95.high)};
  if (const measure::Interval range = by_prices(choice); range.is_known())
    out.by_prices = result::Pair{counted(range.low), counted(range.high)};
}

result::Conclusion conclusion_of(const SceneView& view, const std::optional<result::Device>& device,
                                 std::uint64_t seed) {
  const std::string unseen = why_nothing_is_seen(view.cases, RankedBy::samples);
  const Choice choice = unseen.empty() ? choose_of(view, seed) : Choice{};
  result::Conclusion out;
  out.scene = view.scene;
  out.camera = view.camera;
  out.machine = view.machine;
  out.viewport = {static_cast<std::int64_t>(view.viewport[0]), static_cast<std::int64_t>(view.viewport[1])};
  out.text = view_text(out);
  if (!unseen.empty()) {
    out.text += "nothing to take: " + unseen + ".";
    return out;
  }
  if (choice.take == nullptr) {
    out.text += why_none(view) + "." + device_text(view, device);
    return out;
  }
  out.take = choice.take->result_case->id;
  if (choice.against != nullptr) add_against(choice, out);
  for (const WeighedCase* weighed : choice.alike) out.alike.push_back(weighed->result_case->id);
  out.text += "take " + case_title(*choice.take->result_case) + " (" + bytes_text(choice.take->bytes()) + ")" +
              whole_cost_text(*choice.take) + against_text(choice) + doubts_text(choice) + "." +
              device_text(view, device);
  return out;
}

}  // namespace

std::vector<result::Conclusion> conclusions_of(const result::Result& result, const result::Result& origin) {
  std::vector<result::Conclusion> out;
  for (const SceneView& view : scene_views(result, origin.config))
    out.push_back(conclusion_of(view, result.device, seed_of(origin)));
  return out;
}

std::vector<std::string> run_failures(const result::Result& result) {
  std::vector<std::string> failures = gate_failures(result);
  if (result.failed) failures.insert(failures.end(), result.failed->begin(), result.failed->end());
  return failures;
}

void conclude_failures(result::Result& result, const std::vector<std::string>& failures) {
  if (!result.failed && !failures.empty()) result.failed.emplace();
  for (const std::string& failure : failures) result.failed->push_back(failure);
  if (run_failures(result).empty()) return;
  const std::string text = "nothing to take: " + failure_text(result);
  if (result.conclusions)
    for (result::Conclusion& conclusion : *result.conclusions) {
      conclusion.take.reset();
      conclusion.against.reset();
      conclusion.ratio = result::k_none;
      conclusion.ci95.reset();
      conclusion.by_prices.reset();
      conclusion.alike.clear();
      conclusion.text = view_text(conclusion) + text + ".";
    }
  if (result.preset_rankings)
    for (result::PresetRanking& ranking : *result.preset_rankings) {
      ranking.best.reset();
      ranking.alike.emplace();
      ranking.text = text;
    }
}

std::string failed_conclusion(const result::Result& result) {
  return "none, since " + failure_text(result);
}

std::vector<std::string> taken_names(const result::Result& result) {
  std::vector<std::string> names;
  if (!result.conclusions) return names;
  for (const result::Conclusion& conclusion : *result.conclusions)
    for (const Case& result_case : result.cases) {
      if (conclusion.take != result_case.id) continue;
      const std::string name = run::name_without_camera(names_of_case(result_case), true);
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  return names;
}

std::string filter_of(const std::string& taken, const result::Result& result) {
  const auto selects = [&](const std::string& filter, bool taken_ones) {
    const Pattern pattern(filter, "--filter");
    return std::ranges::any_of(result.cases, [&](const Case& one) {
      const bool is_taken = run::name_without_camera(names_of_case(one), true) == taken;
      return is_taken == taken_ones && is_selected(pattern, one);
    });
  };
  const std::string literal = literal_expression(taken), ending = literal + "$";
  try {
    return selects(literal, false) && selects(ending, true) ? ending : taken;
  } catch (const Error&) {  // a name that no expression can hold
    return taken;
  }
}

std::string conclusions_text(const result::Result& result) {
  constexpr std::size_t k_most = 12;
  if (!result.conclusions) return "";
  const std::vector<result::Conclusion>& all = *result.conclusions;
  std::string out;
  if (all.size() > k_most)
    out = "(" + number_of(all.size() - k_most, "more conclusion") + (all.size() - k_most == 1 ? " stands" : " stand") +
          " in the result and on the page)\n";
  for (std::size_t i = 0; i < std::min(all.size(), k_most); ++i) out += "conclusion: " + all[i].text + "\n";
  return out;
}

}  // namespace clusterbench::report
