// Presets and conclusions on random levels with as many lights as engines take, one more, one less, or none: what is
// taken never lacks light, and who has a limit says when a level is beyond it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "config/presets.h"
#include "core/random.h"
#include "effort.h"
#include "report/json_values.h"
#include "report/result_json.h"
#include "run/runner.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// A camera with a perspective and an orthographic one whose view begins at depth 0, at the same place. Lights are well
// in view of both, or far behind both.
struct PresetLevel {
  std::uint64_t seen = 0, behind = 0;
  bool are_dark = false;
};

Json preset_level_json(const PresetLevel& level, SplitMix64& random) {
  const Json perspective{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}, {"zfar", 40.0}}}};
  const Json flat{{"type", "orthographic"},
                  {"orthographic", {{"xmag", 8.0}, {"ymag", 4.5}, {"znear", 0.0}, {"zfar", 40.0}}}};
  Json nodes = Json::array({{{"name", "deep"}, {"camera", 0}}, {{"name", "flat"}, {"camera", 1}}});
  const auto add = [&](double x, double y, double z) {
    nodes.push_back({{"translation", {x, y, z}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  };
  for (std::uint64_t i = 0; i < level.seen; ++i)
    add(random.between(-3.0, 3.0), random.between(-2.0, 2.0), random.between(-30.0, -8.0));
  for (std::uint64_t i = 0; i < level.behind; ++i) add(random.between(-5.0, 5.0), 0.0, random.between(400.0, 900.0));
  Json all = Json::array();
  for (std::size_t i = 0; i < nodes.size(); ++i) all.push_back(i);
  const Json lamp{{"type", "point"}, {"range", 2.0}, {"intensity", level.are_dark ? 0.0 : 50.0}};
  Json out{{"asset", {{"version", "2.0"}}},
           {"scene", 0},
           {"scenes", Json::array({{{"nodes", all}}})},
           {"nodes", nodes},
           {"cameras", {perspective, flat}}};
  if (level.seen + level.behind == 0) return out;
  out["extensionsUsed"] = Json::array({"KHR_lights_punctual"});
  out["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({lamp});
  return out;
}

// All in a few milliseconds at this size; those with limits by lights in view, by lights of the scene, and without; and
// clusterings of its own that lose lights: a grid that ends too early, and lists that are too short.
constexpr const char* k_settings =
    R"("viewport": [64, 36], "presets": ["just-cause-2", "humus", "doom-2016", "filament",
    "bevy", "playcanvas", "ogre-next"], "grids": [{"kind": "frustum", "tiles": {"count": [4, 3]},
    "slices": {"scheme": "linear", "count": 4, "near": 0.5, "far": [12, 45]}}], "assigners": ["exact-fast"],
    "storages": ["packed", {"name": "fixed", "cap": 6}], "limits": {"dropped_pairs": null},
    "timing": {"measure": false}, "shading": {"samples": 3000})";

class RandomPresets : public ::testing::Test {
 protected:
  ~RandomPresets() override { std::filesystem::remove_all(folder_); }

  Json measured(const PresetLevel& level, SplitMix64& random) const {
    std::filesystem::create_directories(folder_);
    const std::filesystem::path file = folder_ / "level.gltf";
    std::ofstream(file) << preset_level_json(level, random).dump();
    const config::Config config = config::parse_config(
        R"({"scenes": [{"path": ")" + file.string() + R"(", "camera": "*"}], )" + k_settings + "}", "c.json");
    const run::Plan plan = run::make_plan(config, "");
    return result_to_json(run::run_plan(config, plan, {}, {}, std::atomic<bool>{false}), {});
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("clusterbench-presets-" + std::to_string(::getpid()));
};

// Around the limits, and few enough that samples say little.
PresetLevel preset_level(SplitMix64& random) {
  constexpr std::uint64_t k_counts[] = {0, 1, 12, 127, 128, 129, 254, 255, 256, 257};
  return {k_counts[random.below(std::size(k_counts))], random.below(2) * random.below(20), random.below(8) == 0};
}

// Whether a limit counts the lights of the view, and not those of the scene.
bool is_of_view(const config::Preset& preset) {
  const Json parts = Json::parse(preset.parts);
  return std::ranges::any_of(parts.value("pre_cull", Json::array()),
                             [](const Json& step) { return step == "frustum"; });
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

TEST_F(RandomPresets, presets_say_so_exactly_where_there_are_more_lights_than_they_take) {
  SplitMix64 random(12);
  int beyond = 0, at_limit = 0;
  for (int round = 0; round < k_rounds; ++round) {
    const PresetLevel level = preset_level(random);
    const Json result = measured(level, random);
    for (const Json& one : result["cases"]) {
      EXPECT_EQ(number_at(one, "/lights_in_view/max"), static_cast<double>(level.seen));
      if (!one.contains("preset")) continue;
      const config::Preset& preset = *config::find_preset(one["preset"].get<std::string>());
      const std::uint64_t most = config::most_lights(preset);
      const std::uint64_t lights = level.seen + (is_of_view(preset) ? 0 : level.behind);
      EXPECT_EQ(has_warning(one, "too_many_lights"), most > 0 && lights > most)
          << preset.name << " takes " << most << ", and there are " << lights;
      beyond += most > 0 && lights > most ? 1 : 0;
      at_limit += lights == most ? 1 : 0;
    }
  }
  if (!test::k_sanitized) {
    EXPECT_GT(beyond, 5);
    EXPECT_GT(at_limit, 1);
  }
}

TEST_F(RandomPresets, where_no_light_that_shines_is_in_view_nothing_is_taken_or_ranked) {
  SplitMix64 random(13);
  for (const PresetLevel& level :
       {PresetLevel{0, 0, false}, PresetLevel{0, 9, false}, PresetLevel{20, 3, true}, PresetLevel{256, 0, true}}) {
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
