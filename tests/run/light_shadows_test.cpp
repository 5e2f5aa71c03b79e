// What lies in shadow, from a scene's file to a case's result.

#include "run/findings/light_shadows.h"

#include <gtest/gtest.h>

#include <atomic>

#include "core/error.h"
#include "core/memory.h"
#include "core/random.h"
#include "run/runner.h"
#include "scene/mesh_fixture.h"

namespace clusterbench::run {
namespace {

using Json = nlohmann::json;
using scene::test::MeshFile;

void begin(MeshFile& file) {
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"range", 6}}, {{"type", "spot"}, {"range", 9}, {"spot", {{"outerConeAngle", 0.6}}}}};
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}, {"zfar", 100}}}}};
  file.node({{"camera", 0}});
}

void add_light(MeshFile& file, const Json& at, int kind = 0) {
  file.node({{"translation", at}, {"extensions", {{"KHR_lights_punctual", {{"light", kind}}}}}});
}

void add_triangles(MeshFile& file, const std::vector<Vec3f>& corners) {
  Json primitive = {{"attributes", {{"POSITION", file.positions(corners)}}}};
  primitive["material"] = file.material({{"doubleSided", true}});
  file.node({{"mesh", file.mesh(primitive)}});
}

// Walls, and lights before, between and behind them.
std::string walls() {
  MeshFile file;
  begin(file);
  std::vector<Vec3f> corners;
  for (const float z : {-6.0f, -10.0f, -20.0f}) {
    const float half = z < -15.0f ? 40.0f : 4.0f;
    const Vec3f a(-half, -half, z), b(half, -half, z), c(half, half, z), d(-half, half, z);
    corners.insert(corners.end(), {a, b, c, a, c, d});
  }
  add_triangles(file, corners);
  for (const Json& at : {Json{0, 0, -5}, Json{1, 0, -8}, Json{-2, 1, -12}, Json{5, 0, -18}, Json{0, 0.5, -10.8}})
    add_light(file, at);
  add_light(file, {0, 2, -4}, 1);
  return file.text();
}

// Triangles and lights anywhere before the eye.
std::string soup() {
  MeshFile file;
  begin(file);
  SplitMix64 random(4);
  const auto between = [&](const Vec3d& lo, const Vec3d& hi) {
    Vec3d p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = random.between(lo[axis], hi[axis]);
    return p;
  };
  std::vector<Vec3f> corners;
  for (int i = 0; i < 150; ++i) {
    const Vec3d middle = between({-8, -5, -24}, {8, 5, -2});
    for (int k = 0; k < 3; ++k) corners.emplace_back(middle + between(Vec3d(-2.5), Vec3d(2.5)));
  }
  add_triangles(file, corners);
  for (int i = 0; i < 40; ++i) {
    const Vec3d at = between({-8, -5, -24}, {8, 5, -2});
    add_light(file, {at.x, at.y, at.z}, i % 2);
  }
  return file.text();
}

Result shadowed_run_of(
    const std::string& scene, const std::string& rest,
    const std::string& grids = R"({"tiles": {"count": [16, 12]}, "slices": {"count": 24, "near": 0.1, "far": 40}})") {
  const scene::test::Folder folder;
  folder.write("walls.gltf", scene);
  const config::Config config = config::parse_config(
      R"({"scenes": ["walls.gltf"], "viewport": [96, 72], "timing": {"measure": false}, "shading": {"samples": 0},
          "assigners": ["exact-fast", "aabb"], "grids": [)" +
          grids + "]" + rest + "}",
      folder.path() / "c.json");
  Plan plan = make_plan(config, "");
  const std::atomic<bool> stop = false;
  Result result = run_plan(config, plan, {}, {}, stop);
  result.skipped = plan.skipped;
  return result;
}

constexpr const char* k_asks =
    R"(, "samples": {"opaque": {"divisor": 1}}, "shadow_cull": {"resolution": [8, 64], "texels": ["proven", "sampled"]})";

constexpr const char* k_all_kinds =
    R"({"tiles": {"count": [16, 12]}, "slices": {"count": 24, "near": 0.1, "far": 40}},
       {"kind": "distance", "tiles": {"count": [16, 12]}, "slices": {"count": 24, "near": 0.1, "far": 40}},
       {"kind": "cascades", "levels": 5, "cells": [16, 16, 16], "finest": 0.5}, {"kind": "world", "cells": [32, 32, 32]})";

TEST(LightShadows, pairs_behind_walls_go_and_no_visible_lit_light_goes_with_them) {
  const Result result = shadowed_run_of(walls(), k_asks);
  ASSERT_EQ(result.cases.size(), 2u);
  for (const CaseResult& of : result.cases) {
    ASSERT_EQ(of.shadow_culls.size(), 4u);
    for (const ShadowCullResult& cull : of.shadow_culls) {
      const measure::ShadowCullCounts& counts = cull.counts;
      EXPECT_LT(counts.kept, counts.pairs);
      EXPECT_LT(counts.true_kept, counts.true_pairs);
      EXPECT_LE(counts.evaluated_kept, counts.evaluated);
      EXPECT_GT(counts.lit, 0u);
      EXPECT_LT(counts.lit, counts.needed) << "a wall stands before the last one";
      EXPECT_EQ(counts.wrong, 0u);
      EXPECT_EQ(counts.samples, 96u * 72u * static_cast<unsigned>(of.frames));
      EXPECT_EQ(cull.maps.lights, 6u);
      EXPECT_EQ(cull.maps.made, 6u) << "nothing moves";
      EXPECT_EQ(cull.maps.faces, 5u * 6u + 1u);
    }
    // Finer maps take out more.
    EXPECT_LT(of.shadow_culls[2].counts.kept, of.shadow_culls[0].counts.kept);
    EXPECT_EQ(of.error->false_negatives, 0u) << "the case's own lists are those before";
  }
}

TEST(LightShadows, proven_maps_lose_no_lit_light_in_any_kind_of_grid) {
  const Result result = shadowed_run_of(soup(), k_asks, k_all_kinds);
  std::uint64_t removed = 0;
  for (const CaseResult& of : result.cases)
    for (const ShadowCullResult& cull : of.shadow_culls) {
      if (cull.request.texels != depth::TexelBound::proven) continue;
      EXPECT_EQ(cull.counts.wrong, 0u) << of.name << " " << cull.request.resolution;
      EXPECT_GT(cull.counts.lit, 0u);
      removed += cull.counts.pairs - cull.counts.kept;
      const bool is_fine = cull.request.resolution == 64;
      EXPECT_TRUE(!is_fine || cull.counts.kept < cull.counts.pairs) << of.name;
    }
  EXPECT_GT(removed, 0u);
}

TEST(LightShadows, counts_do_not_depend_on_threads_nor_on_what_else_is_measured) {
  const auto counts = [](const Result& result, std::size_t index) {
    const measure::ShadowCullCounts& c = result.cases.at(0).shadow_culls.at(index).counts;
    const ShadowCullResult::Maps& maps = result.cases.at(0).shadow_culls.at(index).maps;
    return std::vector<std::uint64_t>{c.pairs, c.kept,    c.true_kept, c.evaluated_kept, c.lit,
                                      c.wrong, maps.made, maps.texels, maps.unlimited,   maps.bytes};
  };
  const Result one = shadowed_run_of(soup(), k_asks),
               more = shadowed_run_of(soup(), std::string(k_asks) + R"(, "threads": 4)");
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(counts(one, i), counts(more, i)) << i;
  const Result alone = shadowed_run_of(
      soup(), R"(, "samples": {"opaque": {"divisor": 1}}, "shadow_cull": {"resolution": 64, "texels": "sampled"})");
  EXPECT_EQ(counts(one, 3), counts(alone, 0));
}

TEST(LightShadows, a_light_that_moves_gets_a_new_map_in_each_frame) {
  Json moving = Json::parse(walls());
  MeshFile keys;
  const std::size_t times = keys.accessor(scene::test::bytes_of(std::vector<float>{0.0f, 1.0f}), 5126, "SCALAR", 2);
  const std::size_t places = keys.positions({{0, 0, -5}, {1, 0, -5}});
  const Json of_keys = Json::parse(keys.text());
  const auto views = moving["bufferViews"].size(), accessors = moving["accessors"].size();
  moving["buffers"].push_back(of_keys["buffers"][0]);
  for (Json view : of_keys["bufferViews"]) {
    view["buffer"] = 1;
    moving["bufferViews"].push_back(view);
  }
  for (Json accessor : of_keys["accessors"]) {
    accessor["bufferView"] = accessor["bufferView"].get<std::size_t>() + views;
    moving["accessors"].push_back(accessor);
  }
  moving["accessors"][accessors + times]["min"] = {0};
  moving["accessors"][accessors + times]["max"] = {1};
  moving["animations"] = {{{"samplers", {{{"input", accessors + times}, {"output", accessors + places}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}}}}};
  const Result result = shadowed_run_of(moving.dump(), k_asks);
  const ShadowCullResult& cull = result.cases.at(0).shadow_culls.at(0);
  const auto frames = static_cast<std::uint64_t>(result.cases.at(0).frames);
  ASSERT_GT(frames, 1u);
  EXPECT_EQ(cull.maps.lights, 6u);
  EXPECT_EQ(cull.maps.made, 5u + frames);
}

TEST(LightShadows, without_the_key_cases_are_what_they_were_and_with_it_they_are_others) {
  const Result plain = shadowed_run_of(walls(), ""),
               asked = shadowed_run_of(walls(), R"(, "shadow_cull": {}, "shadow_frusta": {})");
  EXPECT_FALSE(plain.config.contains("shadow_cull"));
  EXPECT_TRUE(plain.cases.at(0).shadow_culls.empty());
  EXPECT_FALSE(plain.cases.at(0).shared_frusta);
  EXPECT_NE(plain.cases.at(0).id, asked.cases.at(0).id);
  ASSERT_EQ(asked.cases.at(0).shadow_culls.size(), 1u);
  EXPECT_FALSE(asked.cases.at(0).shadow_culls[0].has_samples);
  ASSERT_TRUE(asked.cases.at(0).shared_frusta);
  EXPECT_DOUBLE_EQ(asked.cases.at(0).shared_frusta->counts.spots.most, 1.0);
}

TEST(LightShadows, a_scene_without_triangles_is_named_and_has_none) {
  MeshFile file;
  begin(file);
  add_light(file, {0, 0, -5});
  const Result result = shadowed_run_of(file.text(), R"(, "shadow_cull": {})");
  ASSERT_EQ(result.skipped.size(), 1u);
  EXPECT_EQ(result.skipped[0].name, "walls/shadow_cull");
  EXPECT_EQ(result.skipped[0].reason, "the scene has no triangles");
  EXPECT_TRUE(result.cases.at(0).shadow_culls.empty());
}

// At 128 texels a point's map takes 524 KiB: one is within the limit, those of all points are not.
TEST(LightShadows, maps_of_all_lights_are_counted_before_they_take_memory) {
  const auto run = [](int resolution) {
    const MemoryLimitScope limit(memory_limit());  // back to it: a configuration's limit stays
    shadowed_run_of(walls(), R"(, "limits": {"memory_mib": 1}, "shadow_cull": {"texels": "sampled", "resolution": )" +
                                 std::to_string(resolution) + "}");
  };
  EXPECT_NO_THROW(run(16));
  try {
    run(128);
    ADD_FAILURE() << "each map fits, and all of them do not";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("bytes of shadow maps"), std::string::npos) << error.what();
  }
}

// Decals have no shadow.
TEST(LightShadows, boxes_are_no_points_that_share_nothing) {
  MeshFile file;
  begin(file);
  add_light(file, {0, 0, -5});
  file.node({{"translation", {0, 0, -6}}, {"extras", {{"clusterbench_box", {{"half_extents", {1, 1, 1}}}}}}});
  const scene::test::Folder folder;
  folder.write("a.gltf", file.text());
  const config::Config config = config::parse_config(
      R"({"scenes": [{"path": "a.gltf", "boxes": true}], "assigners": ["box-bounds"], "grids": [{}], "shadow_frusta": {},
          "timing": {"measure": false}})",
      folder.path() / "c.json");
  const std::atomic<bool> stop = false;
  const Plan plan = make_plan(config, "");
  const Result result = run_plan(config, plan, {}, {}, stop);
  ASSERT_FALSE(result.cases.empty());
  EXPECT_EQ(result.cases[0].shared_frusta->counts.points.most, 1.0);
}

}  // namespace
}  // namespace clusterbench::run
