// Every row of the table of figures, computed again from the JSON of real runs by a formula of its own. A row without a
// formula here fails the test, and so does one that no run has.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "assign/contract/assigner.h"
#include "needs.h"
#include "report/recounted_results.h"
#include "result/figures/case_figure.h"

namespace clusterbench::report::recount {
namespace {

using result::Json;
using Value = std::optional<double>;

// A case of a result, both as JSON.
struct Recount {
  const Json& result;
  const Json& one;

  const Json* json(const std::string& pointer) const {
    const Json::json_pointer place(pointer);
    return one.contains(place) ? &one.at(place) : nullptr;
  }
  Value at(const std::string& pointer) const {
    const Json* found = json(pointer);
    return found == nullptr || found->is_null() ? Value() : Value(found->get<double>());
  }
  std::vector<double> list(const std::string& pointer) const {
    const Json* found = json(pointer);
    return found == nullptr ? std::vector<double>() : found->get<std::vector<double>>();
  }
  double config(const std::string& pointer) const {
    return result["config"][Json::json_pointer(pointer)].get<double>();
  }
};
using Formula = std::function<Value(const Recount&)>;

Formula recorded(const std::string& pointer, double divisor = 1.0) {
  return [pointer, divisor](const Recount& of) {
    const Value value = of.at(pointer);
    return value ? Value(*value / divisor) : Value();
  };
}

double sum_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}
Value mean_of(const std::vector<double>& values) {
  return values.empty() ? Value() : Value(sum_of(values) / static_cast<double>(values.size()));
}
Value largest_of(const std::vector<double>& values) {
  return values.empty() ? Value() : Value(*std::ranges::max_element(values));
}
Value median_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Formula median_us(const std::string& pointer) {
  return [pointer](const Recount& of) {
    const Value median = median_of(of.list(pointer + "/samples"));
    return median ? Value(*median / 1000.0) : Value();
  };
}
Formula mean_along(const std::string& pointer) {
  return [pointer](const Recount& of) { return mean_of(of.list(pointer)); };
}
Formula largest_along(const std::string& pointer) {
  return [pointer](const Recount& of) { return largest_of(of.list(pointer)); };
}

// The median over the rounds.
Value device_floor(const Recount& of) {
  const std::vector<double> run = of.list("/device/run_ns/samples"), floor = of.list("/device/floor_ns/samples");
  std::vector<double> ratios;
  for (std::size_t round = 0; round < run.size(); ++round) ratios.push_back(run[round] / floor[round]);
  return median_of(ratios);
}

Value ratio_of_rounds(const Recount& of, const std::string& numerator, const std::string& denominator) {
  const std::vector<double> above = of.list(numerator), below = of.list(denominator);
  std::vector<double> ratios;
  for (std::size_t round = 0; round < std::min(above.size(), below.size()); ++round)
    ratios.push_back(above[round] / below[round]);
  return median_of(ratios);
}

constexpr const char* k_first_set = "/reading/sets/0";
constexpr const char* k_first_walk = "/reading/sets/0/walks/0";

Value reading_by(const Recount& of, const std::string& other) {
  return ratio_of_rounds(of, std::string(k_first_walk) + "/read_ns/samples", other + "/samples");
}

// Half of the assignment runs beside other work (with_readings()). A device makes packed lists, and no others of a
// storage.
Value device_frame_us(const Recount& of) {
  const std::string storage = of.json("/storage")->get<std::string>();
  const bool is_on_device = of.json("/assigner/on_device") != nullptr;
  if (is_on_device && storage != "packed" && storage != "own") return {};
  const Value read = median_of(of.list(std::string(k_first_walk) + "/read_ns/samples"));
  if (!read) return {};
  if (const Value on_device = median_of(of.list("/device/run_ns/samples")))
    return (0.5 * *on_device + *median_of(of.list("/device/upload_ns/samples")) + *read) / 1000.0;
  const Value frame = median_of(of.list("/timing/frame_ns/samples"));
  if (!frame) return {};
  return (0.5 * *frame + of.at("/buffers/upload_bytes/mean").value_or(0.0) / of.config("/cost/upload_gb_per_s") +
          *read) /
         1000.0;
}

// --- Cells ---

// The lengths of lists with the number of cells of each.
std::vector<double> histogram_of(const Recount& of) {
  return of.list("/occupancy/lights_per_cell/histogram/cells");
}

Value mean_length(const Recount& of) {
  const std::vector<double> cells = histogram_of(of);
  if (cells.empty()) return {};
  double lights = 0.0;
  for (std::size_t length = 0; length < cells.size(); ++length) lights += static_cast<double>(length) * cells[length];
  return lights / sum_of(cells);
}

// The least length that 99 % of the cells do not exceed.
Value length_p99(const Recount& of) {
  const std::vector<double> cells = histogram_of(of);
  double within = 0.0;
  for (std::size_t length = 0; length < cells.size(); ++length) {
    within += cells[length];
    if (within >= 0.99 * sum_of(cells)) return static_cast<double>(length);
  }
  return {};
}

Value occupied(const Recount& of) {
  const std::vector<double> cells = histogram_of(of);
  return cells.empty() ? Value() : Value(1.0 - cells[0] / sum_of(cells));
}

// Pairs beyond the room of a cell: of the storage `fixed` alone, whose room these runs set to 4 lights.
Value dropped(const Recount& of) {
  double beyond = 0.0;
  const std::vector<double> cells = histogram_of(of);
  if (of.one["storage"].get<std::string>().starts_with("fixed"))
    for (std::size_t length = 5; length < cells.size(); ++length)
      beyond += static_cast<double>(length - 4) * cells[length];
  return beyond;
}

// --- Pairs ---

Value excess(const Recount& of) {
  const Value reported = of.at("/error/reported_pairs"), lost = of.at("/error/false_negatives"),
              needed = of.at("/error/true_pairs");
  return reported && *needed > 0.0 ? Value((*reported - *needed + *lost) / *needed) : Value();
}
Value missed(const Recount& of) {
  const Value reported = of.at("/error/reported_pairs");
  return reported ? Value(*of.at("/error/true_pairs") - (*reported - *of.at("/error/false_positives"))) : Value();
}
Value false_positives(const Recount& of) {
  const Value reported = of.at("/error/reported_pairs");
  return reported ? Value(*reported - (*of.at("/error/true_pairs") - *of.at("/error/false_negatives"))) : Value();
}
Value true_pairs(const Recount& of) {
  const Value reported = of.at("/error/reported_pairs");
  return reported ? Value(*reported - *of.at("/error/false_positives") + *of.at("/error/false_negatives")) : Value();
}
Value miss_ratio(const Recount& of) {
  const Value lost = missed(of);
  return lost ? Value(*lost / *of.at("/error/true_pairs")) : Value();
}
Value reported_pairs(const Recount& of) {
  return of.json("/error") == nullptr ? Value() : Value(sum_of(of.list("/occupancy/along_path/pairs")));
}

// The first case of the same scene, camera, viewport and grid that is as meant.
const Json& case_beside(const Recount& of, const std::function<bool(const Json&)>& is_meant) {
  for (const Json& other : of.result["cases"])
    if (other["scene"] == of.one["scene"] && other["camera"] == of.one["camera"] &&
        other["viewport"] == of.one["viewport"] && other["grid"] == of.one["grid"] && is_meant(other))
      return other;
  throw std::runtime_error("no case beside " + of.one["name"].get<std::string>());
}

// Pairs more than the same case with lights in float32.
Value extra_pairs(const Recount& of) {
  if (of.json("/precision/extra_pairs") == nullptr) return {};
  const Json& plain = case_beside(of, [&](const Json& other) {
    return other["storage"] == of.one["storage"] && other["assigner"]["label"] == of.one["assigner"]["label"] &&
           other["precision"]["packing"] == "float32";
  });
  const Recount with_float32{of.result, plain};
  return *mean_of(of.list("/occupancy/along_path/pairs")) - *mean_of(with_float32.list("/occupancy/along_path/pairs"));
}

// --- Memory ---

Value entries_recommended(const Recount& of) {
  const double most = std::ceil(*of.at("/buffers/index_entries/high_water") * of.config("/allocation/margin"));
  if (of.one["storage"].get<std::string>().starts_with("fixed")) return of.at("/buffers/index_entries/theoretical_max");
  return std::min(most, *of.at("/buffers/index_entries/theoretical_max"));
}
Value bytes_recommended(const Recount& of) {
  const double bytes =
      *of.at("/buffers/header_bytes") + *entries_recommended(of) * std::floor(*of.at("/buffers/index_bits") / 8.0);
  return std::min(std::max(bytes, *of.at("/buffers/bytes/high_water")), *of.at("/buffers/bytes/theoretical_max"));
}

// --- Samples ---

Value per_sample(const Json& set, const char* count) {
  const auto samples = set["samples"].get<double>();
  return samples > 0.0 ? Value(set[count].get<double>() / samples) : Value();
}

const Json& set_of(const Recount& of, const std::string& name) {
  return name == "volume" ? of.one["shading"] : of.one["samples"][name];
}

// Those that have a price and samples; without prices the visible surfaces, else points of the view.
std::vector<std::string> ranking_sets(const Recount& of) {
  std::vector<std::string> names;
  if (const Json* paid = of.json("/cost/sets"))
    for (const auto& [name, _] : paid->items())
      if (set_of(of, name)["samples"] > 0) names.push_back(name);
  if (of.json("/cost") != nullptr) return names;
  if (of.json("/samples/opaque") != nullptr) return {"opaque"};
  return of.json("/shading") != nullptr ? std::vector<std::string>{"volume"} : std::vector<std::string>{};
}

// Samples of a set that a frame shades.
double shaded(const Recount& of, const std::string& name) {
  return of.json("/cost") == nullptr ? 1.0 : *of.at("/cost/sets/" + name + "/samples");
}

Value weighted_mean(const Recount& of, const char* count) {
  double sum = 0.0, samples = 0.0;
  for (const std::string& name : ranking_sets(of)) {
    const Value mean = per_sample(set_of(of, name), count);
    if (!mean) continue;
    sum += shaded(of, name) * *mean;
    samples += shaded(of, name);
  }
  return samples > 0.0 ? Value(sum / samples) : Value();
}

using OfSet = Value (*)(const Json& set);
Value largest_of_sets(const Recount& of, OfSet figure) {
  std::vector<double> values;
  for (const std::string& name : ranking_sets(of))
    if (const Value value = figure(set_of(of, name))) values.push_back(*value);
  return largest_of(values);
}

Value unlit_of(const Json& set) {
  return set["needed"] > 0 ? Value(set["missed"].get<double>() / set["needed"].get<double>()) : Value();
}
Value lost_irradiance_of(const Json& set) {
  return set["needed"] > 0 && !set["lost_irradiance"].is_null() ? Value(set["lost_irradiance"].get<double>()) : Value();
}
Value needed_of(const Json& set) {
  return per_sample(set, "needed");
}
Value overshade_of(const Json& set) {
  const auto needed = set["needed"].get<double>();
  const bool is_known = needed >= 100.0 && set["missed"].get<double>() <= 0.001 * needed;
  return is_known ? Value(set["evaluated"].get<double>() / needed) : Value();
}

Value overshade(const Recount& of) {
  if (of.json("/cost") == nullptr) return largest_of_sets(of, overshade_of);
  double all_needed = 0.0;
  for (const std::string& name : ranking_sets(of)) {
    if (unlit_of(set_of(of, name)).value_or(0.0) > 0.001) return {};
    all_needed += set_of(of, name)["needed"].get<double>();
  }
  const Value given = weighted_mean(of, "evaluated"), needed = weighted_mean(of, "needed");
  return all_needed >= 100.0 ? Value(*given / *needed) : Value();
}

// --- The model ---

// Samples of a set that a frame shades: of opaque samples each stands for its block of pixels, of points in the view
// one for each pixel.
double shaded_by_weights(const Recount& of, const std::string& name) {
  const double width = of.one["viewport"][0], height = of.one["viewport"][1];
  if (of.result["config"]["cost"]["weights"][name] == "pixels") return width * height;
  const double per_frame = set_of(of, name)["samples"].get<double>() / of.one["frames"].get<double>();
  const Json& request = of.result["config"]["samples"];
  const double divisor = name == "volume" ? 1.0 : request[name].value("divisor", 1.0);
  const double pixels = width * height / (std::ceil(width / divisor) * std::ceil(height / divisor));
  return of.config("/cost/weights/" + name) * per_frame * pixels;
}

bool draws(const Recount& of) {
  return of.one["assigner"]["name"] == "deferred";
}

double divergence(const Recount& of, const std::string& name) {
  const double lanes = of.result["config"]["cost"]["wave"] == "8x4" ? 32.0 : 64.0;
  const Json& set = set_of(of, name);
  if (!set.contains("waves") || draws(of)) return 1.0;
  for (const Json& wave : set["waves"])
    if (wave["lanes"] == lanes && !wave["divergence"].is_null()) return wave["divergence"].get<double>();
  return 1.0;
}

Value gpu_ns(const Recount& of) {
  if (of.json("/cost") == nullptr) return {};
  const bool is_uploaded = !of.one["assigner"].value("on_device", false);
  double ns = (is_uploaded ? *of.at("/buffers/upload_bytes/mean") : 0.0) / of.config("/cost/upload_gb_per_s") +
              of.at("/buffers/traffic_bytes/mean").value_or(0.0) / of.config("/cost/memory_gb_per_s");
  for (const auto& [name, weight] : of.result["config"]["cost"]["weights"].items()) {
    if (weight == 0.0 || of.json(name == "volume" ? "/shading" : "/samples/" + name) == nullptr) continue;
    const Json& set = set_of(of, name);
    const auto mean = [&](const char* count) { return per_sample(set, count).value_or(0.0); };
    const double reading = draws(of) ? 0.0
                                     : mean("reads") * of.config("/cost/ns_per_read") +
                                           mean("read_bytes") / of.config("/cost/read_gb_per_s");
    ns += shaded_by_weights(of, name) * divergence(of, name) *
          (mean("evaluated") * of.config("/cost/ns_per_light") + reading);
  }
  return ns;
}
Value gpu_us(const Recount& of) {
  const Value ns = gpu_ns(of);
  return ns ? Value(*ns / 1000.0) : Value();
}
Value frame_cost_us(const Recount& of) {
  const Value ns = gpu_ns(of), frame = of.at("/timing/frame_ns/median");
  return ns && frame ? Value((*ns + *frame) / 1000.0) : Value();
}

// --- Times and instructions ---

Value speedup(const Recount& of) {
  const Json* beside = of.json("/timing/against_first/assigner");
  if (beside == nullptr) return {};
  const Json& first = case_beside(
      of, [&](const Json& other) { return of.one["storage"] == "own" || other["storage"] == of.one["storage"]; });
  EXPECT_EQ(first["assigner"]["label"], *beside);
  const Recount of_first{of.result, first};
  const std::vector<double> own = of.list("/timing/frame_ns/samples"),
                            others = of_first.list("/timing/frame_ns/samples");
  std::vector<double> ratios;
  for (std::size_t round = 0; round < own.size(); ++round) ratios.push_back(own[round] / others[round]);
  return 1.0 / *median_of(ratios);
}
Value ns_per_pair(const Recount& of) {
  const Value pairs = of.at("/timing/pairs/mean"), median = median_of(of.list("/timing/frame_ns/samples"));
  return pairs && *pairs > 0.0 && of.at("/timing/ns_per_pair") ? Value(*median / *pairs) : Value();
}
Value pair_rate(const Recount& of) {
  const Value ns = ns_per_pair(of);
  return ns ? Value(1e9 / *ns) : Value();
}
Value pairs_timed(const Recount& of) {  // these runs time all frames
  return of.json("/timing") == nullptr ? Value() : mean_of(of.list("/occupancy/along_path/pairs"));
}
Value frame_instructions(const Recount& of) {
  const std::string frame = "/count/instructions_per_frame/";
  const Value assign = of.at(frame + "assign");
  return assign ? Value(*assign + of.at(frame + "convert").value_or(0.0) + of.at(frame + "pre_cull").value_or(0.0))
                : Value();
}

const Json& scene_of(const Recount& of) {
  for (const Json& scene : of.result["scenes"])
    if (scene["name"] == of.one["scene"]) return scene;
  throw std::runtime_error("no scene of " + of.one["name"].get<std::string>());
}
Value lights(const Recount& of) {
  const Json& counts = scene_of(of)["lights"];
  return counts["point"].get<double>() + counts["spot"].get<double>();
}
Value lights_lit(const Recount& of) {
  return *lights(of) - scene_of(of)["lights"]["dark"].get<double>();
}

using Formulas = std::map<std::string, Formula>;

Formulas formulas_of_times() {
  return {
      {"frame_us", median_us("/timing/frame_ns")},
      {"frame_us.max", recorded("/timing/worst_frame/ns", 1000.0)},
      {"assign_us", median_us("/timing/assign_ns")},
      {"convert_us", median_us("/timing/convert_ns")},
      {"build_us", median_us("/timing/build_ns")},
      {"frame_cost_us", frame_cost_us},
      {"gpu_cost_us", gpu_us},
      {"speedup", speedup},
      {"pair_rate", pair_rate},
      {"time_per_pair", ns_per_pair},
      {"pairs_timed", pairs_timed},
      {"builds_per_frame", recorded("/timing/builds_per_frame")},
      {"write_floor", recorded("/timing/write_floor_ns")},
      {"floor_ratio", recorded("/timing/floor_ratio")},
      {"device_us", median_us("/device/run_ns")},
      {"device_upload_us", median_us("/device/upload_ns")},
      {"device_readback_us", median_us("/device/readback_ns")},
      {"device_floor", device_floor},
      {"device_warm_us", median_us("/device/warm/run_ns")},
      {"device_build_us", median_us("/device/build_ns")},
      {"device_clock_mhz", [](const Recount& of) { return median_of(of.list("/device/clock_mhz/samples")); }},
      {"reading_us", median_us(std::string(k_first_walk) + "/read_ns")},
      {"reading_x_exact", [](const Recount& of) { return reading_by(of, std::string(k_first_walk) + "/exact_ns"); }},
      {"reading_x_nothing", [](const Recount& of) { return reading_by(of, std::string(k_first_set) + "/nothing_ns"); }},
      {"device_frame_us", device_frame_us},
      {"instructions", frame_instructions},
      {"assign_instructions", recorded("/count/instructions_per_frame/assign")},
      {"convert_instructions", recorded("/count/instructions_per_frame/convert")},
      {"build_instructions", recorded("/count/instructions_per_build")},
      {"assign_cycles", recorded("/count/cycles_per_frame/assign")},
      {"convert_cycles", recorded("/count/cycles_per_frame/convert")},
  };
}

Formulas formulas_of_lists() {
  return {
      {"bytes", largest_along("/buffers/along_path/bytes")},
      {"index_entries", recorded("/buffers/index_entries/high_water")},
      {"entries_recommended", entries_recommended},
      {"bytes_recommended", bytes_recommended},
      {"upload_bytes", recorded("/buffers/upload_bytes/max")},
      {"upload_bytes.mean", recorded("/buffers/upload_bytes/mean")},
      {"traffic_bytes", recorded("/buffers/traffic_bytes/mean")},
      {"scratch_bytes", recorded("/buffers/scratch_bytes")},
      {"dropped", dropped},
      {"excess", excess},
      {"missed", missed},
      {"miss_ratio", miss_ratio},
      {"deepest_miss", recorded("/error/deepest_miss")},
      {"undecided", recorded("/error/undecided")},
      {"true_pairs", true_pairs},
      {"reported_pairs", reported_pairs},
      {"false_positives", false_positives},
      {"extra_pairs", extra_pairs},
      {"changed_pairs",
       [](const Recount& of) {
         const Value total = of.at("/stability/changed/method/total");
         return total ? Value(*total / *of.at("/stability/steps")) : Value();
       }},
      {"flickers", recorded("/stability/flickers/method")},
  };
}

Formulas formulas_of_lights_and_samples() {
  return {
      {"tests_done", recorded("/tests_done")},
      {"fallbacks", recorded("/fallbacks")},
      {"lights", lights},
      {"lights_lit", lights_lit},
      {"lights_seen", recorded("/lights_seen")},
      {"lights_seen.mean", recorded("/lights_in_view/shining_mean")},
      {"lights_in_view", recorded("/lights_in_view/max")},
      {"lights_in_view.mean", recorded("/lights_in_view/mean")},
      {"lights_beyond_grid", recorded("/lights_beyond_grid/max")},
      {"pairs", largest_along("/occupancy/along_path/pairs")},
      {"pairs.mean", mean_along("/occupancy/along_path/pairs")},
      {"lights_per_cell.mean", mean_length},
      {"lights_per_cell.p99", length_p99},
      {"longest", largest_along("/occupancy/along_path/longest_list")},
      {"occupied_fraction", occupied},
      {"needed", [](const Recount& of) { return largest_of_sets(of, needed_of); }},
      {"evaluated", [](const Recount& of) { return weighted_mean(of, "evaluated"); }},
      {"read_bytes", [](const Recount& of) { return weighted_mean(of, "read_bytes"); }},
      {"unlit", [](const Recount& of) { return largest_of_sets(of, unlit_of); }},
      {"lost_irradiance", [](const Recount& of) { return largest_of_sets(of, lost_irradiance_of); }},
      {"overshade", overshade},
      {"samples_missed", recorded("/shading/missed")},
      {"samples_missed_outside",
       [](const Recount& of) {
         const Value lost = of.at("/shading/missed");
         return lost ? Value(*lost - *of.at("/shading/missed_in_cells")) : Value();
       }},
  };
}

const Formulas& formulas() {
  static const Formulas all = [] {
    Formulas of_all = formulas_of_times();
    of_all.merge(formulas_of_lists());
    of_all.merge(formulas_of_lights_and_samples());
    return of_all;
  }();
  return all;
}

const std::map<std::string, OfSet>& formulas_of_a_set() {
  static const std::map<std::string, OfSet> all{
      {"needed", needed_of},
      {"evaluated", [](const Json& set) { return per_sample(set, "evaluated"); }},
      {"read_bytes", [](const Json& set) { return per_sample(set, "read_bytes"); }},
      {"unlit", unlit_of},
      {"lost_irradiance", lost_irradiance_of},
      {"overshade", overshade_of},
  };
  return all;
}

// Times have six digits, counts nine.
void expect_the_same(const Value& figure, const Value& recount, bool rests_on_times, const std::string& what) {
  ASSERT_EQ(figure.has_value(), recount.has_value()) << what;
  if (!figure) return;
  const double share = rests_on_times ? 1e-4 : 1e-8;
  EXPECT_NEAR(*figure, *recount, share * std::max(1e-6, std::abs(*recount))) << what;
}

// Names of figures with a value in some case, and with one that is not 0.
struct Known {
  std::set<std::string> any, above_zero;
};

void recount_figures(const Recount& of, const result::Case& one, Known& known) {
  for (const auto& [name, formula] : formulas()) {
    const Value value = result::figure_of(one, name);
    const bool rests_on_times = result::find_figure(name)->rests_on_times();
    expect_the_same(value, formula(of), rests_on_times, one.name + ": " + name);
    if (value) known.any.insert(name);
    if (value && *value > 0.0) known.above_zero.insert(name);
  }
  for (const char* set : {"volume", "opaque", "fog", "anywhere"})
    for (const auto& [name, formula] : formulas_of_a_set()) {
      const std::string figure = set + ("." + name);
      const bool has_set =
          of.json(set == std::string("volume") ? "/shading" : "/samples/" + std::string(set)) != nullptr;
      const Value recount = has_set ? formula(set_of(of, set)) : Value();
      expect_the_same(result::figure_of(one, figure), recount, false, one.name + ": " + figure);
    }
}

void recount(const result::Result& result, Known& known) {
  const Json json = result::to_json(result);
  for (std::size_t i = 0; i < result.cases.size(); ++i)
    recount_figures({json, json["cases"][i]}, result.cases[i], known);
}

TEST(FigureRecount, has_a_formula_for_every_figure_and_none_beside) {
  std::set<std::string> names, with_formula, of_samples, of_a_set;
  for (const result::Figure& figure : result::figures()) names.emplace(figure.name);
  for (const auto& [name, _] : formulas()) with_formula.insert(name);
  EXPECT_EQ(with_formula, names);
  for (const result::Figure& figure : result::figures())
    if (figure.is_at_samples()) of_samples.emplace(figure.name);
  for (const auto& [name, _] : formulas_of_a_set()) of_a_set.insert(name);
  EXPECT_EQ(of_a_set, of_samples);
}

TEST(FigureRecount, of_real_runs_gives_every_figure_of_each_case) {
  NEEDS(embree);
  const assign::AssignerRegistration device_method(on_a_device());
  Known known;
  for (const char* config : {k_street, k_mix, k_few_samples}) recount(with_readings(measured(config)), known);
  // Exact arithmetic decides all, grids that stay are built once, and no pair comes back on this path.
  const std::set<std::string> can_be_zero{"undecided", "builds_per_frame", "flickers"};
  for (const result::Figure& figure : result::figures()) {
    const std::string name(figure.name);
    EXPECT_TRUE((can_be_zero.contains(name) ? known.any : known.above_zero).contains(name)) << name;
  }
}

TEST(FigureRecount, where_no_sample_is_gives_no_figure_of_samples) {
  for (const char* weight : {"1", "0"}) {
    Known known;
    recount(measured(blind(weight)), known);
    for (const auto& [name, _] : formulas_of_a_set()) EXPECT_FALSE(known.any.contains(name)) << weight << " " << name;
  }
}

}  // namespace
}  // namespace clusterbench::report::recount
