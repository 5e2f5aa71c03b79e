// Sets of samples from a scene's file to a case's result.

#include "run/cases/frame_samples.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>

#include "core/error.h"
#include "effort.h"
#include "needs.h"
#include "places.h"
#include "run/cases/case_names.h"
#include "run/findings/gate.h"
#include "run/passes/accuracy_pass.h"
#include "run/runner.h"
#include "run/timing/served_cases.h"
#include "run/timing/timed_work.h"
#include "scene/mesh_fixture.h"

namespace clusterbench::run {
namespace {

using Json = nlohmann::json;
using scene::test::MeshFile;

std::size_t wall(MeshFile& file, const Json& material) {
  Json primitive = {{"attributes", {{"POSITION", file.positions({{-9, -9, 0}, {9, -9, 0}, {-9, 9, 0}, {9, 9, 0}})}}},
                    {"mode", 5}};
  primitive["material"] = file.material(material);
  return file.mesh(primitive);
}

// A wall 8 m before the eye and a pane of glass at 4 m, which both fill the picture; a light beside the wall, and one
// behind the eye.
std::string room(bool with_meshes = true) {
  MeshFile file;
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"range", 5}}};
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}, {"zfar", 100}}}}};
  file.node({{"camera", 0}});
  for (const Json& at : {Json{0, 0, -7}, Json{0, 0, 6}})
    file.node({{"translation", at}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  if (with_meshes) {
    file.node({{"translation", {0, 0, -8}}, {"mesh", wall(file, {{"name", "stone"}})}});
    file.node({{"translation", {0, 0, -4}}, {"mesh", wall(file, {{"alphaMode", "BLEND"}})}});
  }
  return file.text();
}

struct RoomRun {
  Plan plan;
  Result result;
};

RoomRun run_of(const std::string& scene, const std::string& rest,
               const std::string& assigners = R"("exact-fast", "bvh")", const std::string& slices = R"("far": 40)") {
  const scene::test::Folder folder;
  folder.write("room.gltf", scene);
  const config::Config config = config::parse_config(
      R"({"scenes": ["room.gltf"], "viewport": [64, 48], "timing": {"measure": false}, "grids": [{"tiles": {"count": [4, 4]},
          "slices": {"count": 8, "near": 0.1, )" +
          slices + R"(}}], "shading": {"samples": 0}, "assigners": [)" + assigners + "]" + rest + "}",
      folder.path() / "c.json");
  RoomRun out;
  out.plan = make_plan(config, "");
  const std::atomic<bool> stop = false;
  out.result = run_plan(config, out.plan, {}, {}, stop);
  return out;
}

const CaseResult& case_named(const RoomRun& run, const std::string& part) {
  for (const CaseResult& case_result : run.result.cases)
    if (case_result.name.find(part) != std::string::npos) return case_result;
  throw Error("", part, "no such case");
}

const measure::ShadingCounts& counts_of(const CaseResult& case_result, measure::SampleSet set) {
  for (const SampleSetResult& result : case_result.samples)
    if (result.set == set) return result.counts;
  throw Error("", measure::name_of(set), "no such set");
}

constexpr const char* k_all_sets =
    R"(, "samples": {"opaque": {"divisor": 1}, "transparent": {"divisor": 2}, "fog": {"froxels": [8, 6, 4]},
    "mirror": {"count": 500}, "anywhere": {"count": 300}})";

TEST(FrameSamples, every_set_is_asked_for_in_every_case_and_exact_lists_lose_nothing_in_view) {
  NEEDS(embree);
  using measure::SampleSet;
  const RoomRun run = run_of(room(), k_all_sets);
  const CaseResult& exact = case_named(run, "exact-fast/packed");
  EXPECT_EQ(counts_of(exact, SampleSet::opaque).samples, 64u * 48u);
  EXPECT_EQ(counts_of(exact, SampleSet::transparent).samples, 32u * 24u);
  EXPECT_EQ(counts_of(exact, SampleSet::fog).samples, 8u * 6u * 4u);
  EXPECT_EQ(counts_of(exact, SampleSet::anywhere).samples, 300u);
  for (const SampleSet set : {SampleSet::opaque, SampleSet::transparent, SampleSet::fog}) {
    const measure::ShadingCounts& counts = counts_of(exact, set);
    EXPECT_GT(counts.needed, 0u) << measure::name_of(set);
    EXPECT_EQ(counts.missed, 0u) << measure::name_of(set);
    EXPECT_EQ(counts.unanswered, 0u) << measure::name_of(set);
  }
  for (const SampleSetResult& set : exact.samples) EXPECT_EQ(set.coherence.has_value(), set.set == SampleSet::opaque);
  EXPECT_EQ(exact.samples[0].coherence->sizes[1].waves, 8u * 6u);
  // A circle of sqrt(24) m around the middle of a wall of which the picture shows 11.65 m by 8.74 m.
  const double share = static_cast<double>(counts_of(exact, SampleSet::opaque).needed) / (64 * 48);
  EXPECT_NEAR(share, 0.715, 0.02);
}

TEST(FrameSamples, packed_lists_are_read_by_a_header_for_each_answer_and_an_index_for_each_light) {
  const RoomRun run = run_of(room(), k_all_sets);
  for (const SampleSetResult& set : case_named(run, "exact-fast/packed").samples) {
    const std::uint64_t answered = set.counts.samples - set.counts.unanswered;
    EXPECT_EQ(set.counts.reads, assign::Reads::of(answered, 8) + assign::Reads::of(set.counts.evaluated, 1))
        << measure::name_of(set.set);
  }
}

TEST(FrameSamples, only_what_is_not_bound_to_the_picture_answers_outside_of_it) {
  const RoomRun run = run_of(room(), k_all_sets);
  const measure::ShadingCounts& lists = counts_of(case_named(run, "exact-fast/packed"), measure::SampleSet::mirror);
  EXPECT_EQ(lists.unanswered, lists.samples);
  EXPECT_EQ(lists.missed, lists.needed);
  EXPECT_EQ(lists.missed_outside, lists.missed);
  EXPECT_GT(lists.lost_lux, 0.0);
  const measure::ShadingCounts& tree = counts_of(case_named(run, "bvh/no lists"), measure::SampleSet::mirror);
  EXPECT_EQ(tree.unanswered, 0u);
  EXPECT_EQ(tree.missed, 0u);
  EXPECT_GT(tree.needed, 0u);
}

TEST(FrameSamples, triangles_are_read_only_where_a_set_asks_for_them) {
  EXPECT_FALSE(run_of(room(), "").plan.scenes[0].geometry);
  EXPECT_FALSE(run_of(room(), R"(, "samples": {"fog": {"froxels": [2, 2, 2]}})").plan.scenes[0].geometry);
  const RoomRun run = run_of(room(), R"(, "samples": {"opaque": {}})");
  ASSERT_TRUE(run.plan.scenes[0].geometry);
  EXPECT_EQ(run.plan.scenes[0].geometry->triangle_count(), 4u);
}

// Lights at y 0, an eye at y 0: the floor is below the eye. Cells that no triangle decides have the lists they had.
TEST(FrameSamples, a_ground_stands_for_the_surfaces_of_a_scene_without_triangles_and_is_declared) {
  NEEDS(embree);
  for (const auto& [ground, height] : {std::pair(R"("lowest")", -1.7), std::pair("-2", -2.0)}) {
    const RoomRun run =
        run_of(room(false), std::string(R"(, "samples": {"opaque": {"divisor": 1, "ground": )") + ground + "}}");
    const CaseResult& exact = case_named(run, "exact-fast/packed");
    ASSERT_EQ(exact.samples.size(), 1u);
    EXPECT_EQ(exact.samples[0].ground_m, height);
    const measure::ShadingCounts& counts = exact.samples[0].counts;
    // The picture's lower half, but for what is farther than the far plane, at 100 m: a slope of less than 0.02.
    EXPECT_EQ(counts.samples, 64u * 23u);
    EXPECT_GT(counts.needed, 0u);
    EXPECT_EQ(counts.missed, 0u);
    EXPECT_TRUE(exact.samples[0].coherence.has_value());
    const std::vector<std::string>& told = run.plan.scenes[0].scene.warnings;
    EXPECT_TRUE(std::ranges::any_of(told, [](const std::string& text) {
      return text.find("its opaque samples lie on a floor at y = -") != std::string::npos;
    }));
  }
  const RoomRun with_walls = run_of(room(), R"(, "samples": {"opaque": {"divisor": 1, "ground": "lowest"}})");
  const CaseResult& walls = case_named(with_walls, "exact-fast/packed");
  EXPECT_FALSE(walls.samples[0].ground_m) << "a scene with triangles has surfaces of its own";
  EXPECT_EQ(walls.samples[0].counts.samples, 64u * 48u);
}

TEST(FrameSamples, a_scene_without_triangles_skips_the_sets_of_surfaces_with_the_reason) {
  const RoomRun run = run_of(room(false), R"(, "samples": {"opaque": {}, "fog": {"froxels": [2, 2, 2]}})");
  ASSERT_FALSE(run.plan.skipped.empty());
  EXPECT_EQ(run.plan.skipped[0].name, "room/samples opaque");
  EXPECT_EQ(run.plan.skipped[0].reason, "the scene has no triangles");
  EXPECT_EQ(run.result.cases.at(0).samples.size(), 1u);
}

TEST(FrameSamples, a_set_without_a_sample_says_so_and_lights_without_end_bound_none) {
  NEEDS(embree);
  Json endless = Json::parse(room());
  endless["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = 1e18;
  for (Json& material : endless["materials"]) material["alphaMode"] = "OPAQUE";
  const RoomRun run = run_of(endless.dump(), R"(, "samples": {"transparent": {}, "anywhere": {}})");
  ASSERT_EQ(run.plan.skipped.size(), 1u);
  EXPECT_EQ(run.plan.skipped[0].name, "room/samples anywhere");
  EXPECT_EQ(run.plan.skipped[0].reason, "no light of the scene has an end");
  const CaseResult& case_result = case_named(run, "exact-fast/packed");
  ASSERT_EQ(case_result.samples.size(), 1u);
  EXPECT_EQ(case_result.samples[0].counts.samples, 0u);
}

TEST(FrameSamples, cases_with_other_samples_are_other_cases_and_threads_change_nothing) {
  NEEDS(embree);
  const RoomRun one = run_of(room(), R"(, "samples": {"opaque": {}})");
  const RoomRun finer = run_of(room(), R"(, "samples": {"opaque": {"divisor": 4}})");
  EXPECT_NE(one.plan.groups[0].cases[0].id, finer.plan.groups[0].cases[0].id);
  const RoomRun threads = run_of(room(), R"(, "threads": 3, "samples": {"opaque": {}})");
  EXPECT_EQ(one.plan.groups[0].cases[0].id, threads.plan.groups[0].cases[0].id);
  EXPECT_EQ(one.result.cases[0].samples[0].counts.evaluated, threads.result.cases[0].samples[0].counts.evaluated);
}

TEST(FrameSamples, a_moved_mesh_is_another_case_with_the_same_settings) {
  const auto with_wall_at = [](double z) {
    Json scene = Json::parse(room());
    scene["nodes"][3]["translation"][2] = z;
    return run_of(scene.dump(), R"(, "samples": {"opaque": {}})").plan.groups[0].cases[0];
  };
  const auto with_width = [](float width) {
    MeshFile file;
    const Json primitive = {{"attributes", {{"POSITION", file.positions({{0, 0, 0}, {width, 0, 0}, {0, 1, 0}})}}}};
    file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}, {"zfar", 100}}}}};
    file.node({{"camera", 0}});
    file.node({{"mesh", file.mesh(primitive)}, {"translation", {0, 0, -3}}});
    return run_of(file.text(), R"(, "samples": {"opaque": {}})").plan.groups[0].cases[0];
  };
  EXPECT_NE(with_wall_at(-8).id, with_wall_at(-9).id);
  EXPECT_EQ(with_wall_at(-8).settings, with_wall_at(-9).settings);
  EXPECT_NE(with_width(1).id, with_width(2).id);
  EXPECT_EQ(with_width(1).settings, with_width(2).settings);
}

TEST(FrameSamples, a_structure_without_cells_that_loses_a_light_on_a_surface_fails) {
  NEEDS(embree);
  RoomRun run = run_of(room(), R"(, "samples": {"opaque": {}})");
  CaseResult tree = case_named(run, "bvh/no lists");
  EXPECT_TRUE(failures_of(tree, {}).empty());
  tree.samples.at(0).counts.missed = 3;
  ASSERT_EQ(failures_of(tree, {}).size(), 1u);
  EXPECT_NE(failures_of(tree, {})[0].text.find("that its opaque samples need"), std::string::npos);
  tree.samples[0].counts.missed_outside = 3;
  EXPECT_TRUE(failures_of(tree, {}).empty());
}

// Two lights of equal brightness at one point, of which a storage with room for one drops the second.
TEST(FrameSamples, dropped_lights_are_lost_irradiance_at_the_samples_that_they_would_have_lit) {
  NEEDS(embree);
  Json file = Json::parse(room());
  file["nodes"][2]["translation"] = file["nodes"][1]["translation"];
  const RoomRun run = run_of(
      file.dump(),
      R"(, "samples": {"opaque": {"divisor": 2}}, "limits": {"dropped_pairs": null}, "storages": ["packed", {"name": "fixed", "cap": 1}])",
      R"("exact-fast")");
  const CaseResult &packed = case_named(run, "packed"), &fixed = case_named(run, "fixed");
  const measure::ShadingCounts& counts = counts_of(fixed, measure::SampleSet::opaque);
  EXPECT_GT(fixed.buffers.dropped_pairs, 0u);
  EXPECT_EQ(2 * counts.missed, counts.needed);
  EXPECT_DOUBLE_EQ(counts.lost_irradiance(), 0.5);
  EXPECT_GT(counts.lost_lux, 0.0);
  // The brightest pixel of one light: 1 cd at 1 m, no more.
  ASSERT_TRUE(counts.darkest);
  EXPECT_NEAR(counts.darkest->lost_lux, 1.0, 0.02);
  EXPECT_LE(counts.darkest->lost_lux, 1.0);
  ASSERT_FALSE(warnings_of(fixed).empty());
  const std::string text = warnings_of(fixed)[0].text;
  EXPECT_NE(text.find("lose 50 % of their irradiance"), std::string::npos) << text;
  EXPECT_NE(text.find("lx on average and"), std::string::npos) << text;
  EXPECT_EQ(counts_of(packed, measure::SampleSet::opaque).lost_lux, 0.0);
}

// --- Methods that need depth ---

// The room with a pane that is no glass in its left half, so that tiles have two depths.
std::string deep_room() {
  Json file = Json::parse(room());
  for (Json& material : file["materials"]) material["alphaMode"] = "OPAQUE";
  file["nodes"][4]["translation"] = {-10, 0, -4};
  file["nodes"][4]["rotation"] = {0, 0.1, 0, 0.99498743710662};
  return file.dump();
}

config::Config config_of(const scene::test::Folder& folder, const std::string& scene, const std::string& rest) {
  folder.write("room.gltf", scene);
  return config::parse_config(
      R"({"scenes": ["room.gltf"], "viewport": [65, 49], "grids": [{"tiles": {"pixels": [9, 7]},
          "slices": {"count": 8, "near": 0.1, "far": 40}}])" +
          rest + "}",
      folder.path() / "c.json");
}

constexpr const char* k_depth_methods =
    R"("tiled", "tiled-2.5d", "flagged", "explicit", {"name": "tiled", "test": "planes"})";
// With those that promise more, or have no cells.
constexpr const char* k_all_depth_methods =
    R"("tiled", "tiled-2.5d", "flagged", "explicit", {"name": "tiled", "test": "planes"}, "tile-slices", "deferred",
       {"name": "deferred", "depth_test": "back"})";

TEST(DepthMethods, lose_nothing_at_the_surfaces_that_their_depths_are_taken_from_at_any_divisor) {
  NEEDS(embree);
  using measure::SampleSet;
  for (const int divisor : {1, 2, 3, 4}) {
    const RoomRun run = run_of(
        deep_room(),
        R"(, "samples": {"opaque": {"divisor": )" + std::to_string(divisor) + R"(}, "fog": {"froxels": [8, 6, 4]}})",
        k_all_depth_methods);
    EXPECT_EQ(run.result.cases.size(), 8u);
    for (const CaseResult& case_result : run.result.cases) {
      const measure::ShadingCounts& opaque = counts_of(case_result, SampleSet::opaque);
      EXPECT_GT(opaque.needed, 100u / static_cast<unsigned>(divisor)) << case_result.name;
      EXPECT_EQ(opaque.missed, 0u) << case_result.name << ", " << divisor;
      EXPECT_EQ(opaque.unanswered, 0u) << case_result.name;
      EXPECT_TRUE(case_result.failures.empty()) << case_result.name;
      EXPECT_TRUE(warnings_of(case_result).empty()) << case_result.name;
      if (case_result.assigner == "tile-slices") {
        EXPECT_EQ(counts_of(case_result, SampleSet::fog).missed, 0u) << divisor;
      }
      if (case_result.assigner == "explicit") {
        EXPECT_GT(counts_of(case_result, SampleSet::fog).missed, 0u) << divisor;
      }
      if (case_result.assigner == "deferred") continue;
      ASSERT_TRUE(case_result.error) << case_result.name;
      EXPECT_EQ(case_result.error->false_negatives, 0u) << case_result.name;
      EXPECT_EQ(case_result.error->undecided, 0u) << case_result.name;
      EXPECT_GT(case_result.error->true_pairs, 0u) << case_result.name;
    }
  }
}

// In plain double precision, over all lights.
std::uint64_t missed_at(const std::vector<grid::Sample>& samples, const view::Frame& frame,
                        const assign::LightStructure& structure, std::uint64_t& needed) {
  std::uint64_t missed = 0;
  std::vector<std::uint32_t> given;
  for (const grid::Sample& sample : samples) {
    structure.lights_at(sample, grid::Log2::rounded, given);
    for (std::uint32_t light = 0; light < frame.lights.size(); ++light) {
      const scene::WorldLight& at = frame.lights[light];
      const Vec3d way = sample.from_eye - (at.position - sample.eye);
      if (at.type != scene::LightType::point || !(glm::length(way) <= at.range_m)) continue;
      ++needed;
      missed += std::ranges::find(given, light) == given.end() ? 1 : 0;
    }
  }
  return missed;
}

TEST(DepthMethods, lose_nothing_on_a_real_map_as_a_loop_over_all_lights_finds) {
  NEEDS(embree);
  const char* library = std::getenv("CLUSTERBENCH_SCENE_LIBRARY");
  const std::string map = (library == nullptr ? "" : library) + std::string("/oacmp-maps/oacmpdm9.glb");
  if (!std::filesystem::exists(map)) GTEST_SKIP() << "the library of scenes is not here";
  const scene::test::Folder folder;
  const config::Config config =
      config::parse_config(R"({"scenes": [{"path": ")" + map + R"(", "frames": 3}], "viewport": [320, 180],
          "grids": [{"tiles": {"pixels": [16, 16]}, "slices": {"count": 16, "near": 0.1, "far": 300}}], "assigners": [)" +
                               k_all_depth_methods + "]}",
                           folder.path() / "c.json");
  const Plan plan = make_plan(config, "");
  const GroupPlan& group = plan.groups.at(0);
  const PathFrames path = path_of(config, plan, group);
  const int frames = test::tries(path.count());
  std::uint64_t needed = 0;
  for (int index = 0; index < frames; ++index) {
    const view::Frame frame = path.frame(index);
    const std::shared_ptr<const depth::DepthImage> depths = depths_for(config, group, path, frame);
    GridOfFrames grids(config.grids[0]);
    grids.update(path, frame);
    const view::LightArrays lights = view::lights_in(frame, frame.view_space);
    for (const Method& method : methods_of(group)) {
      assign::AssignerRun run = start_method(config, method);
      run.build(grids.grid());
      run.assign({frame, lights, depths.get()});
      EXPECT_EQ(missed_at(measure::opaque_samples(frame, *depths), frame, *run.structure(), needed), 0u)
          << method_label(config, method) << ", frame " << index;
    }
  }
  EXPECT_GT(needed, 300'000u * static_cast<unsigned>(frames));
}

TEST(DepthMethods, that_lose_a_light_on_a_surface_fail_and_in_the_air_do_not) {
  NEEDS(embree);
  RoomRun run = run_of(deep_room(), R"(, "samples": {"opaque": {}, "fog": {"froxels": [8, 6, 4]}})", R"("explicit")");
  CaseResult case_result = case_named(run, "explicit");
  ASSERT_EQ(case_result.samples.size(), 2u);
  EXPECT_GT(case_result.samples[1].counts.missed, 0u) << "fog";
  EXPECT_TRUE(failures_of(case_result, {}).empty());
  case_result.samples[0].counts.missed = case_result.samples[0].counts.needed / 2;
  ASSERT_EQ(failures_of(case_result, {}).size(), 1u);
  EXPECT_NE(failures_of(case_result, {})[0].text.find("that its opaque samples need"), std::string::npos);
}

TEST(DepthMethods, do_not_fail_for_surfaces_beyond_the_grid_which_no_list_can_have) {
  NEEDS(embree);
  const RoomRun run =
      run_of(room(), R"(, "samples": {"opaque": {}})", k_all_depth_methods, R"("scheme": "exponential", "far": 5)");
  for (const char* name : {"flagged", "explicit"}) {
    const CaseResult& case_result = case_named(run, name);
    const measure::ShadingCounts& counts = counts_of(case_result, measure::SampleSet::opaque);
    EXPECT_GT(counts.missed_outside, 0u) << name;
    EXPECT_EQ(counts.missed, counts.missed_outside) << name;
    EXPECT_TRUE(case_result.failures.empty()) << name << ": " << case_result.failures[0].text;
  }
}

TEST(DepthMethods, are_not_asked_for_lights_in_the_air_through_the_lookup) {
  NEEDS(embree);
  const RoomRun run = run_of(room(), R"(, "samples": {"opaque": {}}, "lookup": {"samples": 200})", k_all_depth_methods);
  for (const CaseResult& case_result : run.result.cases) {
    EXPECT_TRUE(case_result.failures.empty()) << case_result.name << ": " << case_result.failures[0].text;
    EXPECT_TRUE(case_result.lookup.empty()) << case_result.name;
  }
}

// Lights within 1 m before a camera that sees no farther.
TEST(FrameSamples, are_within_what_the_camera_sees_in_scenes_of_any_unit) {
  Json small = Json::parse(room(false));
  small["cameras"][0]["perspective"]["znear"] = 0.01;
  small["cameras"][0]["perspective"]["zfar"] = 0.5;
  small["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = 0.3;
  small["nodes"][1]["translation"] = {0, 0, -0.3};
  small["nodes"][2]["translation"] = {0, 0, -0.8};
  const RoomRun run = run_of(small.dump(), R"(, "samples": {"fog": {"froxels": [8, 8, 8]}})", R"("exact-fast")",
                             R"("scheme": "exponential", "far": 0.5)");
  const measure::ShadingCounts& fog = counts_of(run.result.cases.at(0), measure::SampleSet::fog);
  EXPECT_GT(fog.needed, 20u);
  EXPECT_EQ(fog.missed, 0u);
}

TEST(DepthMethods, of_a_scene_without_triangles_are_skipped_with_the_reason) {
  const RoomRun run = run_of(room(false), "", R"("tiled", "exact-fast")");
  ASSERT_EQ(run.plan.skipped.size(), 1u);
  EXPECT_EQ(run.plan.skipped[0].reason, "tiled needs a depth buffer, and the scene has no triangles");
  EXPECT_EQ(run.result.cases.size(), 1u);
}

TEST(DepthMethods, have_triangles_read_where_they_are_named_and_are_not_in_what_runs_by_default) {
  NEEDS(embree);
  EXPECT_TRUE(run_of(room(), "", R"("explicit")").plan.scenes[0].geometry);
  EXPECT_FALSE(run_of(room(), "", R"("aabb")").plan.scenes[0].geometry);
  for (const std::string& name : assign::default_assigner_names())
    EXPECT_FALSE(assign::find_assigner(name)->needs.depth) << name;
}

TEST(DepthMethods, and_sets_share_one_image_of_each_frame_and_nothing_is_cast_for_others) {
  NEEDS(embree);
  const auto images_cast = [](const std::string& rest) {
    const scene::test::Folder folder;
    const config::Config config = config_of(folder, deep_room(), rest);
    const Plan plan = make_plan(config, "");
    const PathFrames path = path_of(config, plan, plan.groups.at(0));
    const std::atomic<bool> stop = false;
    const AccuracyResult counted = accuracy_pass(
        config, plan.scenes[0], plan.groups[0], path, [](int) {}, stop);
    const std::vector<TimedFrame> frames = timed_frames(config, plan.groups[0], path, mean_frames(config, path));
    return path.depths() == nullptr ? -1 : path.depths()->images_cast();
  };
  EXPECT_EQ(images_cast(R"(, "assigners": ["tiled", "explicit"], "samples": {"opaque": {}, "transparent": {}})"), 1);
  EXPECT_EQ(images_cast(R"(, "assigners": ["exact-fast"], "samples": {"opaque": {}})"), 1);
  EXPECT_EQ(images_cast(R"(, "assigners": ["exact-fast"])"), -1);
}

// Else a second per frame and grid goes into pixels that no sample asks for.
TEST(FrameSamples, of_surfaces_cast_rays_through_their_own_pixels_alone) {
  NEEDS(embree);
  const scene::test::Folder folder;
  const config::Config config =
      config_of(folder, deep_room(), R"(, "assigners": ["exact-fast"], "samples": {"opaque": {"divisor": 4}})");
  const Plan plan = make_plan(config, "");
  const PathFrames path = path_of(config, plan, plan.groups.at(0));
  const view::Frame frame = path.frame(0);
  const FrameSampleSet set = FrameSamples(config, plan.scenes[0], path).of(frame).back();
  ASSERT_TRUE(set.picture);
  const std::size_t own = depth::PixelGrid(frame.viewport, 4).count();
  EXPECT_EQ(path.depths()->pixels_cast(), own);
  const depth::DepthImage of_all = depth::thinned(*path.depths()->of(frame, 1), set.picture->pixels);
  EXPECT_EQ(path.depths()->pixels_cast(), own + depth::PixelGrid(frame.viewport, 1).count());
  EXPECT_EQ(set.picture->nearest, of_all.nearest);
  EXPECT_GT(set.samples.size(), own / 4);
  EXPECT_EQ(path.depths()->thinned(frame, 4, 1)->nearest, of_all.nearest) << "taken from the image that is kept now";
  EXPECT_EQ(path.depths()->images_cast(), 2);
}

// A frame with a sample in each pixel takes seconds, and whoever ends the program waits for them.
TEST(FrameSamples, end_within_a_frame_when_the_run_is_stopped) {
  const scene::test::Folder folder;
  const config::Config config =
      config_of(folder, deep_room(), R"(, "assigners": ["exact-fast"], "samples": {"opaque": {}})");
  const Plan plan = make_plan(config, "");
  const PathFrames path = path_of(config, plan, plan.groups.at(0));
  std::atomic<bool> stop = false;
  const AccuracyResult counted = accuracy_pass(
      config, plan.scenes[0], plan.groups[0], path, [&](int) { stop = true; }, stop);
  EXPECT_EQ(path.count(), 1);
  EXPECT_FALSE(counted.is_complete);
}

TEST(DepthMethods, share_the_images_of_a_camera_over_grids_and_viewports_have_their_own) {
  NEEDS(embree);
  const auto images_cast = [](const std::string& viewports) {
    const config::Config config =
        config::parse_config(R"({"scenes": [{"path": ")" + test::source_dir() +
                                 R"(/scenes/slope.glb", "frames": 2}], "timing": {"measure": false},
            "grids": [{"tiles": {"pixels": [[8, 8], [16, 16]]}, "slices": {"count": [4, 8], "near": 0.5, "far": 300}}],
            "assigners": ["tiled", "deferred"], "samples": {"opaque": {}}, "viewports": )" +
                                 viewports + "}",
                             "c.json");
    const Plan plan = make_plan(config, "");
    EXPECT_GE(plan.groups.size(), 4u);
    const std::atomic<bool> stop = false;
    run_plan(config, plan, {}, {}, stop);
    return plan.scenes[0].depths->images_cast();
  };
  EXPECT_EQ(images_cast("[[64, 36]]"), 2);
  EXPECT_EQ(images_cast("[[64, 36], [32, 18]]"), 4);
}

TEST(DepthMethods, are_timed_counted_in_their_steps_and_served_as_all_others_are) {
  NEEDS(embree);
  const scene::test::Folder folder;
  const config::Config config = config_of(
      folder, deep_room(),
      std::string(
          R"(, "timing": {"sweep_mib": 4, "rounds": 2, "launches": 1, "min_time_ms": 0.1}, "stability": {"steps": 5}, "shading": {"samples": 20},
          "details": {"frames": [0]}, "lookup": {"samples": 50}, "samples": {"opaque": {"divisor": 2}}, "assigners": ["aabb", )") +
          k_depth_methods + "]");
  const Plan plan = make_plan(config, "");
  const std::atomic<bool> stop = false;
  const Result result = run_plan(config, plan, {}, {}, stop);
  ASSERT_EQ(result.cases.size(), 6u);
  ServedCases served(config, plan);
  for (std::size_t i = 1; i < result.cases.size(); ++i) {
    const CaseResult& case_result = result.cases[i];
    EXPECT_EQ(case_result.storage_label, k_own_structure);
    ASSERT_TRUE(case_result.timing) << case_result.name;
    EXPECT_GT(case_result.timing->frame_ns.median, 0.0) << case_result.name;
    EXPECT_EQ(case_result.timing->pairs_max, case_result.error->reported_pairs) << case_result.name;
    EXPECT_EQ(served.list_digests(case_result.id).at(0).pairs, case_result.error->reported_pairs) << case_result.name;
    EXPECT_GT(served.assign_ns(case_result.id), 0.0) << case_result.name;
    ASSERT_TRUE(case_result.stability) << case_result.name;
    EXPECT_EQ(case_result.stability->undecided, 0u) << case_result.name;
    EXPECT_FALSE(case_result.details) << case_result.name << ": its cells are not the grid's";
    EXPECT_FALSE(case_result.shading) << case_result.name << ": promises nothing in the air";
    EXPECT_TRUE(case_result.lookup.empty())
        << case_result.name << ": it is not the lookup that lacks lights in the air";
  }
  EXPECT_TRUE(result.cases[0].details);
  EXPECT_EQ(result.cases[0].shading->samples, 20u);
  EXPECT_FALSE(result.cases[0].lookup.empty());
}

// Mean depths in metres that lists of a scene's visible pixels cover, of one kind of tiles.
struct CoveredDepths {
  double tiled, masked, clusters, tight, share;  // share of the pixels
};
struct CoveredByTiles {
  CoveredDepths slopes, discontinuities;
};

CoveredByTiles covered_in(const std::string& scene) {
  const config::Config config = config::parse_config(
      R"({"scenes": [{"path": ")" + test::source_dir() + R"(/scenes/)" + scene + R"(.glb", "frames": 3}],
          "viewport": [1920, 1080], "timing": {"measure": false}, "shading": {"samples": 0}, "assigners": ["exact-fast"],
          "grids": [{"tiles": {"pixels": [64, 64]}, "slices": {"scheme": "exponential", "count": 24, "near": 0.5, "far": 300}}],
          "samples": {"opaque": {"divisor": 2}}})",
      "c.json");
  const std::atomic<bool> stop = false;
  const Result result = run_plan(config, make_plan(config, ""), {}, {}, stop);
  const measure::DepthRanges& ranges = result.cases.at(0).depth_ranges.value();
  const auto covered = [&](const measure::DepthRanges::Tiles& tiles) {
    const auto pixels = static_cast<double>(ranges.slopes.pixels + ranges.discontinuities.pixels);
    return CoveredDepths{tiles.lengths[0].mean_m(), tiles.lengths[1].mean_m(), tiles.lengths[2].mean_m(),
                         tiles.lengths[3].mean_m(), static_cast<double>(tiles.pixels) / pixels};
  };
  return {covered(ranges.slopes), covered(ranges.discontinuities)};
}

// Persson 2015: at discontinuities a mask of parts helps tiles, on slopes it does not; clusters are about as deep as
// the larger part, and explicit bounds are always the tightest.
TEST(FrameSamples, depths_that_lists_cover_are_in_the_order_of_perssons_table) {
  NEEDS(embree);
  const CoveredDepths steps = covered_in("steps").discontinuities;
  EXPECT_GT(steps.share, 0.8);
  EXPECT_GT(steps.tiled, 4.0 * steps.masked);
  EXPECT_GT(steps.tiled, 2.0 * steps.clusters);
  const CoveredDepths slope = covered_in("slope").slopes;
  EXPECT_GT(slope.share, 0.9);
  EXPECT_LT(slope.tiled, 2.0 * slope.masked);
  EXPECT_GT(slope.masked, slope.clusters);
  const CoveredByTiles mix = covered_in("mix");
  EXPECT_GT(mix.discontinuities.share, 0.05);
  EXPECT_GT(mix.discontinuities.tiled / mix.discontinuities.masked, mix.slopes.tiled / mix.slopes.masked);
  for (const CoveredDepths& covered : {steps, slope, mix.slopes, mix.discontinuities}) {
    EXPECT_LT(covered.tight, covered.clusters);
    EXPECT_LT(covered.tight, covered.masked);
  }
}

TEST(FrameSamples, depths_that_lists_cover_are_told_with_visible_surfaces_alone) {
  NEEDS(embree);
  EXPECT_TRUE(case_named(run_of(room(), k_all_sets), "exact-fast/packed").depth_ranges);
  EXPECT_FALSE(case_named(run_of(room(), ""), "exact-fast/packed").depth_ranges);
  EXPECT_FALSE(case_named(run_of(room(false), k_all_sets), "exact-fast/packed").depth_ranges) << "no surfaces";
}

}  // namespace
}  // namespace clusterbench::run
