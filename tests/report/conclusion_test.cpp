// What a result says is to be done.

#include "report/conclusion.h"

#include <gtest/gtest.h>

#include "config/documents.h"
#include "config/schema_verdict.h"
#include "report/result_by_hand.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::result_by_hand;

const Json k_usual_model = {{"ns_per_light", 0.02},      {"ns_per_read", 0.005},   {"read_gb_per_s", 2283},
                            {"upload_gb_per_s", 15.75},  {"memory_gb_per_s", 448}, {"wave", "8x8"},
                            {"weights", {{"opaque", 1}}}};

Json valid_json(const run::Result& result) {
  Json json = result_to_json(result, {});
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
  EXPECT_TRUE(has_words(conclusion, "frustum 64px/brute-force/packed costs 2.71 times as much (95 %: 2.71 to 2.71)"))
      << conclusion["text"];
  EXPECT_EQ(conclusions_text(valid_json(result)), "conclusion: " + conclusion["text"].get<std::string>() + "\n");
}

TEST(Conclusion, short_lists_pay_for_the_time_to_make_them) {
  run::Result result = result_by_hand();
  result.config["cost"] = k_usual_model;
  result.cases[0].shading->evaluated = 220;  // of the slow one, where 200 are needed; 300 of the fast one
  const Json conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "slow");
  EXPECT_EQ(conclusion["against"], "fast");
  EXPECT_TRUE(has_words(conclusion, "9.50 us to make it on this machine")) << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "Fastest to make: frustum 64px/aabb/packed, 3.50 us")) << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "samples are at random depths")) << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "samples.opaque.ground=lowest")) << conclusion["text"];
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
  EXPECT_TRUE(has_words(conclusion, "No difference that these times can show to frustum 64px/aabb/packed"))
      << conclusion["text"];
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
  EXPECT_TRUE(has_words(conclusion, "costs within 5 % are alike")) << conclusion["text"];
  EXPECT_FALSE(has_words(conclusion, "lack")) << conclusion["text"];
  first.evaluated = 200000;
  conclusion = only_conclusion(result);
  EXPECT_EQ(conclusion["take"], "fast") << conclusion["text"];
  EXPECT_TRUE(has_words(conclusion, "Its samples lack 0.02 % of the lights that they need")) << conclusion["text"];
}

TEST(Conclusion, takes_only_what_has_a_star) {
  run::Result result = result_by_hand();
  const Json json = valid_json(result);
  const Json ids = json["pareto_front"][0]["ids"];
  EXPECT_NE(std::find(ids.begin(), ids.end(), json["conclusions"][0]["take"]), ids.end());
}

TEST(Conclusion, of_cases_that_all_lose_lights_none_is_taken) {
  run::Result result = result_by_hand();
  for (run::CaseResult& one : result.cases) testing::lose_a_light(one);
  const Json conclusion = only_conclusion(testing::judged(result));
  EXPECT_TRUE(conclusion["take"].is_null());
  EXPECT_TRUE(has_words(conclusion, "take none of 2 cases: each fails or loses lights.")) << conclusion["text"];
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
  expect_none(result, "the scene has no lights");
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

TEST(Conclusion, of_a_recommendation_names_the_choice_and_the_next_one) {
  const Json objective{{"figure", "frame_cost_us"}, {"meaning", ""}, {"timed", true}};
  EXPECT_EQ(answer_conclusion(answer_by_hand(1.25, {1.2, 1.3}), objective),
            "hall, 640x360: take frustum 64px/exact-fast/packed; frame_cost_us 100; frustum 32px/aabb/packed has 25 % "
            "more (95 %: 20 % to 30 %).");
  EXPECT_EQ(answer_conclusion(answer_by_hand(1.02, {0.98, 1.06}), objective),
            "hall, 640x360: take frustum 64px/exact-fast/packed; frame_cost_us 100. No difference that these times can "
            "show to frustum 32px/aabb/packed.");
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

}  // namespace
}  // namespace clusterbench::report
