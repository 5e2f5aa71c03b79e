// What a result says is to be done.

#include "report/choosing/conclusion.h"
#include "needs.h"

#include <gtest/gtest.h>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/libraries.h"
#include "records.h"
#include "report/cases/case_filter.h"
#include "report/choosing/answer_conclusion.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"
#include "report/tables/table.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::result_by_hand;

const Json k_usual_model = {{"ns_per_light", 0.02},      {"ns_per_read", 0.005},   {"read_gb_per_s", 2283},
                            {"upload_gb_per_s", 15.75},  {"memory_gb_per_s", 448}, {"wave", "8x8"},
                            {"weights", {{"opaque", 1}}}};

Json valid_json(const run::Result& result) {
  Json json = result::to_json(record_of(result, {}));
  EXPECT_EQ(config::schema_violations(config::result_schema(), nlohmann::json::parse(json.dump())),
            std::vector<std::string>{});
  return json;
}

Json only_conclusion(const run::Result& result) {
  const Json json = valid_json(result);
  EXPECT_EQ(json["conclusions"].size(), 1u);
  return json["conclusions"][0];
}

bool has_words(const Json& conclusion, const std::string& part) {
  return conclusion["text"].get<std::string>().find(part) != std::string::npos;
}

TEST(Conclusion, names_a_filter_that_selects_what_it_takes_alone) {
  const std::string grid = "frustum 64px (near 0.5)/", fixed = grid + "exact-fast/fixed(cap=8)";
  result::Result result;
  for (const char* camera : {"a", "b"})
    for (const char* storage : {"packed", "packed(equal_lists=shared)", "fixed(cap=8)", "fixed(cap=80)", "linked"}) {
      result::Case& one = result.cases.emplace_back();
      one.scene = "hall";
      one.camera = camera;
      one.grid.name = "frustum 64px (near 0.5)";
      one.assigner.name = "exact-fast";
      one.storage = storage;
      one.name = one.scene + "/" + one.camera + "/" + grid + "exact-fast/" + one.storage;
    }
  EXPECT_EQ(filter_of(grid + "exact-fast/linked", result), grid + "exact-fast/linked");
  EXPECT_EQ(filter_of(fixed, result), fixed) << "of no other name a part";
  const std::string filter = filter_of(grid + "exact-fast/packed", result);
  EXPECT_EQ(filter, R"(frustum 64px \(near 0\.5\)/exact-fast/packed$)");
  result::Result kept = result;
  keep_cases(kept, filter, "");
  ASSERT_EQ(kept.cases.size(), 2u);
  EXPECT_EQ(kept.cases[1].name, "hall/b/" + grid + "exact-fast/packed");
}

TEST(Conclusion, takes_the_fastest_and_says_against_what_by_how_much_and_how_sure) {
  run::Result result = result_by_hand();  // 9.5 and 3.5 us
  for (run::CaseResult& one : result.cases) one.shading.reset();
  const Json conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "fast");
  EXPECT_EQ(conclusion["against"], "slow");
  EXPECT_NEAR(conclusion["ratio"].get<double>(), 9.5 / 3.5, 1e-3);
  EXPECT_TRUE(has_words(conclusion,
                        "hall, camera walk, 1920x1080: take frustum 64px/aabb/packed (232 B); 3.50 us a frame to make"))
      << conclusion["text"];
  EXPECT_TRUE(
      has_words(conclusion,
                "frustum 64px/brute-force/packed costs 2.71 times as much (95 % interval of the times: 2.71 to 2.71)"))
      << conclusion["text"];
  EXPECT_EQ(conclusions_text(test::result_of(valid_json(result))),
            "conclusion: " + conclusion["text"].get<std::string>() + "\n");
}

TEST(Conclusion, short_lists_pay_for_the_time_to_make_them) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  result.cases[0].shading->evaluated = 220;  // of the slow one, where 200 are needed; 300 of the fast one
  const Json conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "slow");
  EXPECT_EQ(conclusion["against"], "fast");
  EXPECT_TRUE(has_words(conclusion, "9.50 us to make the lists on this machine")) << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "Fastest to make: frustum 64px/aabb/packed, 3.50 us")) << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "samples are at random depths")) << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "samples.opaque.ground=lowest")) << conclusion["text"];
}

TEST(Conclusion, of_a_build_that_sees_no_surfaces_does_not_blame_the_scene) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  result.config["samples"] = {{"opaque", nlohmann::json::object()}};
  EXPECT_TRUE(has_words(only_conclusion(result), "since the scene has no triangles"));
  result.skipped.push_back({"hall/samples opaque", built_without(Library::embree)});
  const Json conclusion = only_conclusion(result);
  EXPECT_FALSE(has_words(conclusion, "no triangles")) << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "since clusterbench was built without Embree")) << conclusion["text"];
}

TEST(Conclusion, times_whose_intervals_overlap_show_no_difference_and_the_smaller_one_is_taken) {
  run::Result result = result_by_hand();
  for (run::CaseResult& one : result.cases) one.shading.reset();
  const auto times = [](double even, double odd) {
    std::vector<double> samples;
    for (int i = 0; i < 24; ++i) samples.push_back(i % 2 == 0 ? even : odd);
    return measure::TimeStats{0.5 * (even + odd), 1.0, even, odd, {even, odd}, samples};
  };
  result.cases[0].timing->frame_ns = times(3000.0, 4200.0);
  result.cases[1].timing->frame_ns = times(4000.0, 3000.0);
  result.cases[0].buffers.bytes.high_water = 200;  // of 232
  const Json conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "slow") << "has fewer bytes";
  EXPECT_EQ(conclusion["alike"], Json({"fast"})) << conclusion["text"];
  EXPECT_TRUE(conclusion["against"].is_null());
  EXPECT_TRUE(has_words(conclusion, "Not told apart by these times: frustum 64px/aabb/packed")) << conclusion["text"];
}

TEST(Conclusion, modelled_costs_within_5_percent_are_alike_and_what_leaves_nothing_unlit_is_taken) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  for (run::CaseResult& one : result.cases) one.timing.reset();
  measure::ShadingCounts &first = *result.cases[0].shading, &second = *result.cases[1].shading;
  first.needed = second.needed = 100000;
  first.missed = 0;
  first.evaluated = 118000;
  second.evaluated = 120000;                       // dearer by less than 5 %
  second.missed = 20;                              // less than a thousandth
  result.cases[0].buffers.bytes.high_water = 300;  // of 232
  Json conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "slow") << conclusion["text"];
  EXPECT_EQ(conclusion["alike"], Json({"fast"})) << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "About the same cost (within 5 %): ")) << conclusion["text"];
  EXPECT_FALSE(has_words(conclusion, "lack")) << conclusion["text"];
  first.evaluated = 200000;
  conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "fast") << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "Its samples (random points in the view) lack 0.02 % of the lights that they need"))
      << conclusion["text"];
}

// The brackets are about the ratio that stands before them, of rounds and not of medians.
TEST(Conclusion, the_range_of_prices_holds_the_ratio_that_is_told) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  result.cases[0].shading->evaluated = 220;
  std::vector<double>& rounds = result.cases[1].timing->frame_ns.samples;
  for (double& ns : rounds) ns *= 1.5;  // beside a median that stays
  const Json conclusion = only_conclusion(result);
  ASSERT_TRUE(conclusion["ratio"].is_number()) << conclusion.dump();
  const double ratio = conclusion["ratio"].get<double>();
  EXPECT_LE(conclusion["by_prices"][0].get<double>(), ratio) << conclusion.dump();
  EXPECT_GE(conclusion["by_prices"][1].get<double>(), ratio) << conclusion.dump();
}

TEST(Conclusion, what_lights_opaque_surfaces_alone_is_taken_with_that_remark_and_after_what_costs_the_same) {
  run::Result result = result_by_hand();
  for (run::CaseResult& one : result.cases) one.timing.reset(), one.shading->missed = 0;
  result.config["cost"] = k_usual_model;
  result.cases[0].assigner = "tiled";
  result.cases[0].shading->evaluated = result.cases[1].shading->evaluated;
  result.cases[0].buffers.bytes.high_water = 100;  // of 232
  EXPECT_EQ(only_conclusion(result)["take"], "fast");
  result.cases.pop_back();
  result.planned_ids.pop_back();
  const Json alone = only_conclusion(result);
  EXPECT_EQ(alone["take"], "slow");
  EXPECT_TRUE(has_words(alone, ". It lights visible opaque surfaces alone: transparent ones, particles and fog need"))
      << alone["text"];
}

TEST(Conclusion, takes_only_what_has_a_star) {
  run::Result result = result_by_hand();
  const Json json = valid_json(result);
  const Json ids = json["pareto_front"][0]["ids"];
  EXPECT_NE(std::find(ids.begin(), ids.end(), json["conclusions"][0]["take"]), ids.end());
}

// Visible surfaces whose samples are given so many lights each, of which they need one.
void shade_surfaces(run::CaseResult& one, std::uint64_t lights_per_sample, std::uint64_t missed = 0) {
  run::SampleSetResult opaque{measure::SampleSet::opaque, {}, {}};
  opaque.counts.samples = opaque.counts.needed = 100000;
  opaque.counts.evaluated = lights_per_sample * opaque.counts.samples;
  opaque.counts.missed = missed;
  one.samples = {opaque};
}

TEST(Conclusion, what_lacks_lights_on_surfaces_has_no_star_and_is_not_taken_however_cheap) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  shade_surfaces(result.cases[0], 5);
  shade_surfaces(result.cases[1], 2, 101);  // more than a thousandth; points of the whole view lack none
  const Json json = valid_json(result);
  EXPECT_EQ(json["pareto_front"][0]["ids"], Json::array({"slow"}));
  EXPECT_EQ(json["conclusions"][0]["take"], "slow") << json["conclusions"][0]["text"];
  EXPECT_TRUE(json["conclusions"][0]["alike"].empty());
}

TEST(Conclusion, the_star_counts_overshade_at_samples_that_cost_something) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  shade_surfaces(result.cases[0], 2);  // slower and larger, of fewer lights where pixels are
  shade_surfaces(result.cases[1], 9);
  result.cases[0].shading->evaluated = 1000;
  const Json json = valid_json(result);
  EXPECT_EQ(json["pareto_front"][0]["ids"], Json::array({"slow", "fast"}));
  EXPECT_EQ(json["conclusions"][0]["take"], "slow");
}

measure::TimeStats even_times(double ns, double low, double high, int rounds) {
  return {ns, 0.0, low, high, {low, high}, std::vector<double>(static_cast<std::size_t>(rounds), ns)};
}

TEST(Conclusion, is_held_against_the_cheapest_that_is_dearer_on_the_front_or_not) {
  run::Result result = result_by_hand();
  for (run::CaseResult& one : result.cases) one.shading.reset();
  run::CaseResult next = result.cases[1];
  next.id = "next";
  next.name = "hall/walk/frustum 64px/bounds/packed";
  next.timing->frame_ns = even_times(4200.0, 4190.0, 4210.0, 24);
  next.buffers.bytes.high_water = 1000;  // dominated by fast, which is better in all
  result.cases.push_back(next);
  result.planned_ids.emplace_back("next");
  const Json conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "fast");
  EXPECT_EQ(conclusion["against"], "next") << conclusion["text"];
}

TEST(Conclusion, too_few_launches_for_an_interval_leave_the_costs_to_choose_by) {
  run::Result result = result_by_hand();
  for (run::CaseResult& one : result.cases) {
    one.shading.reset();
    one.timing->launches = 2;
  }
  result.cases[0].timing->frame_ns = {5000.0, 0.0, 5000.0, 5000.0, {}, {5000.0, 5000.0}};
  result.cases[1].timing->frame_ns = {4000.0, 0.0, 4000.0, 4000.0, {}, {4000.0, 4000.0}};
  result.cases[0].buffers.bytes.high_water = 1;
  const Json conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "fast") << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "costs 25 % more, not measured often enough side by side for an interval"))
      << conclusion["text"];
}

TEST(Conclusion, what_its_samples_alone_make_dearer_is_dearer_however_its_times_scatter) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  for (run::CaseResult& one : result.cases) {
    shade_surfaces(one, 5);
    one.timing->frame_ns.samples = {3000.0};
  }
  result.cases[0].samples[0].counts.evaluated = 2000000;  // 20 us a frame
  result.cases[0].timing->frame_ns = {100.0, 0.0, 1.0, 1e6, {1.0, 1e6}, {1.0}};
  const Json conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "fast") << conclusion["text"];
  EXPECT_TRUE(conclusion["alike"].empty()) << conclusion["text"];
}

TEST(Conclusion, says_from_and_to_what_prices_change_the_difference) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  for (run::CaseResult& one : result.cases) one.timing.reset();
  shade_surfaces(result.cases[0], 4);
  shade_surfaces(result.cases[1], 5);
  result.cases[1].samples[0].counts.reads = assign::Reads::of(800000, 3200000);
  result.cases[0].samples[0].counts.needed = result.cases[1].samples[0].counts.needed = 999;
  const Json conclusion = only_conclusion(result);
  ASSERT_EQ(conclusion["by_prices"].size(), 2u) << conclusion["text"];
  EXPECT_LT(conclusion["by_prices"][0].get<double>(), conclusion["ratio"].get<double>());
  EXPECT_GT(conclusion["by_prices"][1].get<double>(), conclusion["ratio"].get<double>());
  EXPECT_TRUE(has_words(conclusion, "with the model's prices halved or doubled: ")) << conclusion["text"];
  EXPECT_TRUE(has_words(
      conclusion, "Its samples (visible surfaces) need only 999 lights, summed over all samples: costs are rough"))
      << conclusion["text"];
}

TEST(Conclusion, says_where_other_prices_turn_the_difference) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  for (run::CaseResult& one : result.cases) one.timing.reset();
  shade_surfaces(result.cases[0], 50);
  shade_surfaces(result.cases[1], 5);
  Json conclusion;
  for (std::uint64_t reads = 1; reads < 1'000'000'000'000; reads = reads * 5 / 4 + 1) {  // until it is somewhat dearer
    result.cases[1].samples[0].counts.reads = assign::Reads::of(reads, 4 * reads);
    conclusion = only_conclusion(result);
    if (conclusion["take"] == "slow" && conclusion.value("ratio", 0.0) > 1.06) break;
  }
  ASSERT_GT(conclusion.value("ratio", 0.0), 1.06) << conclusion["text"];
  ASSERT_LT(conclusion["by_prices"][0].get<double>(), 1.0) << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, ", so it may cost less on another GPU)")) << conclusion["text"];
  EXPECT_FALSE(has_words(conclusion, "e+0")) << conclusion["text"];
}

TEST(Conclusion, where_nothing_is_seen_no_case_has_a_star) {
  run::Result away = result_by_hand(), dark = result_by_hand();
  for (run::CaseResult& one : away.cases) one.lights_in_view.sum = one.lights_in_view.most = 0;
  for (run::CaseResult& one : dark.cases) one.lights_in_view.is_lit = one.lights_in_view.is_seen = {};
  for (const auto& [result, why] :
       {std::pair(&away, "no light is in view in any frame"),
        std::pair(&dark, "all lights in view are dark (intensity 0 or black) in all frames")}) {
    const Json json = valid_json(*result);
    EXPECT_EQ(json["pareto_front"][0]["ids"], Json::array());
    EXPECT_TRUE(json["conclusions"][0]["take"].is_null());
    EXPECT_TRUE(has_words(json["conclusions"][0], std::string("nothing to take: ") + why)) << json["conclusions"][0];
    const std::string table = render_table(test::result_of(json), false);
    EXPECT_EQ(table.find("\n  * "), std::string::npos) << table;
  }
}

TEST(Conclusion, of_a_run_that_failed_nothing_is_taken_and_it_says_for_what) {
  Json json = valid_json(result_by_hand());
  EXPECT_FALSE(json["conclusions"][0]["take"].is_null());
  json["preset_rankings"] = {{{"scene", "hall"},
                              {"camera", "walk"},
                              {"viewport", {1920, 1080}},
                              {"best", "fast"},
                              {"alike", {"fast"}},
                              {"cases", Json::array()},
                              {"text", "take fast"}}};
  json["conclusions"][0]["by_prices"] = {1.1, 1.2};
  result::Result failed = test::result_of(json);
  conclude_failures(failed, {"hall: too many", "hall: too few"});
  json = result::to_json(failed);
  EXPECT_EQ(json["failed"], Json({"hall: too many", "hall: too few"}));
  const Json& conclusion = json["conclusions"][0];
  for (const char* key : {"take", "against", "ratio", "ci95"}) EXPECT_TRUE(conclusion[key].is_null()) << key;
  EXPECT_FALSE(conclusion.contains("by_prices")) << "of a difference to nothing";
  EXPECT_EQ(conclusion["alike"], Json::array());
  const std::string why = "the run FAILED: hall: too many (and for 1 other reason)";
  EXPECT_EQ(conclusion["text"], "hall, camera walk, 1920x1080: nothing to take: " + why + ".");
  EXPECT_EQ(failed_conclusion(failed), "none, since " + why);
  EXPECT_TRUE(json["preset_rankings"][0]["best"].is_null());
  EXPECT_EQ(json["preset_rankings"][0]["text"], "nothing to take: " + why);
  EXPECT_EQ(config::schema_violations(config::result_schema(), nlohmann::json::parse(json.dump())),
            std::vector<std::string>{});
}

TEST(Conclusion, a_case_that_fails_by_itself_fails_the_run) {
  run::Result result = result_by_hand();
  testing::lose_a_light(result.cases[0]);
  result.cases[0].conservative = true;
  const Json conclusion = only_conclusion(testing::judged(result));
  EXPECT_TRUE(conclusion["take"].is_null());
  EXPECT_TRUE(has_words(conclusion, "the run FAILED: hall/walk/frustum 64px/brute-force/packed: lost 3 of 48"))
      << conclusion["text"];
}

TEST(Conclusion, of_cases_that_all_lose_lights_none_is_taken) {
  run::Result result = result_by_hand();
  for (run::CaseResult& one : result.cases) {
    testing::lose_a_light(one);
    one.conservative = one.exact = false;
  }
  const Json conclusion = only_conclusion(testing::judged(result));
  EXPECT_TRUE(conclusion["take"].is_null());
  EXPECT_TRUE(has_words(conclusion, "take none of 2 cases: each loses lights.")) << conclusion["text"];
}

TEST(Conclusion, what_is_not_conservative_is_not_taken_for_having_lost_nothing_here) {
  run::Result result = result_by_hand();
  for (run::CaseResult& one : result.cases) one.conservative = one.exact = false;
  testing::lose_a_light(result.cases[0]);
  const run::Result judged = testing::judged(result);
  const Json conclusion = only_conclusion(judged), json = result::to_json(record_of(judged, {}));
  EXPECT_TRUE(conclusion["take"].is_null());
  EXPECT_TRUE(has_words(conclusion, "each loses lights, or (1) lost none here and is not conservative"))
      << conclusion["text"];
  EXPECT_TRUE(json["pareto_front"][0]["ids"].empty()) << json["pareto_front"];
}

TEST(Conclusion, where_nothing_is_seen_nothing_is_taken) {
  const auto expect_none = [](const run::Result& result, const std::string& why) {
    const Json conclusion = only_conclusion(result);
    EXPECT_TRUE(conclusion["take"].is_null()) << conclusion["text"];
    EXPECT_TRUE(conclusion["against"].is_null()) << conclusion["text"];
    EXPECT_EQ(conclusion["text"], "hall, camera walk, 1920x1080: nothing to take: " + why + ".");
  };
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  for (run::CaseResult& one : result.cases) one.shading->needed = 0;
  expect_none(result, "no light reaches any of 100 samples");
  for (run::CaseResult& one : result.cases) {
    run::SampleSetResult floor;
    floor.set = measure::SampleSet::opaque;
    floor.ground_m = 1.7;
    one.samples.push_back(floor);
  }
  expect_none(result, "no pixel sees the floor at y = 1.7 m (samples.opaque.ground)");
  for (run::CaseResult& one : result.cases) one.lights_in_view.sum = one.lights_in_view.most = 0;
  expect_none(result, "no light is in view in any frame");
  for (run::CaseResult& one : result.cases) one.lights = 0;
  expect_none(result, "the scene has no point or spot lights");
}

TEST(Conclusion, without_samples_it_rests_on_times_where_a_light_is_in_view) {
  run::Result result = result_by_hand();
  for (run::CaseResult& one : result.cases) one.shading->samples = one.shading->needed = one.shading->evaluated = 0;
  EXPECT_EQ(only_conclusion(result)["take"], "fast");
}

TEST(Conclusion, what_samples_search_is_named_and_not_taken) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  run::CaseResult walked = result.cases[1];
  walked.id = "walked";
  walked.name = "hall/walk/frustum 64px/bvh/own";
  walked.assigner = walked.assigner_label = "bvh";
  walked.storage_label = "own";
  walked.shading->evaluated = 200;
  walked.shading->reads = assign::Reads::of(1, 1);
  result.cases.push_back(walked);
  result.planned_ids.emplace_back("walked");
  const Json conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "fast");
  EXPECT_TRUE(has_words(conclusion, "frustum 64px/bvh/own, which samples search, would cost")) << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "no GPU has measured such a search")) << conclusion["text"];
  result.cases = {walked};
  result.planned_ids = {"walked"};
  EXPECT_TRUE(has_words(only_conclusion(result), "nothing to take: only structures that samples search"));
}

TEST(Conclusion, without_times_says_that_nothing_was_timed) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  for (run::CaseResult& one : result.cases) one.timing.reset();
  result.cases[0].shading->evaluated = 250;
  const Json conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "slow");
  EXPECT_TRUE(conclusion["ci95"].is_null());
  EXPECT_TRUE(has_words(conclusion, "and nothing was timed")) << conclusion["text"];
}

// What three methods leave that make the same lists: every light against every cell, plainly, and with SIMD.
TEST(Conclusion, of_methods_with_the_same_lists_that_nobody_timed_the_fast_form_is_taken_and_has_the_star) {
  run::Result result = result_by_hand();
  result.cases.push_back(testing::case_by_hand("simd", "aabb-fast", 1.0));
  result.planned_ids.emplace_back("simd");
  for (run::CaseResult& one : result.cases) one.timing.reset();
  for (const bool has_samples : {true, false}) {
    if (!has_samples)
      for (run::CaseResult& one : result.cases) one.shading.reset();
    const Json json = valid_json(result), conclusion = json["conclusions"][0];
    EXPECT_EQ(conclusion["take"], "simd") << conclusion["text"];
    EXPECT_EQ(conclusion["alike"].size(), 2u);
    EXPECT_TRUE(has_words(conclusion, "2 other methods make the same lists")) << conclusion["text"];
    EXPECT_FALSE(has_words(conclusion, "brute-force")) << conclusion["text"];
    EXPECT_EQ(json["pareto_front"][0]["ids"], Json::array({"simd"}));
  }
  result.cases[0].buffers.index_entries.high_water = 39;  // other lists
  EXPECT_TRUE(has_words(only_conclusion(result), "1 other method makes the same lists"));
  EXPECT_TRUE(has_words(only_conclusion(result), "The same by these figures: frustum 64px/brute-force/packed"));
}

Json answer_by_hand(double by_choice, const Json& ci95) {
  const auto record = [](const char* name, double objective, double by) {
    return Json{{"name", name}, {"objective", objective}, {"by_choice", by}};
  };
  Json runner_up = record("frustum 32px/aabb/packed", 100.0 * by_choice, by_choice);
  if (!ci95.is_null()) runner_up["ci95"] = ci95;
  return {{"scene", "hall"},           {"viewport", {640, 360}},
          {"random_depths", false},    {"choice", record("frustum 64px/exact-fast/packed", 100.0, 1.0)},
          {"runners_up", {runner_up}}, {"searched", Json::array()}};
}

std::string answer_conclusion(const Json& answer, const Json& objective) {
  return report::answer_conclusion(test::record_of<result::Answer>(answer),
                                   test::record_of<result::Objective>(objective));
}

TEST(Conclusion, of_a_recommendation_names_the_choice_and_the_next_one) {
  NEEDS(embree);
  const Json objective{{"figure", "frame_cost_us"}, {"meaning", ""}, {"timed", true}};
  EXPECT_EQ(
      answer_conclusion(answer_by_hand(1.25, {1.2, 1.3}), objective),
      "hall, 640x360: take frustum 64px/exact-fast/packed; frame_cost_us 100; frustum 32px/aabb/packed takes 25 % "
      "more (95 % interval of the times: 20 % to 30 %).");
  EXPECT_EQ(
      answer_conclusion(answer_by_hand(1.02, {0.98, 1.06}), objective),
      "hall, 640x360: take frustum 64px/exact-fast/packed; frame_cost_us 100. About the same cost (within 5 %, or not "
      "told apart by these times): frustum 32px/aabb/packed.");
  Json smallest = answer_by_hand(0.96, {0.9, 1.01});
  smallest["choice"]["figures"]["bytes"] = 1000;
  smallest["runners_up"][0]["figures"]["bytes"] = 2000;
  EXPECT_NE(answer_conclusion(smallest, objective)
                .find("; frustum 32px/aabb/packed takes 4 % less where both were measured side by side, within the "
                      "5 % to which the model tells costs apart, and needs 2 kB in place of 1 kB"),
            std::string::npos)
      << answer_conclusion(smallest, objective);
  // Further away, it is the interval that says so, or that there is none.
  smallest["runners_up"][0]["by_choice"] = 0.9;
  smallest["runners_up"][0]["ci95"] = {0.8, 1.01};
  EXPECT_NE(answer_conclusion(smallest, objective)
                .find("takes 10 % less where both were measured side by side, which these times do not tell from no "
                      "difference (95 % interval: 20 % less to 1 % more), and needs 2 kB"),
            std::string::npos)
      << answer_conclusion(smallest, objective);
  smallest["runners_up"][0]["ci95"] = {nullptr, nullptr};
  EXPECT_NE(answer_conclusion(smallest, objective)
                .find("takes 10 % less (frame_cost_us 96), which was not measured often enough to tell them apart"),
            std::string::npos)
      << answer_conclusion(smallest, objective);
  // Alike are costs within 5 % as measured side by side, though one interval is above 1 and the medians are 20 % apart.
  Json measured = answer_by_hand(1.2, {1.01, 1.06});
  measured["runners_up"][0]["by_choice"] = 1.04;
  EXPECT_NE(answer_conclusion(measured, objective).find("About the same cost"), std::string::npos)
      << answer_conclusion(measured, objective);
  Json random = answer_by_hand(1.25, {1.2, 1.3});
  random["random_depths"] = true;
  random["searched"] = {{{"name", "frustum 64px/bvh/own"}, {"objective", 80.0}, {"by_choice", 0.8}}};
  const std::string text = answer_conclusion(random, objective);
  EXPECT_NE(text.find("bvh/own, which samples search, would have frame_cost_us 80"), std::string::npos) << text;
  EXPECT_NE(text.find("samples.opaque.ground=lowest"), std::string::npos) << text;
  Json none = answer_by_hand(1.0, nullptr);
  none["choice"] = nullptr;
  EXPECT_NE(answer_conclusion(none, objective).find("take none"), std::string::npos);
}

TEST(Conclusion, of_a_recommendation_something_beside_nothing_is_not_alike) {
  const Json objective{{"figure", "overshade"}, {"meaning", ""}, {"timed", false}};
  Json answer = answer_by_hand(1.0, nullptr);
  answer["choice"]["objective"] = 0.0;
  answer["runners_up"][0]["by_choice"] = nullptr;
  EXPECT_EQ(answer_conclusion(answer, objective).find("The same by these figures"), std::string::npos);
  answer["runners_up"][0]["objective"] = 0.0;
  EXPECT_NE(answer_conclusion(answer, objective).find("The same by these figures"), std::string::npos);
}

TEST(Conclusion, what_draws_lights_is_not_taken_for_having_no_lists) {
  run::Result result = result_by_hand();
  result.cases[1].assigner = result.cases[1].assigner_label = "deferred";
  result.cases[1].buffers.bytes.high_water = 0;
  for (run::CaseResult& one : result.cases) one.timing.reset(), one.shading.reset();
  const Json beside = only_conclusion(result);
  EXPECT_EQ(beside["take"], "slow") << beside["text"];
  EXPECT_TRUE(beside["against"].is_null()) << beside["text"];
  result.cases.erase(result.cases.begin());
  result.planned_ids = {"fast"};
  const Json alone = only_conclusion(result);
  EXPECT_TRUE(alone["take"].is_null()) << alone["text"];
  EXPECT_TRUE(has_words(alone, "no surface was sampled to say what they cost")) << alone["text"];
}

}  // namespace
}  // namespace clusterbench::report
