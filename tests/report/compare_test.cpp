#include "report/comparing/compare.h"

#include <gtest/gtest.h>

#include "records.h"
#include "report/comparing/compare_advice.h"
#include "report/comparison_by_hand.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::compared;
using testing::comparison_markdown;
using testing::comparison_text;
using testing::holds;
using testing::json_of;
using testing::k_gate_separate;
using testing::outcome;
using testing::paired;
using testing::result_by_hand;
using testing::verdict_of;
using testing::with_times;

TEST(Compare, a_result_is_the_same_as_itself) {
  const Json result = json_of(result_by_hand());
  const Json comparison = compared(result, result, 0.02);
  EXPECT_EQ(comparison["cases"][0]["hint"], "none");
  EXPECT_EQ(comparison["cases"][0]["counts"], "same");
  EXPECT_TRUE(comparison["cases"][0]["differences"].empty());
  EXPECT_EQ(outcome(comparison, true), ExitCode::ok) << comparison.dump(1);
  EXPECT_EQ(verdict_of(compared(result, result, 0.02, k_gate_separate), 0), "same");
}

TEST(Compare, times_of_separate_runs_give_hints_and_fail_nothing) {
  const Json comparison = compared(json_of(with_times(9000, 3000)), json_of(with_times(90000, 300)), 0.02);
  EXPECT_EQ(comparison["cases"][0]["hint"], "longer");
  EXPECT_EQ(comparison["cases"][1]["hint"], "shorter");
  EXPECT_EQ(verdict_of(comparison, 0), "none");
  EXPECT_FALSE(comparison["summary"].contains("ratio")) << "a mean of hints";
  EXPECT_EQ(outcome(comparison, true), ExitCode::ok) << comparison.dump(1);
  const std::string text = comparison_text(comparison), markdown = comparison_markdown(comparison);
  for (const std::string& said : {text, markdown}) {
    EXPECT_NE(said.find("longer?"), std::string::npos) << said;
    EXPECT_NE(said.find("baseline-binary"), std::string::npos) << said;
    EXPECT_NE(said.find("hints of time: 1 longer, 1 shorter"), std::string::npos) << said;
    for (const char* word : {"slower", "faster", "FAILED", "failed", "geometric"})
      EXPECT_EQ(said.find(word), std::string::npos) << word << "\n" << said;
  }
}

TEST(Compare, times_of_separate_runs_get_verdicts_on_request) {
  const Json comparison =
      compared(json_of(with_times(9000, 3000)), json_of(with_times(9900, 2700)), 0.02, k_gate_separate);
  EXPECT_EQ(verdict_of(comparison, 0), "slower");
  EXPECT_EQ(verdict_of(comparison, 1), "faster");
  EXPECT_NEAR(comparison["cases"][0]["ratio"].get<double>(), 1.1, 1e-12);
  EXPECT_FALSE(comparison["summary"].contains("ratio"));
  EXPECT_TRUE(holds(comparison["warnings"], "--gate-separate"));
  EXPECT_TRUE(holds(comparison["failures"], "slower by +10.0 %"));
  EXPECT_EQ(outcome(comparison, false), ExitCode::gate_failed);
}

TEST(Compare, the_threshold_says_what_matters) {
  const Json base = json_of(with_times(9000, 3000)), next = json_of(with_times(9900, 3000));
  EXPECT_EQ(compared(base, next, 0.2)["cases"][0]["hint"], "none");
  EXPECT_EQ(verdict_of(compared(base, next, 0.2, k_gate_separate), 0), "same");
}

TEST(Compare, wide_intervals_are_inconclusive_and_fail_only_if_strict) {
  run::Result next = with_times(9900, 3000);
  next.cases[0].timing->frame_ns.ci95 = {5000, 15000};
  const Json comparison = compared(json_of(with_times(9000, 3000)), json_of(next), 0.02, k_gate_separate);
  EXPECT_EQ(verdict_of(comparison, 0), "inconclusive");
  EXPECT_EQ(outcome(comparison, false), ExitCode::ok);
  EXPECT_EQ(outcome(comparison, true), ExitCode::inconclusive);
}

TEST(Compare, marks_have_a_legend_where_they_are_printed) {
  const Json base = json_of(with_times(9000, 3000)), same = compared(base, base, 0.02);
  Json next = json_of(with_times(9900, 3000));
  next["cases"][1]["tests_done"] = base["cases"][1]["tests_done"].get<double>() + 1;
  const std::string marked = comparison_text(compared(base, next, 0.02)), plain = comparison_text(same);
  EXPECT_NE(marked.find("\n  ? hall"), std::string::npos) << marked;
  EXPECT_NE(marked.find("\n  ! hall"), std::string::npos) << marked;
  EXPECT_NE(marked.find("\n! slower"), std::string::npos) << marked;
  EXPECT_NE(marked.find("\n? a hint"), std::string::npos) << marked;
  EXPECT_EQ(plain.find('!'), std::string::npos) << plain;
  EXPECT_EQ(plain.find('?'), std::string::npos) << plain;
}

TEST(Compare, methods_with_two_storages_are_one_method) {
  run::Result base = with_times(9000, 3000), next = with_times(9900, 3000);
  for (run::Result* result : {&base, &next}) {
    run::CaseResult copy = result->cases[0];
    copy.id += "2";
    copy.storage_label = "fixed";
    result->cases.push_back(copy);
    result->planned_ids.push_back(copy.id);
  }
  const Json comparison = compared(json_of(base), json_of(next), 0.02);
  EXPECT_EQ(comparison["cases"].size(), 3u);
  EXPECT_EQ(comparison["cases"][2]["hint"], "longer");
  EXPECT_EQ(comparison["time"], "frame");
  EXPECT_EQ(comparison["summary"]["methods_timed"], 3) << "each case has a frame time of its own";
  Json next_json = json_of(next);
  for (Json& entry : next_json["cases"]) entry["timing"]["baseline"] = paired(3.0);
  next_json["baseline"]["tool"] = next_json["tool"];
  EXPECT_EQ(compared(next_json, next_json, 0.02)["summary"]["methods_timed"], 2) << "assignment is shared";
}

TEST(Compare, only_what_is_worse_is_marked_as_such) {
  const Json base = json_of(with_times(9000, 3000));
  run::Result next = with_times(8000, 3000);
  next.cases[1].timing->frame_ns.ci95 = {2000, 5000};
  const std::string text = comparison_text(compared(base, json_of(next), 0.02, k_gate_separate));
  EXPECT_NE(text.find("\n  + hall/walk/frustum 64px/brute-force"), std::string::npos) << text;
  EXPECT_NE(text.find("\n  ? hall/walk/frustum 64px/aabb"), std::string::npos) << text;
  EXPECT_NE(text.find("\n+ faster"), std::string::npos) << text;
  EXPECT_NE(text.find("\n? inconclusive"), std::string::npos) << text;
  EXPECT_EQ(text.find('!'), std::string::npos) << text;
}

TEST(Compare, a_time_without_an_interval_concludes_nothing) {
  const Json base = json_of(with_times(9000, 3000));
  Json next = json_of(with_times(90000, 3000));
  next["cases"][0]["timing"]["frame_ns"]["ci95"] = {nullptr, nullptr};
  EXPECT_EQ(compared(base, next, 0.02)["cases"][0]["hint"], "none");
  EXPECT_EQ(verdict_of(compared(base, next, 0.02, k_gate_separate), 0), "inconclusive");
  EXPECT_EQ(verdict_of(compared(next, base, 0.02, k_gate_separate), 0), "inconclusive");
}

TEST(Compare, separate_runs_are_compared_by_what_a_frame_takes_or_not_at_all) {
  Json base = json_of(result_by_hand());
  const Json next = base;
  for (Json& entry : base["cases"]) entry["timing"]["frame_ns"]["median"] = nullptr;
  const Json comparison = compared(base, next, 0.02);
  EXPECT_EQ(comparison["time"], "frame");
  EXPECT_FALSE(comparison["cases"][0].contains("base_ns")) << "never its assignment in its place";
  EXPECT_EQ(comparison["summary"]["methods_timed"], 0);
}

TEST(Compare, another_allocation_margin_is_another_setting_and_nothing_worse) {
  const Json base = json_of(result_by_hand());
  Json next = base;
  next["config"]["allocation"]["margin"] = 3.0;
  for (Json& entry : next["cases"]) {
    entry["buffers"]["index_entries"]["recommended"] = 120;
    entry["buffers"]["used_share"]["mean"] = 0.1;
  }
  const Json comparison = compared(base, next, 0.02);
  EXPECT_EQ(comparison["cases"][0]["counts"], "same");
  EXPECT_TRUE(comparison["failures"].empty());
  EXPECT_NE(comparison["warnings"].dump().find("allocation.margin is 2"), std::string::npos) << comparison["warnings"];
  next["cases"][0]["buffers"]["index_entries"]["high_water"] = 41;
  EXPECT_EQ(compared(base, next, 0.02)["cases"][0]["counts"], "worse") << "the mark behind it";
  next = base;
  next["cases"][0]["buffers"]["index_entries"]["recommended"] = 120;
  EXPECT_EQ(compared(base, next, 0.02)["cases"][0]["counts"], "worse") << "of one setting";
}

// A later version may say the same in better words.
TEST(Compare, other_words_of_a_note_or_a_warning_are_no_other_counts) {
  Json base = json_of(result_by_hand());
  Json& entry = base["cases"][0];
  entry["grid"]["note"] = "the grid ends at 9 m";
  entry["warnings"] = Json::array({{{"kind", "too_many_lights"}, {"text", "300 lights in view"}}});
  Json next = base;
  next["cases"][0]["grid"]["note"] = "slices end at 9 m";
  next["cases"][0]["warnings"][0]["text"] = "there are 300 lights in view";
  const Json comparison = compared(base, next, 0.02);
  EXPECT_EQ(comparison["cases"][0]["counts"], "same");
  EXPECT_EQ(outcome(comparison, false), ExitCode::ok) << comparison.dump(1);
  next["cases"][0]["warnings"][0]["kind"] = "unchecked";
  EXPECT_EQ(compared(base, next, 0.02)["cases"][0]["counts"], "worse") << "another warning";
}

TEST(Compare, cases_of_one_name_that_are_not_the_same_are_told_with_what_differs) {
  const Json base = json_of(result_by_hand());
  Json next = base;
  for (Json& entry : next["cases"]) entry["id"] = entry["id"].get<std::string>() + "'";
  next["scenes"][0]["sha256"] = std::string(64, 'b');
  next["config"]["seed"] = 2;
  next["cases"][1]["frames"] = 7;
  const Json comparison = compared(base, next, 0.02);
  EXPECT_EQ(comparison["renamed"][0]["differs_in"], (Json{"the scene itself (sha256)", "seed"}));
  EXPECT_EQ(comparison["renamed"][1]["differs_in"], (Json{"the scene itself (sha256)", "frames (2, now 7)", "seed"}));
  EXPECT_TRUE(holds(comparison["warnings"], "differ in the scene itself (sha256), seed: hall/walk/frustum 64px/brute"));
  EXPECT_EQ(outcome(comparison, false), ExitCode::nothing_comparable);
  const std::string text = comparison_text(comparison);
  EXPECT_NE(text.find("0 cases in common: nothing was compared; 2 cases of the base not compared; 2 cases of the new"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("nothing has changed"), std::string::npos) << text;
  EXPECT_EQ(text.find("only in the"), std::string::npos) << "told once: " << text;
  EXPECT_EQ(text.find("base us"), std::string::npos) << "a table without rows: " << text;
}

TEST(Compare, each_setting_that_makes_another_case_is_named) {
  const Json base = json_of(result_by_hand());
  const auto difference = [&](const char* pointer, const Json& value) {
    Json next = base;
    for (Json& one : next["cases"]) one["id"] = one["id"].get<std::string>() + "'";
    if (*pointer != '\0') next[Json::json_pointer(pointer)] = value;
    return compared(base, next, 0.02)["renamed"][0]["differs_in"];
  };
  EXPECT_EQ(difference("/config/jitter", Json{{"halton", 8}}), Json{"jitter"});
  EXPECT_EQ(difference("/config/scenes", Json::parse(R"([{"camera_fit": "vertical"}])")), Json{"camera_fit"});
  EXPECT_EQ(difference("/config/samples", Json{{"fog", Json::object()}}), Json{"samples"});
  EXPECT_EQ(difference("/config/lookup", Json{{"samples", 9}}), Json{"lookup"});
  EXPECT_EQ(difference("/config/stability", Json{{"steps", 9}}), Json{"stability"});
  EXPECT_EQ(difference("/scenes/0/range_rule/max_range", 60), Json{"range_rule"});
  EXPECT_EQ(difference("", {}), Json{"something that results do not tell"});
}

TEST(Compare, a_measure_that_only_one_result_has_is_told) {
  const Json base = json_of(result_by_hand());
  Json next = base;
  for (Json& entry : next["cases"]) entry.erase("shading");
  next["cases"][0].erase("timing");
  const Json comparison = compared(base, next, 0.02);
  EXPECT_EQ(comparison["not_compared"], Json::parse(R"([{"part": "shading", "only_in": "base", "cases": 2},
      {"part": "timing", "only_in": "base", "cases": 1}])"));
  EXPECT_TRUE(holds(comparison["warnings"], "shading is not compared in 2 cases: only the base has it"));
  EXPECT_EQ(outcome(comparison, false), ExitCode::ok);
  EXPECT_EQ(outcome(comparison, true), ExitCode::inconclusive);
  EXPECT_TRUE(holds(compared(next, base, 0.02)["warnings"], "shading is not compared in 2 cases: only the new result"));
  EXPECT_EQ(outcome(compared(next, base, 0.02), true), ExitCode::ok) << "nothing to have become worse than";
}

TEST(Compare, parts_of_every_kind_that_only_one_result_has_are_named) {
  const Json base = json_of(result_by_hand());
  Json next = base;
  next["cases"][0].erase("lights_in_view");
  next["cases"][1].erase("error");
  EXPECT_EQ(compared(base, next, 0.02)["not_compared"], Json::parse(R"([
      {"part": "lights_in_view", "only_in": "base", "cases": 1}, {"part": "error", "only_in": "base", "cases": 1}])"));
  EXPECT_EQ(compared(next, base, 0.02)["not_compared"][1]["only_in"], "new");
  Json sampled = base;
  sampled["cases"][0]["samples"]["fog"] = sampled["cases"][0]["shading"];
  Json more = sampled;
  more["cases"][0]["samples"]["opaque"] = sampled["cases"][0]["shading"];
  EXPECT_EQ(compared(sampled, more, 0.02)["not_compared"],
            Json::parse(R"([{"part": "samples.opaque", "only_in": "new", "cases": 1}])"));
}

// Where there is nothing to record is no missing part: a loss that is gone fails no --strict.
TEST(Compare, records_that_follow_from_counts_are_no_parts) {
  run::Result lossy = result_by_hand();
  testing::lose_a_light(lossy.cases[0]);
  Json base = json_of(lossy);
  ASSERT_TRUE(base["cases"][0]["error"].contains("deepest"));
  base["cases"][1]["timing"]["baseline"] = paired(0.0);
  const Json comparison = compared(base, json_of(result_by_hand()), 0.02);
  EXPECT_EQ(comparison["cases"][0]["counts"], "better");
  EXPECT_EQ(comparison["not_compared"], Json::array());
  EXPECT_EQ(outcome(comparison, true), ExitCode::ok);
}

// Prices are no part of a case's id; costs at other prices are no change of what is counted.
class ComparePrices : public ::testing::Test {
 protected:
  ComparePrices() {
    base_["config"]["cost"] = {{"ns_per_light", 1.0}, {"wave", "8x8"}, {"weights", {{"opaque", 1.0}}}};
    base_["cases"][0]["cost"] = Json::parse(R"({"frame_ns": 9.0, "assign_ns": 1.0, "gpu_ns": 8.0, "upload_ns": 1.0,
        "traffic_ns": 1.0, "shade_ns": 6.0, "lit": true,
        "sets": {"opaque": {"samples": 10.0, "lights": 2.0, "divergence": 1.5, "ns": 6.0}}})");
    next_ = base_;
    for (const char* key : {"gpu_ns", "shade_ns"}) next_["cases"][0]["cost"][key] = 14.0;
    next_["cases"][0]["cost"]["sets"]["opaque"]["ns"] = 14.0;
  }
  std::string counts() const { return compared(base_, next_, 0.02)["cases"][0]["counts"]; }
  Json& opaque() { return next_["cases"][0]["cost"]["sets"]["opaque"]; }

  Json base_ = json_of(result_by_hand()), next_;
};

TEST_F(ComparePrices, that_differ_leave_out_the_times_of_costs_alone) {
  EXPECT_EQ(counts(), "worse") << "at the same prices";
  next_["config"]["cost"]["ns_per_light"] = 2.0;
  EXPECT_EQ(counts(), "same");
  EXPECT_TRUE(
      holds(compared(base_, next_, 0.02)["warnings"],
            "cost.ns_per_light is 1.0 and 2.0, another setting: modelled costs follow it and are not compared"));
  opaque()["divergence"] = 1.6;
  EXPECT_EQ(counts(), "worse");
  next_["config"]["cost"]["wave"] = "4x8";
  EXPECT_EQ(counts(), "same") << "waves of other pixels diverge otherwise";
  opaque()["lights"] = 3.0;
  EXPECT_EQ(counts(), "worse");
  next_["config"]["cost"]["weights"]["volume"] = 1.0;
  EXPECT_EQ(counts(), "same") << "of other sets of samples";
  EXPECT_TRUE(holds(compared(base_, next_, 0.02)["warnings"], "cost.weights.volume is null and 1.0"));
}

TEST_F(ComparePrices, that_an_older_result_lacks_were_0) {
  next_["config"]["cost"]["ns_per_read"] = 0.0;
  EXPECT_EQ(counts(), "worse");
  next_["config"]["cost"]["ns_per_read"] = 0.005;
  EXPECT_EQ(counts(), "same");
  std::swap(base_, next_);
  EXPECT_EQ(counts(), "same");
}

TEST(Compare, of_waves_the_lengths_of_lists_are_judged_and_not_what_is_divided_by_them) {
  run::Result result = result_by_hand();
  measure::Coherence coherence;
  coherence.sizes[0].waves = coherence.sizes[1].waves = 10;
  coherence.sizes[0].longest = coherence.sizes[1].longest = 30;
  coherence.sizes[0].mean = coherence.sizes[1].mean = 20.0;
  const measure::ShadingCounts counts{.samples = 100, .evaluated = 250, .needed = 200};
  for (run::CaseResult& case_result : result.cases)
    case_result.samples = {{measure::SampleSet::opaque, counts, coherence}};
  const Json base = json_of(result);
  result.cases[1].samples[0].coherence->sizes[0].mean = 15.0;
  EXPECT_EQ(compared(base, json_of(result), 0.02)["cases"][1]["counts"], "better");
  result.cases[1].samples[0].coherence->sizes[0].longest = 31;
  EXPECT_EQ(compared(base, json_of(result), 0.02)["cases"][1]["counts"], "worse");
}

TEST(Compare, a_lost_light_is_named_with_frame_cell_and_light) {
  run::Result next = result_by_hand();
  testing::lose_a_light(next.cases[1]);
  const Json comparison = compared(json_of(result_by_hand()), json_of(next), 0.02);
  EXPECT_EQ(comparison["cases"][1]["counts"], "worse");
  EXPECT_EQ(comparison["cases"][1]["place"], "frame 5, cell [1,1,1], light 8 ('torch')");
  EXPECT_EQ(outcome(comparison, false), ExitCode::gate_failed);
  const std::string text = comparison_text(comparison), markdown = comparison_markdown(comparison);
  EXPECT_NE(text.find("error/false_negatives worse: 0 -> 3"), std::string::npos) << text;
  EXPECT_NE(text.find("frame 5, cell [1,1,1], light 8 ('torch')"), std::string::npos) << text;
  EXPECT_NE(markdown.find("light 8 ('torch')"), std::string::npos) << markdown;
}

TEST(Compare, a_single_pair_or_byte_more_fails_and_one_less_does_not) {
  const Json base = json_of(result_by_hand());
  for (const char* place : {"/cases/0/error/reported_pairs", "/cases/0/buffers/bytes/high_water",
                            "/cases/0/occupancy/pairs/mean", "/cases/0/tests_done"}) {
    Json next = base;
    const Json::json_pointer pointer(place);
    next[pointer] = base[pointer].get<double>() + 1;
    EXPECT_EQ(outcome(compared(base, next, 0.02), false), ExitCode::gate_failed) << place;
    EXPECT_EQ(outcome(compared(next, base, 0.02), false), ExitCode::ok) << place;
    EXPECT_EQ(compared(next, base, 0.02)["cases"][0]["counts"], "better") << place;
  }
}

TEST(Compare, of_a_cost_its_times_are_not_compared_and_the_rest_is_as_other_counts) {
  Json base = json_of(result_by_hand());
  base["cases"][1]["cost"] = {{"frame_ns", 300.0}, {"assign_ns", 100.0}, {"gpu_ns", 200.0}};
  base["cases"][1]["tests_done"] = 10;
  Json next = base;
  next["cases"][1]["cost"]["frame_ns"] = 303.0;
  next["cases"][1]["cost"]["assign_ns"] = 103.0;
  EXPECT_EQ(compared(base, next, 0.02)["cases"][1]["counts"], "same");
  next["cases"][1]["cost"]["gpu_ns"] = 190.0;
  EXPECT_EQ(compared(base, next, 0.02)["cases"][1]["counts"], "better");
  next["cases"][1]["cost"]["gpu_ns"] = 210.0;
  next["cases"][1]["tests_done"] = 9;
  EXPECT_EQ(compared(base, next, 0.02)["cases"][1]["counts"], "worse") << "of two counts one is more";
}

TEST(Compare, another_truth_or_another_list_of_the_same_length_fails) {
  const Json base = json_of(result_by_hand());
  for (const char* place : {"/cases/0/error/true_pairs", "/cases/0/occupancy/worst_frame"}) {
    Json next = base;
    const Json::json_pointer pointer(place);
    next[pointer] = base[pointer].get<int>() - 1;
    EXPECT_EQ(outcome(compared(base, next, 0.02), false), ExitCode::gate_failed) << place;
  }
}

TEST(Compare, a_scene_of_another_name_counts_the_same) {
  const Json base = json_of(result_by_hand());
  Json next = base;
  for (Json& result_case : next["cases"]) result_case["scene"] = "hall-2";
  EXPECT_EQ(outcome(compared(base, next, 0.02), false), ExitCode::ok);
  EXPECT_EQ(compared(base, next, 0.02)["cases"][0]["counts"], "same");
}

TEST(Compare, a_figure_that_only_one_version_knows_is_passed_over) {
  const Json base = json_of(result_by_hand());
  Json next = base;
  ASSERT_EQ(next["cases"][0]["shading"].erase("lost_lux"), 1u);
  EXPECT_EQ(outcome(compared(base, next, 0.02), true), ExitCode::ok);
  EXPECT_EQ(outcome(compared(next, base, 0.02), true), ExitCode::ok);
}

TEST(Compare, an_inexact_result_fails_even_if_it_was_so_before) {
  run::Result result = result_by_hand();
  testing::lose_a_light(result.cases[1]);
  const Json comparison = compared(json_of(result), json_of(result), 0.02);
  EXPECT_EQ(outcome(comparison, false), ExitCode::gate_failed);
}

TEST(Compare, cases_of_one_side_are_named_and_fail_only_if_strict) {
  run::Result next = result_by_hand();
  next.cases.pop_back();
  const Json base = json_of(result_by_hand()), comparison = compared(base, json_of(next), 0.02);
  EXPECT_TRUE(holds(comparison["only_in_base"], "aabb"));
  EXPECT_TRUE(holds(comparison["warnings"], "only in the base"));
  EXPECT_EQ(outcome(comparison, false), ExitCode::ok);
  EXPECT_EQ(outcome(comparison, true), ExitCode::inconclusive);
  next.cases.clear();
  EXPECT_EQ(outcome(compared(base, json_of(next), 0.02), false), ExitCode::nothing_comparable);
}

TEST(Compare, instructions_gate_where_no_paired_time_does) {
  run::Result base = result_by_hand();
  testing::add_count(base.cases[0]);
  run::Result next = base;
  next.cases[0].count->assign.instructions = 42000;  // of 40,000
  const Json comparison = compared(json_of(base), json_of(next), 0.02);
  EXPECT_EQ(comparison["cases"][0]["instructions"]["verdict"], "more");
  EXPECT_NEAR(comparison["cases"][0]["instructions"]["assign_ratio"].get<double>(), 1.05, 1e-12);
  EXPECT_EQ(outcome(comparison, false), ExitCode::gate_failed);
  EXPECT_EQ(outcome(compared(json_of(next), json_of(base), 0.02), false), ExitCode::ok);
  next.cases[0].count->source = "perf";
  const Json other = compared(json_of(base), json_of(next), 0.02);
  EXPECT_FALSE(other["cases"][0].contains("instructions"));
  EXPECT_EQ(outcome(other, true), ExitCode::inconclusive);
}

std::string advice_on_no_case(const Json& base, const Json& next) {
  return advice_on_nothing(test::result_of(base), test::result_of(next), "a.json", "b.json");
}

TEST(Compare, nothing_in_common_points_to_the_command_that_answers) {
  const Json base = json_of(result_by_hand());
  Json grids = base, level = base;
  for (Json& result_case : grids["cases"]) result_case["grid"]["name"] = "frustum 32px";
  EXPECT_NE(advice_on_no_case(base, grids).find("`clusterbench ratio RESULT --across-grids`"), std::string::npos);
  EXPECT_NE(advice_on_no_case(base, grids).find("`clusterbench report a.json b.json"), std::string::npos);
  for (Json& result_case : level["cases"]) result_case["id"] = "another";
  EXPECT_NE(advice_on_no_case(base, level).find("--baseline a.json --allow-changed-lights"), std::string::npos);
}

TEST(Compare, a_level_of_another_name_may_be_the_same_one_before_its_change) {
  const Json base = json_of(result_by_hand());
  Json next = base;
  for (Json& result_case : next["cases"]) result_case["scene"] = "hall-v2";
  next["scenes"][0]["name"] = "hall-v2";
  EXPECT_NE(advice_on_no_case(base, next).find("--baseline a.json --allow-changed-lights"), std::string::npos);
  next["scenes"].push_back(base["scenes"][0]);
  EXPECT_EQ(advice_on_no_case(base, next).find("--baseline"), std::string::npos);
}

TEST(Compare, names_in_markdown_are_no_markup) {
  run::Result result = result_by_hand();
  result.cases[0].name = "a|b <script> `c` *d*";
  const Json json = json_of(result);
  const std::string markdown = comparison_markdown(compared(json, json, 0.02));
  EXPECT_NE(markdown.find(R"(a\|b \<script\> \`c\` \*d\*)"), std::string::npos) << markdown;
}

}  // namespace
}  // namespace clusterbench::report
