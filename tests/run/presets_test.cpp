// Presets on scenes, against the truth.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "config/presets/preset_library.h"
#include "needs.h"
#include "places.h"
#include "run/cases/plan.h"
#include "run/findings/gate.h"
#include "run/runner.h"

namespace clusterbench::run {
namespace {

std::string own_scene(const std::string& name) {
  return test::source_dir() + "/scenes/" + name;
}

config::Config preset_config(const std::string& scene, const std::string& rest) {
  return config::parse_config(R"({"scenes": [{"path": ")" + scene + R"(", "frames": 2}], "viewport": [320, 180],
      "timing": {"measure": false}, "shading": {"samples": 256})" +
                                  rest + "}",
                              "c.json");
}

Result preset_results(const config::Config& config, const Plan& plan) {
  const std::atomic<bool> stop{false};
  return run_plan(config, plan, {}, {}, stop, {}, {});
}

std::vector<CasePlan> preset_cases(const Plan& plan) {
  std::vector<CasePlan> all;
  for (const GroupPlan& group : plan.groups) all.insert(all.end(), group.cases.begin(), group.cases.end());
  return all;
}

// Each preset once, run or skipped. Not naive: loses no pair, and passes.
void expect_all_presets(const Result& result, const Plan& plan) {
  std::multiset<std::string> told;
  for (const CaseResult& one : result.cases) {
    told.insert(one.preset);
    EXPECT_TRUE(one.failures.empty()) << one.name << ": " << one.failures[0].text;
    EXPECT_TRUE(!one.conservative || !one.error || one.error->false_negatives == 0) << one.name;
  }
  for (const Skipped& skipped : plan.skipped)
    if (!skipped.preset.empty()) told.insert(skipped.preset);
  const std::vector<std::string> names = config::preset_names();
  EXPECT_EQ(told, std::multiset<std::string>(names.begin(), names.end()));
}

TEST(PresetRuns, each_preset_is_one_case_and_nothing_else_is_measured) {
  const config::Config config = preset_config(own_scene("street.glb"), R"(, "presets": ["*"])");
  const Plan plan = make_plan(config, "");
  std::set<std::string> ids, presets;
  for (const CasePlan& one : preset_cases(plan)) {
    EXPECT_TRUE(ids.insert(one.id).second);
    EXPECT_TRUE(presets.insert(one.preset).second) << one.preset << " stands there twice";
    EXPECT_NE(one.name.find("/" + one.preset + ": "), std::string::npos) << one.name;
  }
}

TEST(PresetRuns, presets_that_need_depth_are_skipped_with_a_reason_where_a_scene_has_none) {
  const Plan plan = make_plan(preset_config(own_scene("street.glb"), R"(, "presets": ["wicked", "unity-*"])"), "");
  std::set<std::string> skipped;
  for (const Skipped& one : plan.skipped)
    if (one.reason.find("needs a depth buffer") != std::string::npos) skipped.insert(one.preset);
  EXPECT_EQ(skipped, (std::set<std::string>{"wicked", "unity-hdrp", "unity-hdrp-fptl"}));
  EXPECT_EQ(preset_cases(plan).size(), 1u);
}

TEST(PresetRuns, conservative_presets_lose_nothing_on_a_street) {
  const config::Config config = preset_config(own_scene("street.glb"), R"(, "presets": ["*"])");
  const Plan plan = make_plan(config, "");
  expect_all_presets(preset_results(config, plan), plan);
}

TEST(PresetRuns, conservative_presets_lose_nothing_where_there_are_surfaces) {
  NEEDS(embree);
  const config::Config config = preset_config(own_scene("mix.glb"), R"(, "presets": ["*"], "samples": {"opaque": {}})");
  const Plan plan = make_plan(config, "");
  const Result result = preset_results(config, plan);
  expect_all_presets(result, plan);
  EXPECT_EQ(result.cases.size(), config::presets().size());
}

TEST(PresetRuns, conservative_presets_lose_nothing_on_a_real_map) {
  NEEDS(embree);
  const char* library = std::getenv("CLUSTERBENCH_SCENE_LIBRARY");
  const std::string map = (library == nullptr ? "" : library) + std::string("/oacmp-maps/oacmpdm9.glb");
  if (!std::filesystem::exists(map)) GTEST_SKIP() << "the library of scenes is not here";
  const config::Config config = preset_config(
      map, R"(, "presets": ["just-cause-*", "filament", "bevy", "godot", "wicked", "unreal", "playcanvas"])");
  const Result result = preset_results(config, make_plan(config, ""));
  EXPECT_EQ(result.cases.size(), 8u);
  for (const CaseResult& one : result.cases) EXPECT_TRUE(one.failures.empty()) << one.name;
}

// Small lights side by side before a camera at the origin, and as many behind it as are asked for; in a file that goes
// with the object.
class RowOfLights {
 public:
  RowOfLights(int in_view, int behind) {
    nlohmann::json nodes = nlohmann::json::array(), lights = nlohmann::json::array();
    for (int i = 0; i < in_view + behind; ++i) {
      const bool is_behind = i < behind;  // first in the file
      const int k = is_behind ? i : i - behind;
      const double x = -7.0 + 0.5 * (k % 29), y = -3.5 + 0.5 * (k / 29 % 15), z = is_behind ? 12.0 : -12.0 - k / 435;
      lights.push_back({{"type", "point"}, {"range", 0.3}, {"intensity", 10.0}});
      nodes.push_back({{"translation", {x, y, z}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    nodes.push_back({{"camera", 0}});
    nlohmann::json roots = nlohmann::json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) roots.push_back(i);
    const nlohmann::json gltf{
        {"asset", {{"version", "2.0"}}},
        {"extensionsUsed", {"KHR_lights_punctual"}},
        {"extensions", {{"KHR_lights_punctual", {{"lights", lights}}}}},
        {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}, {"zfar", 200.0}}}}}},
        {"nodes", nodes},
        {"scenes", {{{"nodes", roots}}}},
        {"scene", 0}};
    std::ofstream(path_) << gltf;
  }
  ~RowOfLights() { std::filesystem::remove(path_); }
  RowOfLights(const RowOfLights&) = delete;
  RowOfLights& operator=(const RowOfLights&) = delete;

  std::string path() const { return path_; }

 private:
  std::string path_ =
      (std::filesystem::temp_directory_path() / ("clusterbench_limit_" + std::to_string(getpid()) + ".gltf")).string();
};

// What it says of a limit; "" for nothing.
std::string limit_warning(const CaseResult& one) {
  for (const Warning& warning : warnings_of(one))
    if (warning.kind == Warning::Kind::too_many_lights) return warning.text;
  return "";
}

TEST(PresetRuns, lights_in_view_beyond_an_engines_limit_are_lost_and_fail_nothing) {
  const RowOfLights row(300, 0);
  const config::Config config = preset_config(row.path(), R"(, "presets": ["playcanvas", "filament", "godot"])");
  const Result result = preset_results(config, make_plan(config, ""));
  ASSERT_EQ(result.cases.size(), 3u);
  for (const CaseResult& one : result.cases) {
    const std::size_t beyond = one.preset == "playcanvas" ? 45 : one.preset == "filament" ? 44 : 0;
    ASSERT_TRUE(one.pre_cull) << one.preset;
    EXPECT_EQ(one.pre_cull->counts.dropped.size(), beyond) << one.preset;
    EXPECT_EQ(one.pre_cull->counts.lost_to_limits > 0, beyond > 0) << one.preset;
    EXPECT_EQ(loses_lights(one), beyond > 0) << one.preset;
    EXPECT_TRUE(one.failures.empty()) << one.preset;
    EXPECT_EQ(limit_warning(one).empty(), beyond == 0) << one.preset;
  }
  EXPECT_NE(limit_warning(result.cases[0])
                .find("its limit of 255 lights in view is exceeded in 1 of 1 frame, by up to 45; 45 lights are lost"),
            std::string::npos)
      << limit_warning(result.cases[0]);
}

TEST(PresetRuns, a_limit_of_each_type_is_said_to_be_one) {
  const RowOfLights row(520, 0);
  const config::Config config = preset_config(row.path(), R"(, "presets": ["godot"])");
  const Result result = preset_results(config, make_plan(config, ""));
  ASSERT_EQ(result.cases.size(), 1u);
  EXPECT_NE(limit_warning(result.cases[0])
                .find("its limit of 512 lights of each type in view is exceeded in 1 of 1 frame, by up to 8;"),
            std::string::npos)
      << limit_warning(result.cases[0]);
}

TEST(PresetRuns, six_hundred_lights_in_the_level_of_which_forty_are_in_view_lose_nothing) {
  const RowOfLights row(40, 560);
  const config::Config config =
      preset_config(row.path(), R"(, "presets": ["playcanvas", "filament", "godot", "unity-urp", "doom-2016"])");
  const Result result = preset_results(config, make_plan(config, ""));
  ASSERT_EQ(result.cases.size(), 5u);
  for (const CaseResult& one : result.cases) {
    EXPECT_FALSE(loses_lights(one)) << one.preset;
    EXPECT_EQ(limit_warning(one), "") << one.preset;
    EXPECT_EQ(one.pre_cull->counts.kept.max, 40.0) << one.preset;
    EXPECT_TRUE(one.failures.empty()) << one.preset;
  }
}

TEST(PresetRuns, as_shipped_they_lose_lights_that_their_schemes_have_and_fail_nothing) {
  const std::string rest = R"(, "presets": ["filament", "bevy", "three-js", "babylon"])";
  const config::Config scheme = preset_config(own_scene("mix.glb"), rest),
                       shipped = preset_config(own_scene("mix.glb"), R"(, "as_shipped": true)" + rest);
  const Result careful = preset_results(scheme, make_plan(scheme, "")),
               careless = preset_results(shipped, make_plan(shipped, ""));
  ASSERT_EQ(careful.cases.size(), 4u);
  ASSERT_EQ(careless.cases.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NE(careful.cases[i].id, careless.cases[i].id);
    const std::uint64_t to_limit = careful.cases[i].pre_cull ? careful.cases[i].pre_cull->counts.lost_to_limits : 0;
    EXPECT_EQ(careful.cases[i].error->false_negatives, to_limit) << careful.cases[i].preset;
    EXPECT_GE(careless.cases[i].error->false_negatives, to_limit) << careless.cases[i].preset;
    EXPECT_FALSE(careless.cases[i].conservative) << careless.cases[i].preset;
    EXPECT_TRUE(careless.cases[i].failures.empty()) << careless.cases[i].preset;
  }
}

TEST(PresetRuns, what_a_preset_has_no_room_for_is_told_and_fails_nothing) {
  const config::Config config =
      preset_config(own_scene("jam.glb"), R"(, "presets": ["just-cause-2"], "limits": {"dropped_pairs": 0})");
  const Result result = preset_results(config, make_plan(config, ""));
  ASSERT_EQ(result.cases.size(), 1u);
  EXPECT_GT(result.cases[0].buffers.dropped_pairs, 0u);
  EXPECT_TRUE(result.cases[0].failures.empty());
  EXPECT_TRUE(loses_lights(result.cases[0]));
}

TEST(PresetRuns, a_configurations_own_cases_keep_their_ids_beside_presets) {
  const std::string own =
      R"(, "grids": [{"tiles": {"pixels": [64, 64]}, "slices": {"count": 16, "near": 0.1, "far": 500}}],
      "assigners": ["aabb", {"name": "sphere-refinement", "spot": "narrowing"}],
      "storages": [{"name": "packed", "index_bits": "16"}, "runs"], "samples": {"opaque": {}})";
  const Plan alone = make_plan(preset_config(own_scene("street.glb"), own), "");
  const Plan both =
      make_plan(preset_config(own_scene("street.glb"), own + R"(, "presets": ["just-cause-3", "doom-2016"])"), "");
  std::vector<std::string> before, beside;
  for (const CasePlan& one : preset_cases(alone)) before.push_back(one.id);
  std::size_t of_presets = 0;
  for (const CasePlan& one : preset_cases(both)) {
    if (one.preset.empty()) beside.push_back(one.id);
    of_presets += one.preset.empty() ? 0 : 1;
  }
  EXPECT_EQ(before, beside);
  EXPECT_EQ(before.size(), 4u);
  EXPECT_EQ(of_presets, 2u) << "one has the very grid, method and storage of the product, and is a case of its own";
}

}  // namespace
}  // namespace clusterbench::run
