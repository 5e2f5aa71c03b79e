// Lights that are dark are in lists like others, and light nothing: there is nothing to choose by where no others are
// seen.

#include <gtest/gtest.h>

#include "cli/lamps.h"
#include "cli/tool.h"
#include "core/random.h"
#include "effort.h"

namespace clusterbench::test {
namespace {

constexpr const char* k_small = " --viewport 320x180 --grid frustum --tiles 16x9t --assigner aabb,exact-fast";

// Eight dark lights ahead, and some lit ones behind the camera.
std::string dark_level(int lit_behind = 0) {
  std::vector<Lamp> lamps = row_of(8, -1.0, 8);
  for (const Lamp& lamp : row_of(lit_behind, 4.0)) lamps.push_back(lamp);
  return level_of(lamps);
}

void add_lamp(nlohmann::json& level, const nlohmann::json& light, double x_m, double z_m, double y_m = 0.0) {
  nlohmann::json& lights = level["extensions"]["KHR_lights_punctual"]["lights"];
  level["scenes"][0]["nodes"].push_back(level["nodes"].size());
  level["nodes"].push_back(
      {{"translation", {x_m, y_m, z_m}}, {"extensions", {{"KHR_lights_punctual", {{"light", lights.size()}}}}}});
  lights.push_back(light);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(DarkLights, are_nothing_that_a_run_takes_a_clustering_by) {
  const Folder folder;
  for (const int lit_behind : {0, 5}) {
    const std::string level = folder.write("level.gltf", dark_level(lit_behind)).string();
    const Outcome run = tool("run " + level + k_small + " --no-timing -o " + (folder / "result.json").string());
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(contains(run.err, "nothing to take: all lights in view are dark (intensity 0 or black) in all frames"))
        << run.err;
  }
}

TEST(DarkLights, are_told_by_every_command_that_chooses) {
  const Folder folder;
  const std::string
      level = folder.write("level.gltf", level_of(row_of(8, -1.0, 7))).string() + k_small + " --no-timing ",
      told = "warning: level: 7 of 8 lights are dark (intensity 0, black, range 0, or invisible); lists and all";
  for (const std::string& command :
       {"run " + level + "-o " + (folder / "result.json").string(), "recommend " + level}) {
    const Outcome done = tool(command);
    EXPECT_TRUE(contains(done.err, told)) << command << "\n" << done.err;
  }
  EXPECT_FALSE(contains(
      tool("recommend " + folder.write("lit.gltf", level_of(row_of(8, -1.0, 0))).string() + k_small + " --no-timing")
          .err,
      "dark"));
}

TEST(DarkLights, without_a_range_are_said_to_be_in_no_list) {
  const Folder folder;
  nlohmann::json level = nlohmann::json::parse(level_of(row_of(8, -1.0, 3)));
  for (nlohmann::json& light : level["extensions"]["KHR_lights_punctual"]["lights"])
    if (light["intensity"] == 0.0) light.erase("range");
  const Outcome size = tool("size " + folder.write("level.gltf", level.dump()).string() + k_small + " -q");
  EXPECT_TRUE(contains(
      size.err,
      "3 reach nothing (invisible all the time, or of intensity 0 without a range in the file): no list has them"))
      << size.err;
  EXPECT_FALSE(contains(size.err, "engines do not")) << size.err;
  EXPECT_EQ(size.err.find("are dark"), size.err.rfind("are dark")) << "once: " << size.err;
}

// A level of lamps that shine, with a camera that has a far plane or none, or without a camera: a walk around the
// lights.
nlohmann::json random_lit_level(SplitMix64& random) {
  nlohmann::json level = nlohmann::json::parse(level_of({}, random.below(2) == 0));
  level["extensionsUsed"] = {"KHR_lights_punctual"};
  if (random.below(3) == 0) level["nodes"][0].erase("camera");
  for (std::uint64_t i = 0, count = 1 + random.below(12); i < count; ++i)
    add_lamp(level, {{"type", "point"}, {"intensity", 10.0}, {"range", random.between(0.5, 4.0)}},
             random.between(-3.0, 3.0), random.between(-12.0, 2.0));
  return level;
}

// They reach nothing: neither where a grid ends, nor where samples lie, nor what is taken goes by them.
TEST(DarkLights, without_a_range_change_nothing_wherever_they_are) {
  const Folder folder;
  const auto figures = [&](const nlohmann::json& of) {
    const std::string result = (folder / "result.json").string();
    const Outcome run = tool("run " + folder.write("level.gltf", of.dump()).string() +
                             " --viewport 320x180 --grid frustum,distance,cascades,world --tiles 64 --slices 1,8 "
                             "--assigner exact-fast,distance-fast,cascades-fast,world-grid-fast --no-timing -q "
                             "--set samples.opaque.ground=lowest -o " +
                             result);
    EXPECT_EQ(run.code, 0) << run.err;
    const nlohmann::json read = nlohmann::json::parse(file_text(result));
    nlohmann::json out = nlohmann::json::array({read["conclusions"][0]["text"]});
    for (const nlohmann::json& one : read["cases"])
      out.push_back({one["name"], one["grid"], one["occupancy"], one["buffers"]["index_entries"]["high_water"],
                     one["error"]["false_positives"], one["shading"]["needed"], one["shading"]["evaluated"],
                     one["samples"]});
    return out;
  };
  SplitMix64 random(900);
  for (int draw = 0; draw < tries(24); ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    nlohmann::json level = random_lit_level(random);
    const nlohmann::json without = figures(level);
    for (std::uint64_t i = 0, count = 1 + random.below(3); i < count; ++i) {
      const double far_m = random.below(2) == 0 ? 10.0 : 2000.0;
      add_lamp(level, {{"type", "point"}, {"intensity", 0.0}}, random.between(-far_m, far_m),
               random.between(-far_m, far_m), random.between(-far_m, far_m));
    }
    EXPECT_EQ(figures(level), without) << level;
  }
}

// Lights that shine, but behind the camera: slices and samples end where those in view do.
TEST(LightsOutOfView, change_neither_where_slices_end_nor_where_samples_lie) {
  const Folder folder;
  const auto figures = [&](const nlohmann::json& of) {
    const std::string result = (folder / "result.json").string();
    const Outcome run = tool("run " + folder.write("level.gltf", of.dump()).string() +
                             " --viewport 320x180 --grid frustum,distance --tiles 64 --slices 8 --assigner "
                             "exact-fast,distance-fast --no-timing -q --set 'samples.fog={}' -o " +
                             result);
    EXPECT_EQ(run.code, 0) << run.err;
    const nlohmann::json read = nlohmann::json::parse(file_text(result));
    nlohmann::json out = nlohmann::json::array();
    for (const nlohmann::json& one : read["cases"])
      out.push_back({one["name"], one["grid"], one["occupancy"], one["shading"], one["samples"]});
    EXPECT_EQ(out.size(), 2u);
    return out;
  };
  SplitMix64 random(50);
  for (int draw = 0; draw < tries(16); ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    nlohmann::json level = nlohmann::json::parse(level_of({}, random.below(2) == 0));
    level["extensionsUsed"] = {"KHR_lights_punctual"};
    for (std::uint64_t i = 0, count = 1 + random.below(8); i < count; ++i)
      add_lamp(level, {{"type", "point"}, {"range", random.between(0.5, 4.0)}}, random.between(-2.0, 2.0),
               random.between(-12.0, -2.0));
    const nlohmann::json without = figures(level);
    add_lamp(level, {{"type", "point"}, {"range", 3.0}}, random.between(-9.0, 9.0), random.between(4.0, 5000.0));
    EXPECT_EQ(figures(level), without) << level;
  }
}

TEST(DarkLights, are_nothing_that_presets_are_ranked_by) {
  const Folder folder;
  const std::string level = folder.write("level.gltf", dark_level()).string();
  const Outcome run = tool("run " + level + " --preset filament --preset olsson-2012 --viewport 320x180 --no-timing " +
                           "--set samples.opaque.ground=lowest -o " + (folder / "result.json").string());
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(contains(run.err, "all lights in view are dark (intensity 0 or black) in all frames")) << run.err;
  EXPECT_FALSE(contains(run.err, ": take ")) << run.err;
  const nlohmann::json result = nlohmann::json::parse(file_text(folder / "result.json"));
  EXPECT_TRUE(result["preset_rankings"][0]["best"].is_null());
}

TEST(DarkLights, are_nothing_that_recommend_chooses_by) {
  const Folder folder;
  const std::string dark = folder.write("dark.gltf", dark_level(5)).string();
  const Outcome none = tool("recommend " + dark + k_small + " --no-timing -q");
  EXPECT_EQ(none.code, 1) << none.out;
  EXPECT_TRUE(contains(none.out, "all lights in view are dark (intensity 0 or black) in all frames")) << none.out;
  const std::string lit = folder.write("lit.gltf", level_of(row_of(8, -1.0, 7))).string();
  EXPECT_EQ(tool("recommend " + lit + k_small + " --no-timing -q").code, 0) << "one of them shines";
}

// Two cameras: what a cellar of dark lights looks like is nothing to choose for the street above it by.
TEST(DarkLights, of_one_camera_have_no_part_in_what_others_are_given) {
  const Folder folder;
  nlohmann::json level = nlohmann::json::parse(level_of(row_of(6)));
  const std::string alone = folder.write("alone.gltf", level.dump()).string();
  for (int i = 0; i < 40; ++i)
    add_lamp(level, {{"type", "point"}, {"range", 3.0}, {"intensity", 0.0}}, 500.0 + 0.1 * i, -4.0);
  level["scenes"][0]["nodes"].push_back(level["nodes"].size());
  level["nodes"].push_back({{"name", "cellar"}, {"camera", 0}, {"translation", {502.0, 0.0, 0.0}}});
  const std::string both = folder.write("both.gltf", level.dump()).string();
  const auto answer = [&](const std::string& file) {
    const Outcome done =
        tool("recommend " + file + k_small + " --no-timing -q --set storages=packed --set 'scenes.*.camera=*' -o -");
    EXPECT_EQ(done.code, 0) << done.err;
    return nlohmann::json::parse(done.out)["answers"][0];
  };
  const nlohmann::json of_both = answer(both);
  EXPECT_EQ(of_both["blind_cameras"], nlohmann::json::array({"cellar"}));
  const nlohmann::json of_one = answer(alone);  // whose random points reach less deep, since no light is so far away
  EXPECT_EQ(of_both["choice"]["name"], of_one["choice"]["name"]);
  for (const char* figure : {"bytes", "index_entries", "longest", "pairs"})
    EXPECT_EQ(of_both["choice"]["figures"][figure], of_one["choice"]["figures"][figure]) << figure;
  const Outcome told = tool("recommend " + both + k_small + " --no-timing -q --set 'scenes.*.camera=*'");
  EXPECT_TRUE(contains(told.out, "Without camera cellar, in whose frames no light that shines is in view")) << told.out;
  EXPECT_TRUE(contains(told.err, "40 of 46 lights are dark")) << "with -q, too: " << told.err;
  const Outcome size =
      tool("size " + both + k_small + " -q --worst-case --evaluations 40 --set 'scenes.*.camera=cellar'");
  EXPECT_TRUE(contains(size.out, " lights in view are dark")) << size.out;
}

TEST(DarkLights, are_sized_with_a_warning) {
  const Folder folder;
  const std::string level = folder.write("level.gltf", dark_level()).string();
  const std::string warning =
      "warning: level, camera camera: all lights in view are dark (intensity 0 or black) in all "
      "frames; lists have them all the same, so these are sizes for when they are switched on";
  for (const char* format : {"table", "cpp", "json"}) {
    const Outcome size = tool("size " + level + k_small + " -q --format " + format);
    EXPECT_EQ(size.code, 0) << size.err;
    EXPECT_TRUE(contains(size.err, warning)) << size.err;
  }
  const std::string lit = folder.write("level.gltf", level_of(row_of(8, -1.0, 7))).string();
  const std::string some = tool("size " + lit + k_small + " -q").err;
  EXPECT_FALSE(contains(some, "all lights in view are dark")) << some;
  EXPECT_TRUE(contains(some, "warning: level: 7 of 8 lights are dark (intensity 0, black, range 0, or invisible)"))
      << some;
}

// Random points: lit, dark or black, with a range or without, ahead or behind.
struct RandomLamps {
  nlohmann::json level, listed;  // the same without those that no list can have
  int all = 0, dark = 0, without_range = 0;
};

RandomLamps random_lamps(SplitMix64& random) {
  RandomLamps out;
  out.level = out.listed = nlohmann::json::parse(level_of({}));
  for (nlohmann::json* level : {&out.level, &out.listed}) (*level)["extensionsUsed"] = {"KHR_lights_punctual"};
  out.all = 1 + static_cast<int>(random.below(12));
  for (int i = 0; i < out.all; ++i) {
    nlohmann::json light{{"type", "point"}, {"intensity", random.below(2) * 10.0}};
    if (random.below(4) == 0) light["color"] = {0.0, 0.0, 0.0};
    if (random.below(2) == 0) light["range"] = random.between(0.5, 4.0);
    const bool is_dark = light["intensity"] == 0.0 || light.contains("color"), has_range = light.contains("range");
    if (is_dark) ++out.dark;
    if (is_dark && !has_range) ++out.without_range;
    const double x_m = random.between(-2.0, 2.0), z_m = random.between(-12.0, 4.0);
    add_lamp(out.level, light, x_m, z_m);
    if (!is_dark || has_range) add_lamp(out.listed, light, x_m, z_m);
  }
  return out;
}

TEST(DarkLights, at_random_are_counted_where_they_are_said_to_be) {
  const Folder folder;
  SplitMix64 random(44);
  for (int draw = 0; draw < tries(16); ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    const RandomLamps lamps = random_lamps(random);
    const auto measured = [&](const nlohmann::json& level) {
      const std::string file = folder.write("level.gltf", level.dump()).string(),
                        result = (folder / "result.json").string();
      const Outcome run = tool("run " + file + k_small + " --no-timing -o " + result);
      EXPECT_EQ(run.code, 0) << run.err;
      return std::pair(run.err, nlohmann::json::parse(file_text(result)));
    };
    const auto [told, result] = measured(lamps.level);
    EXPECT_EQ(result["scenes"][0]["lights"]["dark"], lamps.dark);
    const std::string all = std::to_string(lamps.dark) + " of " + std::to_string(lamps.all) + " light",
                      unlisted = lamps.without_range == 1 ? "1 reaches nothing"
                                                          : std::to_string(lamps.without_range) + " reach nothing";
    EXPECT_EQ(contains(told, all), lamps.dark > 0) << told;
    EXPECT_EQ(contains(told, unlisted), lamps.without_range > 0) << told;
    EXPECT_EQ(contains(told, "count those with a range"), lamps.without_range < lamps.dark) << told;
    const nlohmann::json listed = measured(lamps.listed).second;
    for (std::size_t i = 0; i < result["cases"].size(); ++i)
      for (const char* figure : {"/buffers/index_entries/high_water", "/lights_seen", "/lights_in_view/max"})
        EXPECT_EQ(result["cases"][i].at(nlohmann::json::json_pointer(figure)),
                  listed["cases"][i].at(nlohmann::json::json_pointer(figure)))
            << figure << " of " << result["cases"][i]["name"];
  }
}

}  // namespace
}  // namespace clusterbench::test
