// Precision as an axis: what each case sees, counts and says.

#include <gtest/gtest.h>

#include <cmath>

#include "run/cases/frame_lights.h"
#include "run/cases/path_frames.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

using testing::k_shafts;
using testing::Walk;

constexpr const char* k_all =
    R"(, "precision": ["float32", {"packing": ["half", "unorm16"], "inflate": [false, true]}])";

// Balls that reach over a slice's boundary by less than halves can tell at their depth.
Walk touching(const std::string& rest) {
  Walk walk(std::string(k_shafts) + rest);
  walk.add_light({0.0, 0.0, -42.02}, 10.02001);  // reaches to 32 - 1e-5; its depth's nearest half is 42.03125
  walk.add_light({0.0, 0.0, -19.4}, 3.3);
  return walk;
}

const CaseResult& case_of(const Result& result, const std::string& end) {
  for (const CaseResult& case_result : result.cases)
    if (case_result.id.ends_with(end)) return case_result;
  throw std::runtime_error("no case ends with " + end);
}

TEST(Precision, packed_lights_are_lost_and_inflated_ones_are_not) {
  const Result result = touching(std::string(R"(, "assigners": ["aabb"])") + k_all).run();
  ASSERT_EQ(result.cases.size(), 5u);
  EXPECT_EQ(case_of(result, "-float32").error->false_negatives, 0u);
  EXPECT_GT(case_of(result, "-half").error->false_negatives, 0u);
  EXPECT_EQ(case_of(result, "-half+inflate").error->false_negatives, 0u);
  EXPECT_EQ(case_of(result, "-unorm16+inflate").error->false_negatives, 0u);
  for (const CaseResult& case_result : result.cases)
    EXPECT_EQ(case_result.error->true_pairs, result.cases[0].error->true_pairs) << "the truth is the scene's";
}

TEST(Precision, only_packed_lights_that_are_not_inflated_take_a_conservative_assigners_word_back) {
  const Result result =
      touching(std::string(R"(, "assigners": ["aabb", {"name": "aabb", "inflation": 0.5}])") + k_all).run();
  for (const CaseResult& one : result.cases) {
    const bool is_plain = one.precision->packing == "float32" || one.precision->inflate;
    EXPECT_EQ(one.conservative, is_plain && one.assigner_label == "aabb") << one.id;
  }
}

TEST(Precision, each_case_tells_what_its_packing_loses) {
  const Result result = touching(std::string(R"(, "assigners": ["aabb"])") + k_all).run();
  const PrecisionResult &float32 = *case_of(result, "-float32").precision, &half = *case_of(result, "-half").precision,
                        &inflated = *case_of(result, "-half+inflate").precision,
                        &unorm = *case_of(result, "-unorm16").precision;
  EXPECT_LT(float32.loss.position_error_m.max, 4e-6);
  EXPECT_NEAR(half.loss.position_error_m.max, 42.03125 - 42.02, 1e-6) << "halves stand 1/32 apart there";
  EXPECT_EQ(inflated.loss.position_error_m.max, half.loss.position_error_m.max) << "what inflation is for";
  EXPECT_GE(half.loss.safe_inflation_m.max, half.loss.position_error_m.max);
  EXPECT_EQ(half.packing, "half");
  EXPECT_FALSE(half.inflate);
  EXPECT_TRUE(inflated.inflate);
  EXPECT_EQ(unorm.packing, "unorm16");
  EXPECT_LT(unorm.loss.position_error_m.max, 4e-6) << "two lights are the ends of their box";
}

TEST(Precision, is_not_told_where_there_is_float32_alone) {
  EXPECT_FALSE(touching(R"(, "assigners": ["aabb"])").run().cases.at(0).precision);
  EXPECT_TRUE(touching(R"(, "assigners": ["aabb"], "precision": ["half"])").run().cases.at(0).precision);
}

TEST(Precision, of_one_case_does_not_change_another) {
  const Result alone = touching(R"(, "assigners": ["bounds", "aabb"])").run();
  const Result among = touching(std::string(R"(, "assigners": ["bounds", "aabb"])") + k_all).run();
  for (const CaseResult& case_result : alone.cases) {
    const CaseResult& same = case_of(among, case_result.id + "-float32");
    EXPECT_EQ(same.error->reported_pairs, case_result.error->reported_pairs);
    EXPECT_EQ(same.tests_done, case_result.tests_done);
    EXPECT_EQ(same.assigner_label, case_result.assigner_label);
  }
}

Walk packed_crowd(const std::string& rest) {
  Walk walk(R"("grids": [{"tiles": {"pixels": [10, 10]}}], "assigners": ["aabb"])" + rest);
  for (int i = 0; i < 40; ++i)
    walk.add_light({8 * std::sin(i * 1.3), 6 * std::sin(i * 2.9), -15 + 14 * std::sin(i * 0.7)}, 1.0 + 0.05 * i);
  return walk;
}

TEST(Precision, is_seen_by_stability) {
  const Result result = packed_crowd(std::string(R"(, "stability": {"steps": 300})") + k_all).run();
  const auto churn = [&](const char* precision) { return case_of(result, precision).stability->method; };
  EXPECT_FALSE(churn("-half") == churn("-float32"));
  EXPECT_FALSE(churn("-half") == churn("-half+inflate"));
}

TEST(Precision, is_seen_by_what_is_timed_and_stored) {
  Walk walk = packed_crowd(k_all);
  walk.config.timing = {.measure = true, .rounds = 1, .min_time_ms = 0.0, .frames = 0, .sweep_mib = 4};
  const Result result = walk.run();
  for (const CaseResult& one : result.cases) {
    const double pairs = one.timing->frame_ns.median * one.timing->frames_timed / one.timing->ns_per_pair;
    EXPECT_NEAR(pairs, one.occupancy->pairs.mean * one.frames, 0.01) << one.id;
    EXPECT_EQ(static_cast<double>(one.buffers.index_entries.high_water), one.occupancy->pairs.max) << one.id;
  }
  EXPECT_FALSE(result.cases[0].timing->against_first);
  EXPECT_EQ(result.cases[1].timing->against_first->assigner, "aabb");
  EXPECT_NE(case_of(result, "-half").occupancy->pairs.mean, case_of(result, "-float32").occupancy->pairs.mean);
}

TEST(Precision, is_named_by_what_others_are_compared_with) {
  Walk walk = packed_crowd(R"(, "precision": [{"packing": "half", "inflate": true}, "unorm16"])");
  walk.config.timing = {.measure = true, .rounds = 1, .min_time_ms = 0.0, .frames = 1, .sweep_mib = 4};
  EXPECT_EQ(case_of(walk.run(), "-unorm16").timing->against_first->assigner, "aabb half+inflate");
}

TEST(Precision, lights_are_seen_as_their_request_says) {
  Walk walk = touching("");
  const view::Frame frame = PathFrames(walk.plan.scenes[0].scene, walk.plan.scenes[0].paths[0], {8, 8}).frame(0);
  const view::LightArrays lights = view::lights_in(frame, frame.view_space);
  const FrameLights frame_lights({{}, {view::Packing::half, false}, {view::Packing::half, true}}, lights);
  EXPECT_EQ(frame_lights.in_precision(0).z[0], lights.z[0]);
  EXPECT_EQ(frame_lights.in_precision(1).z[0], -42.03125f);
  EXPECT_EQ(frame_lights.in_precision(1).radius, frame_lights.packed(2).lights.radius);
  EXPECT_GT(frame_lights.in_precision(2).radius[0], frame_lights.in_precision(1).radius[0]);
}

}  // namespace
}  // namespace clusterbench::run
