// Pre-culls as an axis: what methods get, and what is told of them in the rig's indices.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "needs.h"
#include "places.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "run/timing/served_cases.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

using testing::Walk;

// Lights all around the walk, points and spots by turns; many behind the eye and far away.
Walk crowd(const std::string& rest) {
  Walk walk(R"("grids": [{"tiles": {"pixels": [10, 10]}, "slices": {"far": 30}}])" + rest);
  for (int i = 0; i < 400; ++i) {
    const Vec3d place(40 * std::sin(i * 1.3), 25 * std::sin(i * 2.9), 60 * std::sin(i * 0.7));
    scene::Light& light = walk.add_light(place, 1.0 + 0.01 * i);
    if (i % 3 == 0) light.type = scene::LightType::spot;
  }
  // The plan's cases know no pre-cull; here each has one.
  const std::vector<CasePlan> plain = walk.plan.groups[0].cases;
  walk.plan.groups[0].cases.clear();
  for (std::size_t i = 0; i < walk.config.pre_culls.size(); ++i)
    for (CasePlan one : plain) {
      one.pre_cull = i;
      one.id += "-" + walk.config.pre_culls[i].label();
      one.name = "walk/eye/grid/" + one.id;
      walk.plan.groups[0].cases.push_back(one);
    }
  return walk;
}

const CaseResult& of(const Result& result, const std::string& begin, const std::string& end) {
  for (const CaseResult& one : result.cases)
    if (one.id.starts_with(begin) && one.id.ends_with(end)) return one;
  throw std::runtime_error("no case " + begin + "..." + end);
}

constexpr const char* k_culls = R"(, "pre_cull": ["none", "frustum", {"distance_m": 100}, {"distance_m": 15},
    ["frustum", {"distance_m": 15}]])";

TEST(PreCulls, what_promises_to_lose_nothing_loses_nothing) {
  const Result result = crowd(std::string(R"(, "assigners": ["exact", "aabb", "exact-fast"])") + k_culls).run();
  ASSERT_EQ(result.cases.size(), 15u);
  for (const CaseResult& one : result.cases) {
    EXPECT_EQ(one.error->true_pairs, result.cases[0].error->true_pairs) << "the truth is that of all lights";
    const bool is_near = one.id.ends_with("distance(15)");
    EXPECT_EQ(one.conservative, !is_near) << one.id;
    EXPECT_EQ(one.error->false_negatives > 0, is_near) << one.id;
    EXPECT_TRUE(one.failures.empty()) << one.id << ": " << one.failures.front().text;
    EXPECT_EQ(one.pre_cull.has_value(), !one.id.ends_with("-none"));
  }
  const PreCullCounts &planes = of(result, "0-1", "-frustum").pre_cull->counts,
                      &both = of(result, "0-1", "-frustum+distance(15)").pre_cull->counts,
                      &distance = of(result, "0-1", "-distance(15)").pre_cull->counts;
  EXPECT_GT(planes.removed.mean, 100.0);
  EXPECT_EQ(planes.kept.mean + planes.removed.mean, 400.0);
  EXPECT_EQ(planes.distant.max, 0.0);
  EXPECT_EQ(planes.lost_pairs, 0u);
  EXPECT_EQ(distance.distant.mean, distance.removed.mean);
  EXPECT_GT(distance.lost_pairs, 0u);
  EXPECT_EQ(both.lost_pairs, of(result, "0-0", "-frustum+distance(15)").error->false_negatives)
      << "an exact method loses what is kept from it, and no more";
  EXPECT_EQ(both.steps[0].removed.mean, planes.removed.mean);
  EXPECT_EQ(both.steps[0].removed.mean + both.steps[1].removed.mean, both.removed.mean);
}

TEST(PreCulls, samples_tell_which_lights_they_need_are_removed) {
  const Result result = crowd(std::string(R"(, "assigners": ["exact"], "shading": {"samples": 2000})") + k_culls).run();
  const LostAtSamples &planes = of(result, "0", "-frustum").pre_cull->counts.samples.at(0),
                      &near = of(result, "0", "-distance(15)").pre_cull->counts.samples.at(0);
  EXPECT_EQ(planes.needed, of(result, "0", "-none").shading->needed);
  EXPECT_EQ(planes.lost, 0u);
  EXPECT_GT(near.lost, 0u);
  EXPECT_EQ(of(result, "0", "-frustum").shading->missed, of(result, "0", "-none").shading->missed);
  EXPECT_GE(of(result, "0", "-distance(15)").shading->missed, near.lost);
}

// Lists of a method behind a pre-cull are those of the same method for all lights, without the removed ones.
TEST(PreCulls, lists_are_those_of_all_lights_restricted_to_what_is_kept) {
  Walk walk =
      crowd(std::string(R"(, "assigners": ["aabb", "exact", "bounds", "exact-fast", "bvh", "conservative-raster"])") +
            k_culls);
  ServedCases served(walk.config, walk.plan);
  const GroupPlan& group = walk.plan.groups[0];
  const PathFrames path = path_of(walk.config, walk.plan, group);
  const PathCulls culls(walk.config, group, path);
  std::size_t compared = 0;
  for (const CasePlan& one : group.cases) {
    if (one.pre_cull == 0) continue;
    for (int index = 0; index < path.count(); ++index) {
      const view::Frame frame = path.frame(index);
      GridOfFrames grids(walk.config.grids[0]);
      grids.update(path, frame);
      cull::FrameCull culled;
      culls.of(one.method()).cull(frame, grids.grid(), view::lights_in(frame, frame.view_space), culled);
      FrameLists expected =
          served.frame_lists(std::to_string(one.grid) + "-" + std::to_string(one.assigner) + "-0-none", index);
      for (auto& list : expected.lights)
        std::erase_if(list, [&](std::uint32_t light) { return !std::ranges::binary_search(culled.kept, light); });
      EXPECT_EQ(served.frame_lists(one.id, index).lights, expected.lights) << one.id << " frame " << index;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 4u * 6u * 3u);
}

TEST(PreCulls, structures_of_a_methods_own_answer_in_the_rigs_indices) {
  Walk walk = crowd(std::string(R"(, "assigners": ["bvh", "z-binning"], "shading": {"samples": 2000})") + k_culls);
  for (CasePlan& one : walk.plan.groups[0].cases) one.storage.reset();
  const Result result = walk.run();
  EXPECT_GT(of(result, "0", "-none").shading->needed, 100u);
  for (const char* method : {"0-0", "0-1"}) {
    const std::uint64_t outside = of(result, method, "-none").shading->missed;  // beyond the grid's 30 m
    EXPECT_EQ(of(result, method, "-frustum").shading->missed, outside) << method;
    EXPECT_GT(of(result, method, "-distance(15)").shading->missed, outside) << method;
    EXPECT_LE(of(result, method, "-frustum").shading->evaluated, of(result, method, "-none").shading->evaluated);
  }
  EXPECT_EQ(of(result, "0", "-frustum").error->false_negatives, 0u);
  EXPECT_TRUE(of(result, "0", "-distance(15)").failures.empty());
}

TEST(PreCulls, buffers_have_room_for_the_lights_that_are_kept) {
  const Result result =
      crowd(std::string(R"(, "assigners": ["aabb"], "storages": ["packed", "bitfield", "fixed", "runs", "linked"])") +
            k_culls)
          .run();
  for (const std::string storage : {"0-0-0", "0-0-1", "0-0-2", "0-0-3", "0-0-4"}) {
    const CaseResult &all = of(result, storage, "-none"), &some = of(result, storage, "-frustum");
    const double most = some.pre_cull->counts.kept.max;
    ASSERT_LT(most, 256.0);
    EXPECT_EQ(some.buffers.dropped_pairs, 0u) << storage;
    EXPECT_LE(some.buffers.bytes.high_water, all.buffers.bytes.high_water) << storage;
    if (storage == "0-0-0") {
      EXPECT_EQ(all.buffers.index_bits, 16u);
      EXPECT_EQ(some.buffers.index_bits, 8u);
      EXPECT_EQ(some.buffers.index_entries.theoretical_max,
                all.buffers.index_entries.theoretical_max / 400 * static_cast<std::uint64_t>(most));
      EXPECT_LE(some.buffers.index_entries.high_water, all.buffers.index_entries.high_water);
    }
    if (storage == "0-0-1") {
      const std::uint64_t words = (static_cast<std::uint64_t>(most) + 31) / 32;
      EXPECT_EQ(some.buffers.index_entries.high_water, all.buffers.index_entries.high_water / 13 * words);
    }
  }
}

// What a storage gives back at samples goes through the spots' first index, which changes from frame to frame.
TEST(PreCulls, every_storage_gives_back_what_was_put_into_it) {
  const Result result =
      crowd(
          std::string(
              R"(, "assigners": ["exact"], "storages": ["packed", "bitfield", "runs", "linked"], "shading": {"samples": 3000})") +
          k_culls)
          .run();
  for (const char* cull : {"-none", "-frustum", "-distance(15)", "-frustum+distance(15)"})
    for (const char* storage : {"0-0-1", "0-0-2", "0-0-3"}) {
      EXPECT_EQ(of(result, storage, cull).shading->evaluated, of(result, "0-0-0", cull).shading->evaluated);
      EXPECT_EQ(of(result, storage, cull).shading->missed, of(result, "0-0-0", cull).shading->missed);
    }
}

TEST(PreCulls, details_name_the_rigs_lights) {
  const Result result = crowd(std::string(R"(, "assigners": ["exact"], "details": {"frames": [0]})") + k_culls).run();
  const DetailsFrame &all = of(result, "0", "-none").details->frames.at(0),
                     &some = of(result, "0", "-frustum").details->frames.at(0);
  EXPECT_EQ(some.lights, all.lights);
  EXPECT_EQ(some.light_names, all.light_names);
  EXPECT_EQ(some.pair_lights, all.pair_lights);
}

TEST(PreCulls, stability_is_that_of_the_rigs_lights) {
  const Result result =
      crowd(std::string(R"(, "assigners": ["exact"], "stability": {"steps": 60, "step_mm": 20})") + k_culls).run();
  EXPECT_TRUE(of(result, "0", "-frustum").stability->method == of(result, "0", "-none").stability->method);
  EXPECT_GT(of(result, "0", "-none").stability->method.changes, 0u);
}

TEST(PreCulls, a_frame_takes_its_pre_cull_too) {
  for (const bool cold : {false, true}) {
    Walk walk = crowd(std::string(R"(, "assigners": ["aabb"], "pre_cull": ["none", ["frustum", {"distance_m": 15}]])"));
    walk.config.timing = {.measure = true, .rounds = 3, .min_time_ms = 0.1, .frames = 2, .cold = cold, .sweep_mib = 4};
    const Result result = walk.run();
    EXPECT_FALSE(of(result, "0", "-none").timing->pre_cull_ns);
    const TimingResult& timing = *of(result, "0", ")").timing;
    ASSERT_TRUE(timing.pre_cull_ns);
    EXPECT_GT(timing.pre_cull_ns->median, 0.0);
    EXPECT_EQ(timing.warm.has_value(), cold);
    for (std::size_t i = 0; i < timing.frame_ns.samples.size(); ++i)
      EXPECT_NEAR(timing.frame_ns.samples[i],
                  timing.pre_cull_ns->samples[i] + timing.assign_ns.samples[i] + timing.convert_ns->samples[i],
                  1e-6 * timing.frame_ns.samples[i]);
    EXPECT_EQ(timing.against_first->assigner, "aabb");
    EXPECT_EQ(*timing.pairs_mean > 0.0, true);
  }
}

TEST(PreCulls, cases_without_one_keep_their_ids_and_names) {
  const std::string scene = test::source_dir() + "/scenes/hall-512.glb";
  const auto plan_of = [&](const std::string& rest) {
    return make_plan(config::parse_config(R"({"scenes": [{"path": ")" + scene + R"("}], "grids": [{"kind": "frustum"}],
        "assigners": ["aabb"])" + rest + "}",
                                          ""),
                     "");
  };
  const Plan plain = plan_of(""),
             culled = plan_of(R"(, "pre_cull": ["none", "frustum", ["frustum", {"distance_m": 20}]],
      "precision": ["float32", "half"])");
  ASSERT_EQ(plain.groups.at(0).cases.size(), 1u);
  const std::vector<CasePlan>& cases = culled.groups.at(0).cases;
  ASSERT_EQ(cases.size(), 6u);
  const CasePlan& own = plain.groups[0].cases[0];
  EXPECT_EQ(cases[0].id, own.id);
  EXPECT_EQ(cases[0].name, own.name);
  EXPECT_EQ(cases[2].name, own.name + "/frustum");
  EXPECT_EQ(cases[3].name, own.name + "/frustum/half");
  EXPECT_EQ(cases[4].name, own.name + "/frustum+distance(20)");
  EXPECT_NE(cases[2].id, own.id);
  EXPECT_NE(cases[2].id, cases[4].id);
  const Plan none = plan_of(R"(, "pre_cull": ["none"])");
  EXPECT_EQ(none.groups[0].cases[0].id, own.id);
}

TEST(PreCulls, visible_sets_need_triangles) {
  const std::string scene = test::source_dir() + "/scenes/hall-512.glb";
  const Plan plan =
      make_plan(config::parse_config(R"({"scenes": [{"path": ")" + scene + R"("}], "grids": [{"kind": "frustum"}],
        "assigners": ["aabb"], "pre_cull": ["none", {"visible_set": {}}]})",
                                     ""),
                "");
  EXPECT_EQ(plan.groups.at(0).cases.size(), 1u);
  ASSERT_EQ(plan.skipped.size(), 1u);
  EXPECT_TRUE(plan.skipped[0].name.ends_with("/visible-set(4,2,4096)")) << plan.skipped[0].name;
  EXPECT_EQ(plan.skipped[0].reason, "a visible set needs surfaces that hide, and the scene has no triangles");
}

TEST(PreCulls, visible_sets_are_counted_and_fail_nothing) {
  NEEDS(embree);
  const std::string scene = test::source_dir() + "/scenes/mix.glb";
  config::Config config = config::parse_config(
      R"({"scenes": [{"path": ")" + scene + R"(", "frames": 4}], "grids": [{"kind": "frustum"}], "viewport": [320, 180],
        "assigners": ["exact-fast"], "samples": {"opaque": {"divisor": 8}}, "timing": {"measure": false},
        "pre_cull": ["none", {"visible_set": {"rays": 2000}}, {"visible_set": {"rays": 3, "voxel_m": 0.25}}]})",
      "");
  std::vector<Result> results;
  for (const int threads : {1, 3}) {
    config.threads = threads;
    const Plan plan = make_plan(config, "");
    const std::atomic<bool> stop{false};
    results.push_back(run_plan(config, plan, {}, {}, stop));
  }
  const Result& result = results[0];
  ASSERT_EQ(result.cases.size(), 3u);
  EXPECT_TRUE(result.cases[0].conservative);
  for (std::size_t i = 1; i < 3; ++i) {
    const CaseResult& one = result.cases[i];
    EXPECT_FALSE(one.conservative);
    EXPECT_FALSE(one.pre_cull->counts.conservative);
    EXPECT_TRUE(one.failures.empty());
    EXPECT_EQ(one.error->false_negatives, one.pre_cull->counts.lost_pairs);
    EXPECT_GT(one.pre_cull->counts.bytes, 0u);
    EXPECT_GT(one.pre_cull->counts.view_cells, 0u);
    EXPECT_EQ(one.error->false_negatives, results[1].cases[i].error->false_negatives) << "whatever the threads";
    EXPECT_EQ(one.pre_cull->counts.removed.mean, results[1].cases[i].pre_cull->counts.removed.mean);
  }
  EXPECT_LE(result.cases[1].pre_cull->counts.lost_pairs, result.cases[2].pre_cull->counts.lost_pairs);
  EXPECT_GT(result.cases[2].pre_cull->counts.samples.at(1).lost, 0u) << "three rays see little";
}

std::string refusal(const std::string& pre_cull) {
  try {
    config::parse_config(R"({"scenes": ["a.glb"], "pre_cull": )" + pre_cull + "}", "c.json");
  } catch (const Error& error) {
    return error.where() + ": " + error.message();
  }
  return "taken";
}

TEST(PreCulls, what_is_no_pre_cull_is_refused_with_its_place) {
  EXPECT_EQ(refusal(R"(["none", "frustum", {"distance_m": 3}, ["frustum", {"visible_set": {"rays": 7}}]])"), "taken");
  for (const auto& [text, hint] : std::vector<std::pair<std::string, std::string>>{
           {R"(["frusta"])", "/pre_cull/0"},
           {R"([["frustum", "none"]])", "/pre_cull/0/1"},
           {R"([{"distance_m": 0}])", "/pre_cull/0/distance_m"},
           {R"([{"distance_m": 3, "visible_set": {}}])", "/pre_cull/0"},
           {R"([{}])", "/pre_cull/0"},
           {R"([{"visible_set": {"rays": 0}}])", "/pre_cull/0/visible_set/rays"},
           {R"([{"visible_set": {"voxels": 1}}])", "/pre_cull/0/visible_set"},
           {R"(["frustum", ["frustum"]])", "stands here twice"},
           {R"([])", "/pre_cull"}})
    EXPECT_NE(refusal(text).find(hint), std::string::npos) << text << ": " << refusal(text);
}

}  // namespace
}  // namespace clusterbench::run
