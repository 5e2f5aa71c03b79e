// Costs of a result's cases, and what is ranked by them.

#include "report/cases/case_costs.h"
#include "result/figures/case_figure.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "records.h"
#include "report/comparing/ratios.h"
#include "report/exports/metrics.h"
#include "report/gates/limits.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"
#include "report/tables/table.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::result_by_hand;

// Visible surfaces of 1920 x 1080 pixels by a ray for 8 x 8 of them, in two frames.
void add_surfaces(run::CaseResult& one, std::uint64_t lights_per_sample) {
  run::SampleSetResult opaque{measure::SampleSet::opaque, {}, {}};
  opaque.counts.samples = 2 * 240 * 135;
  opaque.counts.evaluated = lights_per_sample * opaque.counts.samples;
  opaque.counts.needed = 1000;
  one.samples = {opaque};
  one.buffers.upload_bytes_mean = 1575.0;
}

run::Result costly(const std::string& rank_by = "frame_time") {
  run::Result result = result_by_hand();
  result.config["rank_by"] = rank_by;
  result.config["samples"] = {{"opaque", {{"divisor", 8}}}};
  result.config["cost"] = {{"ns_per_light", 0.02},
                           {"upload_gb_per_s", 15.75},
                           {"memory_gb_per_s", 448},
                           {"wave", "8x8"},
                           {"weights", {{"volume", 0}, {"opaque", 1}, {"fog", 1}}}};
  add_surfaces(result.cases[0], 3);  // slow to assign
  add_surfaces(result.cases[1], 4);
  return result;
}

Json of(const run::Result& result) {
  return result::to_json(record_of(result, {}));
}

TEST(FrameCosts, a_ray_stands_for_its_block_of_pixels_and_sets_without_a_weight_for_nothing) {
  const Json result = of(costly());
  const Json& cost = result["cases"][1]["cost"];
  EXPECT_EQ(cost["sets"].size(), 1u);
  EXPECT_EQ(cost["sets"]["opaque"]["samples"], 1920 * 1080);
  EXPECT_EQ(cost["sets"]["opaque"]["lights"], 4);
  EXPECT_NEAR(cost["sets"]["opaque"]["ns"].get<double>(), 1920.0 * 1080.0 * 4 * 0.02, 1e-3);
  EXPECT_EQ(cost["upload_ns"], 100);
  EXPECT_NEAR(cost["frame_ns"].get<double>(), 3500.0 + 100.0 + 1920.0 * 1080.0 * 4 * 0.02, 1e-3);
  EXPECT_EQ(cost["lit"], true);
}

TEST(FrameCosts, a_result_with_costs_is_what_the_schema_says) {
  const Json result = of(costly("frame_cost"));
  EXPECT_EQ(config::schema_violations(config::result_schema(), nlohmann::json::parse(result.dump())),
            std::vector<std::string>{});
}

TEST(FrameCosts, divergence_of_the_waves_that_are_named_is_multiplied_with_and_drawn_lights_have_none) {
  run::Result result = costly();
  for (run::CaseResult& one : result.cases) {
    one.samples[0].coherence.emplace();
    one.samples[0].coherence->sizes[0] = {8, 4, 1, 1, 1, 5, 5, 4.0};
    one.samples[0].coherence->sizes[1] = {8, 8, 1, 1, 1, 6, 6, 4.0};
  }
  result.cases[0].assigner = "deferred";
  const auto divergence = [&](int at) {
    return of(result)["cases"][static_cast<std::size_t>(at)]["cost"]["sets"]["opaque"]["divergence"].get<double>();
  };
  EXPECT_EQ(divergence(1), 1.5);
  EXPECT_EQ(divergence(0), 1.0);
  result.config["cost"]["wave"] = "8x4";
  EXPECT_EQ(divergence(1), 1.25);
}

TEST(FrameCosts, what_drawn_lights_read_and_write_is_paid_at_the_memorys_bandwidth) {
  run::Result result = costly();
  const double before = of(result)["cases"][0]["cost"]["gpu_ns"];
  result.cases[0].buffers.traffic_bytes_mean = 448000.0;
  result.cases[0].buffers.traffic_bytes_max = 448000;
  EXPECT_NEAR(of(result)["cases"][0]["cost"]["gpu_ns"].get<double>() - before, 1000.0, 1e-3);
}

// A hierarchy that each sample walks takes next to no time to build and few bytes, and gives few lights.
TEST(FrameCosts, reading_is_charged_and_what_samples_search_is_on_no_front) {
  run::Result result = costly("frame_cost");
  result.config["cost"]["ns_per_read"] = 0.005;
  result.config["cost"]["read_gb_per_s"] = 2283.0;
  for (run::CaseResult& one : result.cases) {
    measure::ShadingCounts& opaque = one.samples[0].counts;
    opaque.reads = assign::Reads::of(5 * opaque.samples, 2);
  }
  run::CaseResult walked = result.cases[0];
  walked.id = "walked";
  walked.assigner = walked.assigner_label = "bvh";
  walked.storage_label = "own";
  walked.buffers.bytes.high_water = 1;
  walked.timing->frame_ns = {1.0, 0.0, 1.0, 1.0, {1.0, 1.0}, std::vector<double>(6, 1.0)};
  measure::ShadingCounts& opaque = walked.samples[0].counts;
  opaque.reads = assign::Reads::of(54 * opaque.samples, 32);
  result.cases.push_back(walked);
  result.planned_ids.emplace_back("walked");
  const Json json = of(result);
  const Json& lists = json["cases"][0]["cost"];
  const Json& walk = json["cases"][2]["cost"];
  EXPECT_EQ(walk["sets"]["opaque"]["reads"], 54);
  EXPECT_EQ(walk["sets"]["opaque"]["read_bytes"], 1728);
  EXPECT_NEAR(walk["read_ns"].get<double>(), 1920.0 * 1080.0 * (54 * 0.005 + 1728.0 / 2283.0), 1e-1);
  EXPECT_NEAR(walk["gpu_ns"].get<double>(), walk["read_ns"].get<double>() + lists["shade_ns"].get<double>() + 100.0,
              1e-1);
  EXPECT_GT(walk["gpu_ns"].get<double>(), 5.0 * lists["gpu_ns"].get<double>());
  EXPECT_EQ(json["cases"][2]["samples_search"], true);
  EXPECT_FALSE(json["cases"][0].contains("samples_search"));
  for (const char* by : {"frame_cost", "frame_time"}) {
    result.config["rank_by"] = by;
    const Json ranked = of(result);
    EXPECT_EQ(ranked["pareto_front"][0]["ids"].dump().find("walked"), std::string::npos) << by;
    const std::string table = render_table(test::result_of(ranked), false);
    EXPECT_NE(table.find(" structures that samples search, camera walk, 1920x1080"), std::string::npos) << table;
    EXPECT_GT(table.find("bvh / no lists"), table.find(" structures that samples search,")) << table;
  }
  EXPECT_EQ(config::schema_violations(config::result_schema(), nlohmann::json::parse(json.dump())),
            std::vector<std::string>{});
}

TEST(FrameCosts, say_the_overshade_of_the_samples_that_they_rest_on) {
  const Json result = of(costly());
  EXPECT_EQ(result["cases"][1]["cost"]["lights"], 4);
  EXPECT_NEAR(result["cases"][1]["cost"]["overshade"].get<double>(), 4.0 * 2 * 240 * 135 / 1000, 1e-3);
}

TEST(FrameCosts, samples_that_need_few_lights_say_no_overshade_anywhere) {
  for (const std::uint64_t needed : {99u, 100u}) {
    run::Result result = costly();
    for (run::CaseResult& one : result.cases) one.samples[0].counts.needed = needed;
    const Json json = of(result);
    EXPECT_EQ(result::figure_of(test::case_of(json["cases"][1]), "overshade").has_value(), needed >= 100u);
    EXPECT_EQ(result::figure_of(test::case_of(json["cases"][1]), "opaque.overshade").has_value(), needed >= 100u);
    EXPECT_EQ(json["cases"][1]["cost"]["overshade"].is_null(), needed < 100u);
  }
}

TEST(FrameCosts, lists_of_a_gpu_are_not_uploaded_and_have_no_time_of_this_machine) {
  run::Result result = costly("frame_cost");
  result.cases[0].preset = "three-js";
  result.cases[1].preset = "filament";
  const Json json = of(result);
  const Json &gpu = json["cases"][0]["cost"], &cpu = json["cases"][1]["cost"];
  EXPECT_EQ(gpu["upload_ns"], 0.0);
  EXPECT_TRUE(gpu["frame_ns"].is_null());
  EXPECT_EQ(cpu["upload_ns"], 100);
  EXPECT_TRUE(cpu["frame_ns"].is_number());
  EXPECT_EQ(json["pareto_front"][0]["ids"], Json::array({"fast"})) << "beside a time, none that is not known";
}

TEST(FrameCosts, a_weight_of_pixels_has_points_of_the_view_stand_for_the_picture) {
  run::Result result = costly();
  result.config["cost"]["weights"] = {{"volume", "pixels"}, {"opaque", 0}};
  const Json json = of(result);
  EXPECT_EQ(json["cases"][0]["cost"]["sets"]["volume"]["samples"], 1920 * 1080);
}

TEST(FrameCosts, rank_rows_and_decide_the_front_where_the_configuration_says_so) {
  const auto ids = [](const Json& result) { return result["pareto_front"][0]["ids"]; };
  const Json by_time = of(costly()), by_cost = of(costly("frame_cost"));
  EXPECT_EQ(ids(by_time), Json({"slow", "fast"})) << "by time, bytes and overshade, which slow has less of";
  EXPECT_EQ(ids(by_cost), Json({"slow"})) << "three lights instead of four";
  const auto is_first = [](const Json& result, const char* method) {
    const std::string table = render_table(test::result_of(result), false);
    return table.find(method) < table.find(method == std::string("aabb ") ? "brute-force " : "aabb ");
  };
  EXPECT_TRUE(is_first(by_time, "aabb "));
  EXPECT_TRUE(is_first(by_cost, "brute-force "));
  EXPECT_NE(render_table(test::result_of(by_cost), false).find("cost us"), std::string::npos);
  EXPECT_EQ(render_table(record_of(result_by_hand(), {}), false).find("cost us"), std::string::npos);
  const result::Result result = test::result_of(by_cost);
  EXPECT_TRUE(takes_longer(result, result.cases[1], result.cases[0], RankBy::frame_cost));
  EXPECT_TRUE(takes_longer(result, result.cases[0], result.cases[1]));
}

TEST(FrameCosts, without_times_rank_by_what_the_gpu_does) {
  run::Result result = costly("frame_cost");
  for (run::CaseResult& one : result.cases) one.timing.reset();
  const Json json = of(result);
  EXPECT_TRUE(json["cases"][0]["cost"]["frame_ns"].is_null());
  EXPECT_EQ(json["pareto_front"][0]["ids"], Json({"slow"}));
  const std::string table = render_table(test::result_of(json), false);
  EXPECT_LT(table.find("brute-force "), table.find("aabb "));
}

// Lists that are not there are not the smallest ones.
TEST(FrameCosts, what_is_drawn_has_no_bytes_to_be_best_in) {
  for (const char* by : {"frame_time", "frame_cost"}) {
    run::Result result = costly(by);
    run::CaseResult& drawn = result.cases[0];  // takes longer
    drawn.assigner = "deferred";
    drawn.samples[0].counts.evaluated = 5 * drawn.samples[0].counts.samples;
    drawn.shading.reset();
    drawn.buffers.bytes.high_water = 0;
    EXPECT_EQ(of(result)["pareto_front"][0]["ids"], Json({"fast"})) << by;
  }
}

// A history of it would show the changes of times as if counts had changed.
TEST(FrameCosts, follow_from_times_and_counts_and_have_no_history_of_their_own) {
  const auto basis = [](const std::string& name) { return result::find_figure(name)->basis; };
  EXPECT_EQ(basis("frame_cost_us"), result::Basis::derived);
  EXPECT_EQ(basis("gpu_cost_us"), result::Basis::count);
}

TEST(FrameCosts, a_case_that_lacks_lights_at_samples_with_a_weight_is_on_no_front) {
  run::Result result = costly("frame_cost");
  result.cases[0].samples[0].counts.missed = 2;  // of 1000
  const Json json = of(result);
  EXPECT_EQ(json["cases"][0]["cost"]["lit"], false);
  EXPECT_EQ(json["pareto_front"][0]["ids"], Json({"fast"}));
  const std::string table = render_table(test::result_of(json), false);
  EXPECT_LT(table.find("aabb "), table.find("brute-force ")) << "which would be cheaper";
  EXPECT_NE(table.find("lacks up to 0.2 % of the lights that opaque samples need"), std::string::npos) << table;
}

// Surfaces that lack lights are a loss of the case's whatever it costs; of fog the cost alone tells.
TEST(FrameCosts, a_case_that_leaves_fog_unlit_that_costs_something_is_on_no_front) {
  run::Result result = costly("frame_cost");
  result.config["cost"]["weights"]["fog"] = 1;
  for (run::CaseResult& one : result.cases) {
    run::SampleSetResult fog = one.samples[0];
    fog.set = measure::SampleSet::fog;
    fog.counts.missed = &one == result.cases.data() ? 2 : 0;  // of 1000
    one.samples.push_back(fog);
  }
  const Json json = of(result);
  EXPECT_EQ(json["cases"][0]["cost"]["lit"], false);
  EXPECT_EQ(json["pareto_front"][0]["ids"], Json({"fast"}));
}

TEST(FrameCosts, table_and_budgets_have_overshade_and_unlit_of_the_samples_that_rank_and_say_which) {
  run::Result result = costly();
  for (run::CaseResult& one : result.cases) one.samples[0].counts.missed = 1;
  result.cases[0].shading->missed = 1;  // of 200 at points in the view
  const Json json = of(result);
  const std::string table = render_table(test::result_of(json), false);
  EXPECT_NE(table.find("unlit (opaque)  overshade (opaque)"), std::string::npos) << table;
  EXPECT_NE(table.find("opaque: visible surfaces.\n"), std::string::npos) << table;
  EXPECT_EQ(table.find("0.50 %"), std::string::npos) << "of another set, unnamed\n" << table;
  EXPECT_NE(table.find("0.10 %              259.20"), std::string::npos) << table;
  const result::Case one = test::case_of(json["cases"][1]);
  EXPECT_NEAR(*result::figure_of(one, "overshade"), 259.2, 1e-9);
  EXPECT_NEAR(*result::figure_of(one, "opaque.overshade"), 259.2, 1e-9);
  EXPECT_EQ(result::figure_of(one, "volume.overshade"), 1.5);
  EXPECT_EQ(result::figure_of(one, "unlit"), 0.001);
  EXPECT_EQ(result::figure_of(one, "volume.unlit"), 0.0);
  EXPECT_EQ(result::figure_of(test::case_of(json["cases"][0]), "volume.unlit"), 0.005);
  EXPECT_EQ(result::figure_of(one, "fog.unlit"), std::nullopt);
}

TEST(FrameCosts, of_several_sets_overshade_is_weighted_and_unlit_that_of_the_one_that_lacks_most) {
  run::Result result = costly();
  for (run::CaseResult& one : result.cases) {
    measure::ShadingCounts fog{.samples = 100, .evaluated = 300, .needed = 2000, .missed = 2};
    one.samples.push_back({measure::SampleSet::fog, fog, {}});
  }
  const Json json = of(result);
  const std::string table = render_table(test::result_of(json), false);
  EXPECT_NE(table.find("unlit (weighted)  overshade (weighted)"), std::string::npos) << table;
  EXPECT_NE(table.find("weighted: fog froxels, visible surfaces, by the weights of the key `cost`; unlit: of the set "
                       "that lacks most.\n"),
            std::string::npos)
      << table;
  const result::Case one = test::case_of(json["cases"][0]);
  EXPECT_EQ(result::figure_of(one, "unlit"), 0.001);
  EXPECT_EQ(result::figure_value(one, "unlit")->location, "fog froxels");
  EXPECT_EQ(result::figure_of(one, "overshade"), one.cost->overshade);
}

// That of the other set alone would be no overshade of both.
TEST(FrameCosts, of_several_sets_there_is_no_overshade_where_one_lacks_lights) {
  run::Result result = costly();
  for (run::CaseResult& one : result.cases) {
    measure::ShadingCounts fog{.samples = 100, .evaluated = 300, .needed = 2000, .missed = 900};
    one.samples.push_back({measure::SampleSet::fog, fog, {}});
  }
  const result::Case one = test::case_of(of(result)["cases"][0]);
  EXPECT_FALSE(one.cost->lit);
  EXPECT_EQ(result::figure_of(one, "overshade"), std::nullopt);
  EXPECT_TRUE(result::figure_of(one, "opaque.overshade"));
}

TEST(FrameCosts, without_sets_of_samples_the_legend_says_that_they_are_random_points_in_the_view) {
  const std::string table = render_table(record_of(result_by_hand(), {}), false);
  EXPECT_NE(table.find("unlit  overshade  bytes"), std::string::npos) << table;
  EXPECT_NE(table.find("samples: random points in the view.\n"), std::string::npos) << table;
}

}  // namespace
}  // namespace clusterbench::report
