#include "report/cases/failures.h"
#include "report/results/result_record.h"

#include <gtest/gtest.h>

#include <limits>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "report/result_by_hand.h"
#include "run/records/records.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::add_count;
using testing::add_precision;
using testing::add_stability;
using testing::case_by_hand;
using testing::judged;
using testing::lose_a_light;
using testing::result_by_hand;

Json json_of(const run::Result& result, const std::vector<result::Case>& earlier_cases = {}) {
  return result::to_json(record_of(result, earlier_cases));
}

Json json_of(const run::CaseResult& case_result) {
  return result::to_json(run::record_of(case_result));
}

std::vector<std::string> violations(const Json& result) {
  return config::schema_violations(config::result_schema(), nlohmann::json::parse(result.dump()));
}

TEST(ResultJson, is_what_the_schema_says) {
  run::Result result = result_by_hand();
  lose_a_light(result.cases[0]);
  add_stability(result.cases[0]);
  add_precision(result.cases[0]);
  add_count(result.cases[0]);
  result.cases[0].timing->against_first = run::Versus{"aabb", {3.0, {2.9, 3.1}}};
  EXPECT_EQ(violations(json_of(result)), std::vector<std::string>{});
}

// Adds what an object lacks of its schema's "x-written", which older results of the same schema_version may lack.
void add_unwritten(const nlohmann::json& schema, const nlohmann::json& value, std::vector<std::string>& lacking) {
  for (const auto& key : schema.value("x-written", nlohmann::json::array()))
    if (!value.contains(key.get<std::string>())) lacking.push_back(key.get<std::string>());
  const nlohmann::json properties = schema.value("properties", nlohmann::json::object());
  for (const auto& [key, inner] : properties.items())
    if (value.contains(key)) add_unwritten(inner, value[key], lacking);
  if (schema.contains("items") && schema["items"].is_object() && value.is_array())
    for (const nlohmann::json& item : value) add_unwritten(schema["items"], item, lacking);
}

TEST(ResultJson, holds_all_that_results_of_before_may_lack) {
  const nlohmann::json schema = config::result_schema();
  nlohmann::json result = json_of(result_by_hand());
  std::vector<std::string> lacking;
  add_unwritten(schema, result, lacking);
  EXPECT_EQ(lacking, std::vector<std::string>{});
  result["cases"][0].erase("settings");
  result["cases"][0]["timing"].erase("worst_frame");
  add_unwritten(schema, result, lacking);
  EXPECT_EQ(lacking, (std::vector<std::string>{"settings", "worst_frame"})) << "seen where it lacks";
}

TEST(ResultJson, without_truth_samples_and_times_is_what_the_schema_says) {
  run::Result result = result_by_hand();
  for (run::CaseResult& case_result : result.cases) {
    case_result.error.reset();
    case_result.shading.reset();
    case_result.timing.reset();
  }
  const Json json = json_of(result);
  EXPECT_EQ(violations(json), std::vector<std::string>{});
  EXPECT_FALSE(json["cases"][0].contains("error"));
  EXPECT_FALSE(json["cases"][0].contains("timing"));
  EXPECT_FALSE(json["cases"][0].contains("stability"));
  EXPECT_FALSE(json["cases"][0].contains("precision"));
  EXPECT_FALSE(json["cases"][0].contains("count"));
}

TEST(ResultJson, instructions_are_those_of_one_frame) {
  run::Result result = result_by_hand();
  add_count(result.cases[0]);
  add_count(result.cases[1]);
  result.cases[1].count->assign.cycles = 5000;
  result.cases[1].count->convert->cycles = 1000;
  const Json json = json_of(result), count = json["cases"][0]["count"];
  EXPECT_EQ(count["source"], "callgrind");
  EXPECT_EQ(count["simd_target"], "AVX2");
  EXPECT_EQ(count["frames"], 2);
  EXPECT_EQ(count["instructions_per_build"], 700);
  EXPECT_EQ(count["instructions_per_frame"], (Json{{"assign", 20000.0}, {"convert", 1500.5}, {"frame", 21500.5}}));
  EXPECT_FALSE(count.contains("cycles_per_frame"));
  EXPECT_EQ(json["cases"][1]["count"]["cycles_per_frame"], (Json{{"assign", 2500.0}, {"convert", 500.0}}));
  EXPECT_EQ(violations(json), std::vector<std::string>{});
}

TEST(ResultJson, stability_stands_beside_the_truths_own) {
  run::Result result = result_by_hand();
  add_stability(result.cases[0]);
  const Json stability = json_of(result)["cases"][0]["stability"];
  EXPECT_EQ(stability["steps"], 10);
  EXPECT_EQ(stability["changed"]["method"], (Json{{"total", 20}, {"mean", 2.0}, {"max", 9}}));
  EXPECT_EQ(stability["changed"]["truth"], (Json{{"total", 16}, {"mean", 1.6}, {"max", 4}}));
  EXPECT_EQ(stability["flickers"], (Json{{"method", 3}, {"truth", 2}}));
  EXPECT_EQ(stability["excess_churn"], (Json{{"pairs", 4}, {"ratio", 0.25}}));
  EXPECT_EQ(stability["excess_flickers"], (Json{{"count", 1}, {"ratio", 0.5}}));
  EXPECT_EQ(stability["drift"], false);
}

TEST(ResultJson, a_method_that_changes_less_than_the_truth_has_a_negative_excess_and_none_without_a_true_change) {
  run::Result result = result_by_hand();
  add_stability(result.cases[0]);
  result.cases[0].stability->method.changes = 12;
  result.cases[0].stability->truth.flickers = 0;
  const Json json = json_of(result);
  EXPECT_EQ(json["cases"][0]["stability"]["excess_churn"], (Json{{"pairs", -4}, {"ratio", -0.25}}));
  EXPECT_EQ(json["cases"][0]["stability"]["excess_flickers"], (Json{{"count", 3}, {"ratio", nullptr}}));
  EXPECT_EQ(violations(json), std::vector<std::string>{});
}

// Two float32 cases of 30 pairs a frame, and one of them inflated from half.
run::Result with_half() {
  run::Result result = result_by_hand();
  result.cases.push_back(result.cases[1]);
  add_precision(result.cases[0]);
  add_precision(result.cases[1]);
  add_precision(result.cases[2], "half", true);
  result.cases[2].occupancy->pairs.mean = 33.0;
  result.planned_ids.push_back(result.cases[2].id);
  return result;
}

TEST(ResultJson, precision_tells_what_is_lost_and_the_pairs_against_float32) {
  const Json json = json_of(with_half());
  const Json &plain = json["cases"][1]["precision"], &half = json["cases"][2]["precision"];
  EXPECT_EQ(half["packing"], "half");
  EXPECT_EQ(half["inflate"], true);
  EXPECT_EQ(half["label"], "half+inflate");
  EXPECT_EQ(half["position_error_m"], (Json{{"mean", 1e-3}, {"max", 2e-2}}));
  EXPECT_EQ(half["range_error_m"], (Json{{"mean", 5e-3}, {"max", 1e-2}}));
  EXPECT_EQ(half["axis_error_rad"], (Json{{"mean", nullptr}, {"max", nullptr}})) << "no spot";
  EXPECT_EQ(half["safe_inflation_m"], (Json{{"mean", 4e-3}, {"max", 8e-2}}));
  EXPECT_EQ(half["unrepresentable"], (Json{{"lights", 0}, {"frames", 0}}));
  EXPECT_EQ(half["extra_pairs"]["mean"], 3.0);
  EXPECT_DOUBLE_EQ(half["extra_pairs"]["ratio"].get<double>(), 0.1);
  EXPECT_EQ(plain["extra_pairs"], (Json{{"mean", 0.0}, {"ratio", 0.0}}));
  EXPECT_EQ(violations(json), std::vector<std::string>{});
}

TEST(ResultJson, without_its_case_in_float32_there_are_no_extra_pairs) {
  run::Result result = with_half();
  result.cases.erase(result.cases.begin() + 1);
  const Json json = json_of(result);
  EXPECT_EQ(json["cases"][1]["precision"]["extra_pairs"], (Json{{"mean", nullptr}, {"ratio", nullptr}}));
  EXPECT_EQ(violations(json), std::vector<std::string>{});
}

TEST(ResultJson, what_is_no_number_is_null) {
  run::Result result = result_by_hand();
  run::CaseResult& case_result = result.cases[0];
  case_result.error->true_pairs = 0;  // excess of nothing
  case_result.shading->needed = 0;    // overshade of nothing
  case_result.timing->ns_per_pair = std::numeric_limits<double>::quiet_NaN();
  case_result.timing->floor_ratio = std::numeric_limits<double>::infinity();
  const Json json = json_of(result);
  EXPECT_TRUE(json["cases"][0]["error"]["excess_ratio"].is_null());
  EXPECT_TRUE(json["cases"][0]["shading"]["overshade"].is_null());
  EXPECT_TRUE(json["cases"][0]["timing"]["ns_per_pair"].is_null());
  EXPECT_TRUE(json["cases"][0]["timing"]["floor_ratio"].is_null());
  EXPECT_EQ(violations(json), std::vector<std::string>{});
}

TEST(ResultJson, holds_the_figures_under_their_names) {
  const Json entry = json_of(case_by_hand("id", "aabb", 3000.0));
  EXPECT_EQ(entry["occupancy"]["pairs"]["max"], 40.0);
  EXPECT_EQ(entry["occupancy"]["lights_per_cell"]["histogram"],
            (Json{{"lights_per_entry", 1}, {"cells", {10, 20, 18}}}));
  EXPECT_EQ(entry["occupancy"]["along_path"],
            (Json{{"frames_per_entry", 1}, {"pairs", {20, 40}}, {"longest_list", {5, 7}}}));
  EXPECT_EQ(entry["buffers"]["along_path"], (Json{{"frames_per_entry", 1}, {"bytes", {212, 232}}}));
  const Json indices = Json::parse(R"({"name": "indices", "element_bytes": 1, "step": 1, "high_water": 40,
    "theoretical_max": 480, "worst_frame": 1, "worst_cell": [3, 2, 1],
    "along_path": {"frames_per_entry": 1, "elements": [20, 40]}})");
  EXPECT_EQ(entry["buffers"]["each"][0], indices);
  EXPECT_FALSE(entry["buffers"]["each"][1].contains("along_path")) << "all frames need the same";
  EXPECT_EQ(entry["buffers"]["index_entries"]["high_water"], 40);
  EXPECT_EQ(entry["error"]["excess_ratio"], 0.25);
  EXPECT_EQ(entry["shading"]["overshade"], 1.5);
  EXPECT_EQ(entry["timing"]["assign_ns"]["samples"], (Json(std::vector<double>(6, 3000.0))));
}

TEST(ResultJson, cells_are_told_as_x_y_z) {
  const Json entry = json_of(case_by_hand("id", "aabb", 3000.0));
  EXPECT_EQ(entry["occupancy"]["worst_cell"], (Json{1, 1, 1}));
  EXPECT_EQ(entry["buffers"]["worst_cell"], (Json{3, 2, 1}));
}

TEST(ResultJson, cases_of_an_interrupted_run_stand_in_the_plans_order) {
  run::Result whole = result_by_hand();
  whole.planned_ids = {"first", "slow", "fast"};
  const Json json = json_of(whole, {run::record_of(case_by_hand("first", "planes", 1.0)),
                                    run::record_of(case_by_hand("not planned", "planes", 1.0))});
  ASSERT_EQ(json["cases"].size(), 3u);
  EXPECT_EQ(json["cases"][0]["id"], "first");
  EXPECT_EQ(json["cases"][1]["id"], "slow");
}

TEST(Front, a_case_that_leaves_out_lights_is_on_no_front) {
  run::Result result = result_by_hand();
  for (run::CaseResult& case_result : result.cases)
    if (case_result.id == "fast") case_result.buffers.dropped_pairs = 1;
  EXPECT_EQ(json_of(result)["pareto_front"][0]["ids"], (Json{"slow"}));
}

TEST(Front, of_equal_lists_only_the_fastest_case_is_on_it) {
  EXPECT_EQ(json_of(result_by_hand())["pareto_front"], (Json::array({{{"scene", "hall"}, {"ids", {"fast"}}}})));
}

TEST(Front, cases_of_different_views_do_not_beat_each_other) {
  run::Result result = result_by_hand();
  result.cases[1].camera = "empty corner";
  EXPECT_EQ(json_of(result)["pareto_front"][0]["ids"], (Json{"slow", "fast"}));
  result = result_by_hand();
  result.cases[1].viewport = {640, 360};
  EXPECT_EQ(json_of(result)["pareto_front"][0]["ids"], (Json{"slow", "fast"}));
}

TEST(Front, packed_lights_beat_others_only_where_they_lose_nothing) {
  run::Result result = with_half();
  result.cases[2].timing->frame_ns = measure::time_stats(std::vector(6, 1.0), 1);
  EXPECT_EQ(json_of(result)["pareto_front"][0]["ids"], (Json{"fast half+inflate"}));
}

TEST(Front, times_whose_ratio_may_be_one_say_nothing) {
  run::Result result = result_by_hand();
  result.cases[0].timing->frame_ns =
      measure::time_stats(std::vector{3000.0, 12000.0, 3000.0, 12000.0, 3000.0, 12000.0}, 1);
  EXPECT_EQ(json_of(result)["pareto_front"][0]["ids"], (Json{"slow", "fast"}));
  result.cases[1].timing->frame_ns =
      measure::time_stats(std::vector{2900.0, 11900.0, 2900.0, 11900.0, 2900.0, 11900.0}, 1);
  EXPECT_EQ(json_of(result)["pareto_front"][0]["ids"], (Json{"fast"}))
      << "their intervals overlap, and in each round it is the slower one";
}

TEST(Front, a_case_that_fails_or_leaves_more_than_a_thousandth_unlit_is_on_no_front) {
  run::Result result = result_by_hand();
  lose_a_light(result.cases[1]);
  EXPECT_EQ(json_of(judged(result))["pareto_front"][0]["ids"], (Json{"slow"}));
  result = result_by_hand();
  result.cases[1].shading->needed = 2000;
  result.cases[1].shading->missed = 2;
  EXPECT_EQ(json_of(result)["pareto_front"][0]["ids"], (Json{"fast"}));
  result.cases[1].shading->missed = 3;
  EXPECT_EQ(json_of(result)["pareto_front"][0]["ids"], (Json{"slow"}));
}

TEST(ResultJson, sets_of_samples_stand_under_their_names) {
  run::Result result = result_by_hand();
  measure::ShadingCounts counts{.samples = 100, .evaluated = 250, .needed = 200, .missed = 5, .unanswered = 2};
  counts.reads = {900, 4000};
  counts.lost_lux = 50.0;
  counts.total_lux = 100.0;
  counts.darkest = {3, 10.5f, 20.25f, 7.0};
  result.cases[0].samples = {{measure::SampleSet::fog, counts, measure::Coherence{}}};
  const Json json = json_of(result), &fog = json["cases"][0]["samples"]["fog"];
  EXPECT_EQ(fog["unanswered"], 2);
  EXPECT_EQ(fog["lost_lux"], 0.5);
  EXPECT_EQ(fog["reads"], 900);
  EXPECT_EQ(fog["read_bytes"], 4000);
  EXPECT_EQ(fog["darkest"], (Json{{"frame", 3}, {"lost_lux", 7}, {"pixel", {10.5, 20.25}}}));
  EXPECT_EQ(fog["waves"].size(), 2u);
  EXPECT_TRUE(fog["waves"][0]["divergence"].is_null());
  EXPECT_FALSE(json["cases"][1].contains("samples"));
  EXPECT_EQ(violations(json), std::vector<std::string>{});
}

TEST(ResultJson, what_samples_lack_is_told_by_place_and_worst_frame) {
  run::Result result = result_by_hand();
  run::CaseResult& case_result = result.cases[0];
  case_result.shading->missed = 50;
  case_result.shading->missed_outside = 40;
  case_result.shading->worst = {1, 30, 90};
  const Json json = json_of(result), &shading = json["cases"][0]["shading"];
  EXPECT_EQ(shading["unlit"], 0.25);
  EXPECT_EQ(shading["missed_in_cells"], 10);
  EXPECT_EQ(shading["missed_outside"], 40);
  EXPECT_EQ(shading["worst_frame"], (Json{{"frame", 1}, {"missed", 30}, {"needed", 90}}));
  EXPECT_TRUE(shading["overshade"].is_null()) << "what is not given makes it small";
  EXPECT_EQ(json["cases"][0]["loses_lights"], true);
  EXPECT_FALSE(json["cases"][1]["shading"].contains("worst_frame"));
  EXPECT_EQ(json["cases"][1]["loses_lights"], false);
  EXPECT_EQ(violations(json), std::vector<std::string>{});
}

TEST(ResultJson, what_to_know_of_a_case_is_written_with_it_and_decides_the_front) {
  run::Result result = result_by_hand();
  result.cases[1].buffers.dropped_pairs = 7;
  result.cases[1].buffers.overflowing_cells = result.cases[1].buffers.overflowing_frames = 1;
  const Json json = json_of(result);
  EXPECT_EQ(json["cases"][0]["warnings"], Json::array());
  EXPECT_EQ(json["cases"][0]["eligible"], true);
  EXPECT_EQ(json["cases"][1]["warnings"],
            (Json::array({{{"kind", "dropped_pairs"}, {"text", "7 pairs dropped in 1 cell of 1 frame"}}})));
  EXPECT_EQ(json["cases"][1]["eligible"], false);
  EXPECT_EQ(json["pareto_front"][0]["ids"], (Json{"slow"}));
  EXPECT_EQ(violations(json), std::vector<std::string>{});
}

TEST(ResultJson, date_command_clock_and_load_are_there_where_something_is_timed) {
  run::Result result = result_by_hand();
  const Json without = json_of(result);
  for (const char* key : {"date", "command"}) EXPECT_FALSE(without.contains(key));
  for (const char* key : {"clock_mhz", "load"}) EXPECT_FALSE(without["machine"].contains(key));
  result.date = "2026-01-02T03:04:05Z";
  result.command = "clusterbench run a.glb";
  result.machine.clock = os::Clock{2400.4, 3000.0};
  result.machine.load = run::LoadFacts{0.5, 1.5};
  const Json with = json_of(result);
  EXPECT_EQ(with["date"], "2026-01-02T03:04:05Z");
  EXPECT_EQ(with["command"], "clusterbench run a.glb");
  EXPECT_EQ(with["machine"]["clock_mhz"], (Json{{"now", 2400}, {"max", 3000}}));
  EXPECT_EQ(with["machine"]["load"], (Json{{"begin", 0.5}, {"end", 1.5}}));
  EXPECT_EQ(violations(with), std::vector<std::string>{});
}

TEST(ResultJson, times_have_six_digits_and_shares_nine) {
  run::CaseResult case_result = case_by_hand("id", "aabb", 3000.0);
  case_result.timing->assign_ns.median = 1234567.891;
  case_result.timing->ns_per_pair = 1.0 / 3.0;
  case_result.error->true_pairs = 7;
  const Json json = json_of(case_result);
  EXPECT_EQ(json["timing"]["assign_ns"]["median"].dump(), "1234570");
  EXPECT_EQ(json["timing"]["ns_per_pair"].dump(), "0.333333");
  EXPECT_EQ(json["error"]["excess_ratio"].dump(), "1.71428571");
}

TEST(ResultJson, of_few_needed_lights_there_is_no_overshade) {
  run::Result result = result_by_hand();
  result.cases[0].shading->needed = 99;
  result.cases[1].shading->needed = 100;
  const Json json = json_of(result);
  EXPECT_TRUE(json["cases"][0]["shading"]["overshade"].is_null());
  EXPECT_EQ(json["cases"][1]["shading"]["overshade"], 3.0);
}

TEST(ResultJson, time_and_pairs_are_of_the_same_frames) {
  const Json timing = json_of(case_by_hand("id", "aabb", 3000.0))["timing"];
  EXPECT_EQ(timing["frame_ns"]["median"], 3500.0);
  EXPECT_EQ(timing["pairs"], (Json{{"mean", 25.0}, {"max", 40}}));
  EXPECT_EQ(timing["ns_per_pair"], 140.0);
  EXPECT_EQ(timing["worst_frame"], (Json{{"frame", 1}, {"ns", 4200.0}, {"ci95", {3000.0, 6000.0}}, {"pairs", 40}}));
}

TEST(Gate, failures_are_written_and_told_with_the_name_of_their_case) {
  run::Result result = result_by_hand();
  EXPECT_TRUE(gate_failures(record_of(judged(result), {})).empty());
  lose_a_light(result.cases[1]);
  const result::Result failed = record_of(judged(result), {});
  const Json json = result::to_json(failed);
  EXPECT_EQ(json["cases"][1]["failures"][0]["kind"], "lost_pairs");
  EXPECT_EQ(violations(json), std::vector<std::string>{});
  const auto failures = gate_failures(failed);
  ASSERT_EQ(failures.size(), 1u);
  for (const char* part :
       {"hall/walk/frustum 64px/aabb/packed: lost", "3 of 48", "frame 5", "[1,1,1]", "light 8", "torch", "12.5 %"})
    EXPECT_NE(failures[0].find(part), std::string::npos) << part << " in " << failures[0];
}

}  // namespace
}  // namespace clusterbench::report
