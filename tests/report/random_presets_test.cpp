// Presets and conclusions on random levels with as many lights as engines take, one more, one less, or none: what is
// taken never lacks light, and who has a limit says when a level is beyond it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "config/presets/preset_library.h"
#include "core/random.h"
#include "effort.h"
#include "needs.h"
#include "report/cases/json_values.h"
#include "report/results/result_record.h"
#include "run/runner.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// A camera with a perspective and an orthographic one, at the same place. By construction lights are well in view of
// both, or between the eyes and near planes of 5 m, or beyond far planes of 40 m, or far behind both.
struct PresetLevel {
  std::uint64_t seen = 0, spots = 0, behind = 0;  // spots: in view, beside `seen` points
  std::uint64_t near = 0, beyond = 0;             // 0.5 to 2.5 m and `beyond_m` to 30 m more deep
  std::uint64_t aside = 0;                        // spots that shine away from the view, into which their ranges reach
  double near_m = 0.1;                            // of both cameras; below 1 m the orthographic view begins at 0
  bool is_endless = false;                        // the perspective has no far plane
  bool are_dark = false;
  double beyond_m = 60.0;
  double deepest_m = 30.0;  // of those well in view
  bool has_wall = false;    // before which all of them are

  std::uint64_t in_view(bool is_flat) const { return points_in_view(is_flat) + spots; }
  std::uint64_t points_in_view(bool is_flat) const {
    return seen + (near_m < 1.0 ? near : 0) + (is_endless && !is_flat ? beyond : 0);
  }
  std::uint64_t lights() const { return seen + spots + near + beyond + behind + aside; }
};

Json cameras_json(const PresetLevel& level) {
  const double flat_near_m = level.near_m < 1.0 ? 0.0 : level.near_m;
  Json perspective{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", level.near_m}, {"zfar", 40.0}}}};
  if (level.is_endless) perspective["perspective"].erase("zfar");
  return {perspective,
          {{"type", "orthographic"},
           {"orthographic", {{"xmag", 8.0}, {"ymag", 4.5}, {"znear", flat_near_m}, {"zfar", 40.0}}}}};
}

// Two triangles across the view, 35 m deep.
void add_wall(Json& scene) {
  scene["buffers"] =
      Json::array({{{"byteLength", 72},
                    {"uri",
                     "data:application/"
                     "octet-stream;base64,AABwwgAAcMIAAAzCAABwQgAAcMIAAAzCAABwQgAAcEIAAAzCAABwwgAAcMIAAAzCAABwQgAAcEIA"
                     "AAzCAABwwgAAcEIAAAzC"}}});
  scene["bufferViews"] = Json::array({{{"buffer", 0}, {"byteLength", 72}}});
  scene["accessors"] = Json::array({{{"bufferView", 0},
                                     {"componentType", 5126},
                                     {"count", 6},
                                     {"type", "VEC3"},
                                     {"min", {-60.0, -60.0, -35.0}},
                                     {"max", {60.0, 60.0, -35.0}}}});
  scene["meshes"] = Json::array({{{"primitives", Json::array({{{"attributes", {{"POSITION", 0}}}}})}}});
  scene["nodes"].push_back({{"mesh", 0}});
}

Json preset_level_json(const PresetLevel& level, SplitMix64& random) {
  Json out{{"asset", {{"version", "2.0"}}},
           {"scene", 0},
           {"nodes", Json::array({{{"name", "deep"}, {"camera", 0}}, {{"name", "flat"}, {"camera", 1}}})},
           {"cameras", cameras_json(level)}};
  if (level.has_wall) add_wall(out);
  const auto add = [&](double x, double y, double z, int lamp = 0) {
    out["nodes"].push_back({{"translation", {x, y, z}}, {"extensions", {{"KHR_lights_punctual", {{"light", lamp}}}}}});
  };
  for (std::uint64_t i = 0; i < level.seen + level.spots; ++i)
    add(random.between(-3.0, 3.0), random.between(-2.0, 2.0), random.between(-level.deepest_m, -8.0),
        i < level.seen ? 0 : 1);
  for (std::uint64_t i = 0; i < level.near; ++i)
    add(random.between(-0.2, 0.2), random.between(-0.2, 0.2), random.between(-2.5, -0.5));
  for (std::uint64_t i = 0; i < level.beyond; ++i)
    add(random.between(-5.0, 5.0), 0.0, random.between(-level.beyond_m - 30.0, -level.beyond_m));
  for (std::uint64_t i = 0; i < level.aside; ++i) {
    add(random.between(10.5, 10.7), 0.0, -10.0, 1);
    out["nodes"].back()["rotation"] = {0.0, -std::sqrt(0.5), 0.0, std::sqrt(0.5)};  // along +x
  }
  for (std::uint64_t i = 0; i < level.behind; ++i) add(random.between(-5.0, 5.0), 0.0, random.between(400.0, 900.0));
  Json all = Json::array();
  for (std::size_t i = 0; i < out["nodes"].size(); ++i) all.push_back(i);
  out["scenes"] = Json::array({{{"nodes", all}}});
  if (level.lights() == 0) return out;
  const Json point{{"type", "point"}, {"range", 2.0}, {"intensity", level.are_dark ? 0.0 : 50.0}};
  Json spot = point;
  spot["type"] = "spot";
  spot["spot"] = {{"outerConeAngle", 0.5}};
  out["extensionsUsed"] = Json::array({"KHR_lights_punctual"});
  out["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({point, spot});
  return out;
}

// All in a few milliseconds at this size; those with limits by lights in view, by lights of the scene, and without; and
// clusterings of its own that lose lights: a grid that ends too early, and lists that are too short.
constexpr const char* k_settings =
    R"("viewport": [64, 36], "presets": ["just-cause-2", "humus", "doom-2016", "filament",
    "bevy", "playcanvas", "ogre-next"], "grids": [{"kind": "frustum", "tiles": {"count": [4, 3]},
    "slices": {"scheme": "linear", "count": 4, "near": 0.05, "far": [12, 45]}}], "assigners": ["exact-fast"],
    "storages": ["packed", {"name": "fixed", "cap": 6}], "limits": {"dropped_pairs": null},
    "timing": {"measure": false}, "shading": {"samples": 3000})";
// All presets, whose lists are not asked about.
constexpr const char* k_all_presets =
    R"("viewport": [64, 36], "presets": ["*"], "accuracy": {"check": false}, "timing": {"measure": false},
    "shading": {"samples": 300})";
// Those whose grids can end before the view does, or follow the lights.
std::string settings_with(int samples) {
  return R"("viewport": [64, 36], "presets": ["just-cause-3", "humus", "filament", "bevy", "bevy-gpu", "playcanvas",
    "stride", "godot"], "timing": {"measure": false}, "shading": {"samples": )" +
         std::to_string(samples) + "}";
}

class RandomPresets : public ::testing::Test {
 protected:
  ~RandomPresets() override { std::filesystem::remove_all(folder_); }

  Json measured(const PresetLevel& level, SplitMix64& random, const std::string& settings = k_settings) const {
    return measured(preset_level_json(level, random), settings);
  }
  Json measured(const Json& level, const std::string& settings) const {
    std::filesystem::create_directories(folder_);
    const std::filesystem::path file = folder_ / "level.gltf";
    std::ofstream(file) << level.dump();
    const config::Config config = config::parse_config(
        R"({"scenes": [{"path": ")" + file.string() + R"(", "camera": "*"}], )" + settings + "}", "c.json");
    const run::Plan plan = run::make_plan(config, "");
    return result::to_json(record_of(run::run_plan(config, plan, {}, {}, std::atomic<bool>{false}), {}));
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("clusterbench-presets-" + std::to_string(::getpid()));
};

// Around the limits, and few enough that samples say little.
PresetLevel preset_level(SplitMix64& random) {
  constexpr std::uint64_t k_counts[] = {0, 1, 12, 127, 128, 129, 254, 255, 256, 257};
  PresetLevel level;
  level.seen = k_counts[random.below(std::size(k_counts))];
  level.behind = random.below(2) * random.below(20);
  level.near = random.below(2) * random.below(150);
  level.near_m = random.below(2) == 0 ? 0.1 : 5.0;
  level.are_dark = random.below(8) == 0;
  return level;
}

// So many that each limit of an engine is met, or exceeded by one, or one remains: of all lights that the orthographic
// camera sees, or of the points. In every second half of 30 rounds there are no others, so that limits of the scene
// are.
PresetLevel level_at_limits(std::uint64_t round, SplitMix64& random) {
  constexpr std::uint64_t k_limits[] = {128, 255, 256, 512, 1024};
  const std::uint64_t count = k_limits[round % 5] - 1 + round / 5 % 3, others = round / 15 % 2 == 0 ? 300 : 1;
  PresetLevel level;
  level.near = random.below(2) * random.below(others);
  level.beyond = random.below(2) * random.below(others);
  level.behind = random.below(2) * random.below(others);
  level.aside = random.below(2) * random.below(others);
  level.near_m = random.below(2) == 0 ? 0.1 : 5.0;
  level.is_endless = random.below(3) == 0;
  level.has_wall = true;
  if (random.below(2) == 0) level.spots = random.below(count);
  const std::uint64_t counted = random.below(3) == 0 ? level.points_in_view(true) : level.in_view(true);
  level.seen = count - std::min(count, counted);
  return level;
}

// Whether a limit counts the lights of the view, and not those of the scene.
bool is_of_view(const config::Preset& preset) {
  return std::ranges::any_of(preset.pre_cull.value_or(result::Json::array()),
                             [](const result::Json& step) { return step == "frustum"; });
}

bool is_by_type(const config::Preset& preset) {
  return config::limit_text(preset).find("of each type") != std::string::npos;
}

// How many lights the engine has no room for, counted from how the level was made.
std::uint64_t lights_over_limit(const config::Preset& preset, const PresetLevel& level, bool is_flat) {
  const std::uint64_t most = config::most_lights(preset);
  const auto over = [&](std::uint64_t lights) { return most > 0 && lights > most ? lights - most : 0; };
  if (is_by_type(preset)) return over(level.points_in_view(is_flat)) + over(level.spots);
  return over(is_of_view(preset) ? level.in_view(is_flat) : level.lights());
}

double lacking(const Json& result_case) {
  const double needed = number_at(result_case, "/shading/needed").value_or(0.0);
  return needed > 0.0 ? *number_at(result_case, "/shading/missed") / needed : 0.0;
}

bool has_warning(const Json& result_case, const std::string& kind) {
  return std::ranges::any_of(result_case["warnings"], [&](const Json& warning) { return warning["kind"] == kind; });
}

const Json& case_of(const Json& result, const Json& id) {
  return *std::ranges::find_if(result["cases"], [&](const Json& one) { return one["id"] == id; });
}

constexpr double k_most_lacking = 1e-3;
constexpr int k_rounds = test::k_sanitized ? 4 : 24;

TEST_F(RandomPresets, who_lacks_light_at_samples_is_never_taken_and_has_no_star) {
  SplitMix64 random(11);
  int lacking_cases = 0, taken = 0;
  for (int round = 0; round < k_rounds; ++round) {
    const PresetLevel level = preset_level(random);
    const Json result = measured(level, random);
    for (const Json& id : result["pareto_front"][0]["ids"]) {
      EXPECT_LE(lacking(case_of(result, id)), k_most_lacking) << id;
      EXPECT_FALSE(case_of(result, id)["loses_lights"]) << id;
    }
    for (const Json& conclusion : result["conclusions"]) {
      const double share = conclusion["take"].is_null() ? 0.0 : lacking(case_of(result, conclusion["take"]));
      EXPECT_LE(share, k_most_lacking) << conclusion["text"];
    }
    for (const Json& ranking : result["preset_rankings"]) {
      for (const Json& id : ranking["alike"]) EXPECT_LE(lacking(case_of(result, id)), k_most_lacking);
      taken += static_cast<int>(ranking["alike"].size());
      for (const Json& line : ranking["cases"]) {
        const double share = lacking(case_of(result, line["id"]));
        const bool says_none = line["why"].get<std::string>().starts_with("loses nothing");
        EXPECT_FALSE(says_none && share > 0.0) << line["why"];
        if (share <= k_most_lacking) continue;
        ++lacking_cases;
        EXPECT_NE(line["standing"], "lists") << line["preset"];
        EXPECT_NE(line["standing"], "searched") << line["preset"];
      }
    }
  }
  if (!test::k_sanitized) {
    EXPECT_GT(lacking_cases, 5);
    EXPECT_GT(taken, 5);
  }
}

// What `run --presets` says against the level as it was made, and against the figures that `size --engine` goes by.
TEST_F(RandomPresets, all_say_so_exactly_where_there_are_more_lights_in_view_than_they_take) {
  NEEDS(embree);
  SplitMix64 random(12);
  std::set<std::string> beyond, at_limit, below;
  for (int round = 0; round < (test::k_sanitized ? 2 : 30); ++round) {
    const PresetLevel level = level_at_limits(static_cast<std::uint64_t>(round), random);
    const Json result = measured(level, random, k_all_presets);
    for (const Json& one : result["cases"]) {
      const bool is_flat = one["camera"] == "flat";
      ASSERT_EQ(number_at(one, "/lights_in_view/max"), static_cast<double>(level.in_view(is_flat))) << one["name"];
      EXPECT_EQ(number_at(one, "/lights_in_view/max_by_type/spot"), static_cast<double>(level.spots));
      EXPECT_EQ(number_at(one, "/lights"), static_cast<double>(level.lights()));
      const config::Preset& preset = *config::find_preset(one["preset"].get<std::string>());
      const std::uint64_t over = lights_over_limit(preset, level, is_flat);
      EXPECT_EQ(has_warning(one, "too_many_lights"), over > 0) << one["name"] << ": " << over << " too many";
      if (config::most_lights(preset) == 0) continue;
      EXPECT_EQ(value_at(one, "/pre_cull/over_limit/lights")->size(), over) << one["name"];
      const double kept = *number_at(one, "/pre_cull/kept/max");
      const std::uint64_t counted = is_of_view(preset) ? level.in_view(is_flat) : level.lights();
      EXPECT_EQ(kept, static_cast<double>(counted - over)) << one["name"];
      (over > 0 ? beyond : below).insert(preset.name);
      if (counted == config::most_lights(preset)) at_limit.insert(preset.name);
    }
  }
  if (test::k_sanitized) return;
  EXPECT_GE(beyond.size(), 12u);
  EXPECT_EQ(below.size(), beyond.size());
  EXPECT_EQ(at_limit.size(), beyond.size());
}

TEST_F(RandomPresets, lights_before_a_near_plane_of_metres_are_in_no_limit) {
  SplitMix64 random(14);
  PresetLevel level;
  level.seen = 400;
  level.near = 300;
  level.near_m = 5.0;
  const Json result = measured(level, random, k_all_presets);
  for (const Json& one : result["cases"]) {
    if (one["preset"] != "godot") continue;
    EXPECT_FALSE(has_warning(one, "too_many_lights")) << one["name"];
    EXPECT_EQ(number_at(one, "/pre_cull/kept/max"), 400.0) << one["name"];
    EXPECT_FALSE(one["loses_lights"].get<bool>()) << one["name"];
  }
}

// Of a few samples and of many of the same level: who is acquitted by few lacks nothing by many, and who has lists
// without a loss, in cells beyond which no light reaches, is acquitted by few.
TEST_F(RandomPresets, few_samples_acquit_those_whose_cells_hold_all_that_lights_reach_and_no_others) {
  SplitMix64 random(15);
  int acquitted = 0, beyond_cells = 0, open = 0;
  for (int round = 0; round < (test::k_sanitized ? 2 : 12); ++round) {
    PresetLevel level;
    level.seen = 20 + random.below(30);
    level.spots = random.below(20);
    level.beyond = random.below(2) * random.below(20);
    level.beyond_m = 120.0;  // Filament's froxels end at 100 m
    level.is_endless = random.below(2) == 0;
    level.deepest_m = random.between(12.0, 34.0);
    const Json scene = preset_level_json(level, random);
    const Json few = measured(scene, settings_with(120)), many = measured(scene, settings_with(20000));
    for (const Json& ranking : few["preset_rankings"])
      for (const Json& line : ranking["cases"]) {
        const Json &one = case_of(few, line["id"]), &same = *std::ranges::find_if(many["cases"], [&](const Json&other) {
          return other["name"] == one["name"];
        });
        if (number_at(one, "/shading/needed") == 0.0) continue;
        const std::string standing = line["standing"];
        const bool is_acquitted = standing == "lists" || standing == "searched";
        EXPECT_FALSE(is_acquitted && lacking(same) > k_most_lacking) << one["name"] << ": " << line["why"];
        const bool has_all = number_at(one, "/lights_beyond_grid/max") == 0.0 &&
                             number_at(one, "/error/false_negatives") == 0.0 &&
                             one["buffers"]["overflow"]["dropped_pairs"] == 0;
        EXPECT_TRUE(is_acquitted || !has_all) << one["name"] << ": " << line["why"];
        acquitted += is_acquitted ? 1 : 0;
        beyond_cells += is_acquitted && number_at(one, "/shading/unanswered").value_or(0.0) > 0.0 ? 1 : 0;
        open += standing == "unknown" ? 1 : 0;
      }
  }
  if (test::k_sanitized) return;
  EXPECT_GT(acquitted, 50);
  EXPECT_GT(beyond_cells, 20);
  EXPECT_GT(open, 1);
}

TEST_F(RandomPresets, where_no_light_that_shines_is_in_view_nothing_is_taken_or_ranked) {
  SplitMix64 random(13);
  for (const PresetLevel& level :
       {PresetLevel{}, PresetLevel{.behind = 9}, PresetLevel{.seen = 20, .behind = 3, .are_dark = true},
        PresetLevel{.seen = 256, .are_dark = true}, PresetLevel{.near = 9, .near_m = 5.0}}) {
    const Json result = measured(level, random);
    EXPECT_EQ(result["pareto_front"][0]["ids"], Json::array());
    for (const Json& conclusion : result["conclusions"])
      EXPECT_TRUE(conclusion["take"].is_null()) << conclusion["text"];
    for (const Json& ranking : result["preset_rankings"]) {
      EXPECT_TRUE(ranking["best"].is_null());
      for (const Json& line : ranking["cases"]) {
        EXPECT_EQ(line["standing"], "unknown") << line["preset"];
        EXPECT_TRUE(line["place"].is_null()) << line["preset"];
      }
    }
  }
}

}  // namespace
}  // namespace clusterbench::report
