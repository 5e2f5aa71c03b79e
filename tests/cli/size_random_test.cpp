// What `size` prints of random levels, held against what each of their frames needs.

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>

#include "cli/sizing/size_counting.h"
#include "cli/tool.h"
#include "core/random.h"
#include "effort.h"
#include "measure/lists/lights_in_view_counts.h"
#include "report/size_report/engine_settings.h"
#include "report/size_report/size_report.h"
#include "run/cases/path_frames.h"
#include "scene/gltf_fixture.h"
#include "search/frame_measure.h"

namespace clusterbench {
namespace {

using RandomJson = nlohmann::json;

// A level of no lights, few, or as many as engines and indices of a byte stop at; points and spots. One to three
// cameras, which move together but for some that stand still, and views of some of them.
struct RandomLevel {
  RandomJson gltf;
  std::vector<std::string> views;
  int lights = 0;
};

RandomJson random_light(SplitMix64& random) {
  RandomJson light{{"type", random.below(3) == 0 ? "spot" : "point"}, {"range", random.between(0.5, 6.0)}};
  if (light["type"] == "spot") light["spot"] = {{"outerConeAngle", random.between(0.1, 1.5)}};
  return light;
}

RandomJson random_place(SplitMix64& random, double metres) {
  return {random.between(-metres, metres), random.between(-2.0, 2.0), random.between(-metres, metres)};
}

RandomLevel random_level(std::uint64_t number, SplitMix64& random) {
  const std::uint64_t counts[] = {0, 1 + random.below(6), 254 + random.below(4)};
  const char* names[] = {"a", "b", "c"};
  RandomLevel out;
  out.lights = static_cast<int>(counts[number % 3]);
  const std::uint64_t cameras = 1 + random.below(3);
  const double spread_m = random.below(2) == 0 ? 1.0 : 12.0;  // all in view at once, or some
  RandomJson nodes = RandomJson::array({{{"name", "moving"}, {"children", RandomJson::array()}}}),
             lights = RandomJson::array(), roots = {0};
  for (std::uint64_t i = 0; i < cameras; ++i) {
    const bool stands_still = random.below(4) == 0;
    (stands_still ? roots : nodes[0]["children"]).push_back(nodes.size());
    const double half_turn = random.between(0.0, 3.1);
    nodes.push_back({{"name", names[i]},
                     {"camera", 0},
                     {"translation", random_place(random, 4.0)},
                     {"rotation", {0.0, std::sin(half_turn), 0.0, std::cos(half_turn)}}});
  }
  if (nodes[0]["children"].empty()) nodes[0].erase("children");
  for (int i = 0; i < out.lights; ++i) {
    roots.push_back(nodes.size());
    nodes.push_back(
        {{"translation", random_place(random, spread_m)}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    lights.push_back(random_light(random));
  }
  const scene::test::Animation walk =
      scene::test::animation("translation", "LINEAR", {0, 4, 9}, {0, 0, 0, 5, 1, -5, -6, 0, 8});
  out.gltf = RandomJson::parse(scene::test::document(walk.text()));
  out.gltf.update({{"nodes", nodes}, {"scene", 0}, {"scenes", {{{"nodes", roots}}}}});
  out.gltf["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}, {"zfar", 40.0}}}}};
  if (out.lights > 0) out.gltf["extensionsUsed"] = {"KHR_lights_punctual"};
  if (out.lights > 0) out.gltf["extensions"] = {{"KHR_lights_punctual", {{"lights", lights}}}};
  if (cameras > 1 && random.below(3) > 0) out.views = {random.below(2) == 0 ? "a,b" : "*"};
  return out;
}

RandomJson random_config(SplitMix64& random) {
  RandomJson config = RandomJson::parse(R"({"scenes": [{"path": "level.gltf", "camera": "*", "frames": 6}],
    "viewport": [320, 180], "shading": {"samples": 0}, "limits": {"dropped_pairs": null},
    "grids": [{"kind": "frustum", "tiles": {"count": [8, 5]},
               "slices": {"scheme": "exponential", "count": 6, "near": 0.1, "far": 30}},
              {"kind": "world", "cells": [5, 2, 6]}],
    "assigners": ["exact-fast", "world-grid-fast", "z-binning"],
    "storages": ["packed", {"name": "packed", "headers": "sparse"}, {"name": "fixed", "cap": 3},
                 {"name": "fixed", "cap": 300, "counts": "none"}, "bitfield", "linked", "runs"]})");
  if (random.below(3) == 0) config["pre_cull"] = {"frustum"};
  return config;
}

cli::RunInputs inputs_of(const std::string& path, const std::vector<std::pair<std::string, std::string>>& flags = {}) {
  cli::RunInputs inputs;
  inputs.paths = {path};
  for (const auto& [name, value] : flags)
    for (std::size_t i = 0; i < inputs.settings.size(); ++i)
      if (config::config_flags()[i].name == name) inputs.settings[i].push_back(value);
  return inputs;
}

// What a frame of a camera needs of each buffer.
using FrameNeeds = std::vector<assign::BufferNeed>;

std::vector<FrameNeeds> needs_along(const cli::SizeCounts& counts, const std::string& case_name) {
  std::vector<FrameNeeds> out;
  for (const run::GroupPlan& group : counts.plan.groups)
    for (const run::CasePlan& case_plan : group.cases) {
      if (case_plan.name != case_name) continue;
      const run::PathFrames path = run::path_of(counts.config, counts.plan, group);
      search::FrameMeter meter(counts.config, case_plan, search::Measure::entries);
      for (int frame = 0; frame < path.count(); ++frame) {
        meter.value(path, frame);
        out.push_back(meter.buffers());
      }
    }
  return out;
}

// Of cameras that are drawn into one buffer: the sum, or where each cell has the same room the longest list for all.
std::uint64_t need_together(const std::vector<const std::vector<FrameNeeds>*>& cameras, std::size_t buffer,
                            std::size_t frame) {
  std::uint64_t sum = 0, cells = 0, longest = 0;
  for (const std::vector<FrameNeeds>* frames : cameras) {
    const assign::BufferNeed& need = (*frames)[std::min(frame, frames->size() - 1)][buffer];
    sum += need.elements;
    cells += need.step;
    longest = std::max(longest, need.elements / need.step);
  }
  return cells > cameras.size() ? cells * longest : sum;
}

std::vector<std::vector<std::string>> groups_of(const RandomJson& structure) {
  std::vector<std::vector<std::string>> groups = structure.value("views", std::vector<std::vector<std::string>>{});
  for (const std::string camera : structure["cameras"])
    if (std::ranges::none_of(groups, [&](const auto& group) { return std::ranges::count(group, camera) > 0; }))
      groups.push_back({camera});
  return groups;
}

// Every frame of every group of cameras fits, and the spread of a group is that of its own frames.
void hold_against_frames(const RandomJson& structure, const cli::SizeCounts& counts) {
  const auto name = structure["name"].get<std::string>(), scene = structure["scene"].get<std::string>();
  // A path's structures have words for the most lights that a cull leaves in any of its frames, and here a frame's own.
  const bool is_culled = !counts.config.pre_culls.front().is_none();
  const auto is_as_told = [&](const RandomJson& told, std::uint64_t need) {
    return is_culled ? told >= need : told == need;
  };
  std::map<std::string, std::vector<FrameNeeds>> by_camera;
  for (const RandomJson& camera : structure["cameras"])
    by_camera[camera] = needs_along(counts, scene + "/" + camera.get<std::string>() + name.substr(scene.size()));
  for (std::size_t i = 0; i < structure["buffers"].size(); ++i) {
    const RandomJson& buffer = structure["buffers"][i];
    std::uint64_t most = 0;
    for (const std::vector<std::string>& group : groups_of(structure)) {
      std::vector<const std::vector<FrameNeeds>*> cameras;
      std::size_t frames = 0;
      for (const std::string& camera : group) {
        cameras.push_back(&by_camera[camera]);
        frames = std::max(frames, cameras.back()->size());
      }
      ASSERT_GT(frames, 0u) << name;
      std::vector<std::uint64_t> needs;
      for (std::size_t frame = 0; frame < frames; ++frame) needs.push_back(need_together(cameras, i, frame));
      const auto [least, greatest] = std::ranges::minmax(needs);
      most = std::max(most, greatest);
      EXPECT_GE(buffer["capacity"], greatest) << name << " " << buffer;
      for (const RandomJson& told : buffer.value("groups", RandomJson::array())) {
        if (told["cameras"] != RandomJson(group)) continue;
        EXPECT_TRUE(is_as_told(told["high_water"], greatest)) << name << " " << buffer;
        EXPECT_TRUE(is_as_told(told["frames"]["min"], least)) << name << " " << buffer;
        EXPECT_EQ(told["count"], frames) << name;
      }
    }
    EXPECT_TRUE(is_as_told(buffer["high_water"], most)) << name << " " << buffer;
    EXPECT_GE(buffer["bytes"], buffer["capacity"].get<std::uint64_t>() * buffer["element_bytes"].get<std::uint64_t>());
    EXPECT_GE(buffer["capacity"], buffer["warn_above"]);
  }
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

// The table's rows of a structure, its buffers' first words, in the words of the JSON.
void hold_table_against(const RandomJson& structure, const std::string& table) {
  const auto name = structure["name"].get<std::string>();
  const std::size_t begin = table.find(name + "  (");
  ASSERT_NE(begin, std::string::npos) << name;
  std::istringstream lines(table.substr(begin, table.find("\n\n", begin) - begin));
  std::string line;
  std::getline(lines, line);  // the name
  std::getline(lines, line);  // the headings
  for (const RandomJson& buffer : structure["buffers"]) {
    std::getline(lines, line);
    const std::vector<std::string> words = words_of(line);
    ASSERT_GE(words.size(), 12u) << line;
    const std::size_t n = words.size(), high_water = n - (words[n - 6] == "%" ? 8 : 7);
    EXPECT_EQ(words[0], buffer["name"].get<std::string>());
    EXPECT_EQ(words[1], buffer["frames"]["min"].dump()) << line;
    EXPECT_EQ(words[2], buffer["frames"]["p50"].dump()) << line;
    EXPECT_EQ(words[high_water], buffer["high_water"].dump()) << line;
    EXPECT_EQ(words[n - 5], buffer["capacity"].dump()) << line;
    EXPECT_EQ(words[n - 2], buffer["bytes"].dump()) << line;
    EXPECT_EQ(words[n - 1], buffer["double_buffered_bytes"].dump()) << line;
  }
  const bool says_nothing = table.substr(begin, table.find("\n\n", begin) - begin).find("  NO LI") != std::string::npos;
  EXPECT_EQ(says_nothing, !structure["nothing_seen"].is_null()) << name;
}

void hold_constants_against(const RandomJson& structure, const std::string& hlsl) {
  for (const RandomJson& buffer : structure["buffers"])
    for (const char* what : {"capacity", "warn_above", "bytes", "element_bytes"}) {
      const std::string line = "static const uint " + buffer["identifier"].get<std::string>() + "_" + what + " = " +
                               buffer[what].dump() + "u;\n";
      EXPECT_NE(hlsl.find(line), std::string::npos) << line;
    }
}

std::uint64_t most_in_view(const cli::SizeCounts& counts) {
  measure::LightsInView in_view;
  for (const run::GroupPlan& group : counts.plan.groups) {
    const run::PathFrames path = run::path_of(counts.config, counts.plan, group);
    for (int frame = 0; frame < path.count(); ++frame) measure::add_frame(in_view, path.frame(frame));
  }
  return in_view.most;
}

TEST(SizeOfRandomLevels, holds_what_every_frame_needs_and_says_the_same_in_every_format) {
  const test::Folder folder;
  SplitMix64 random(2024);
  for (int draw = 0; draw < test::tries(16); ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    const RandomLevel level = random_level(static_cast<std::uint64_t>(draw), random);
    folder.write("level.gltf", level.gltf.dump());
    const std::string config = folder.write("config.json", random_config(random).dump()).string();
    auto plan = cli::plan_for_size(inputs_of(config), "", true, "");
    const auto counts = cli::counted_for_size(std::move(*plan), true);
    report::SizeRequest request{"", true, "json", random.below(2) == 0 ? "page" : "none"};
    request.margin = random.between(1.0, 2.0);
    request.scope.views = level.views;
    const RandomJson structures = RandomJson::parse(report::size_report(counts->result, request))["structures"];
    request.format = "table";
    const std::string table = report::size_report(counts->result, request);
    request.format = "hlsl";
    const std::string hlsl = report::size_report(counts->result, request);
    const std::uint64_t in_view = most_in_view(*counts);
    EXPECT_GE(structures.size(), 15u);
    for (const RandomJson& structure : structures) {
      hold_against_frames(structure, *counts);
      hold_table_against(structure, table);
      hold_constants_against(structure, hlsl);
      EXPECT_TRUE(in_view > 0 || !structure["nothing_seen"].is_null()) << structure["name"];
    }
  }
}

TEST(SizeOfRandomLevels, settings_of_engines_hold_what_every_frame_needs_or_say_that_it_is_too_much) {
  const test::Folder folder;
  SplitMix64 random(77);
  const std::vector<std::string> engines = report::engines_with_settings();
  for (int draw = 0; draw < test::tries(14); ++draw) {
    const std::string engine = engines[static_cast<std::size_t>(draw) % engines.size()];
    SCOPED_TRACE("draw " + std::to_string(draw) + " of " + engine);
    const RandomLevel level = random_level(static_cast<std::uint64_t>(draw) + 1, random);
    const std::string scene = folder.write("level.gltf", level.gltf.dump()).string();
    auto plan = cli::plan_for_size(inputs_of(scene, {{"--preset", engine},
                                                     {"--viewport", "320x180"},
                                                     {"--set", "scenes.*.frames=3"},
                                                     {"--set", "shading.samples=0"}}),
                                   "", true, engine);
    const auto counts = cli::counted_for_size(std::move(*plan), true);
    report::SizeRequest request{"", true, "json"};
    request.engine = engine;
    request.scope.grown = counts->grown;
    const RandomJson structure = RandomJson::parse(report::size_report(counts->result, request))["structures"][0];
    request.format = "table";
    const std::string told = report::size_report(counts->result, request);
    for (const RandomJson& limit : structure["settings"]["limits"]) {
      const auto seen = limit["seen"].get<std::uint64_t>();
      if (limit["needed"] == "lights in view") {
        EXPECT_EQ(seen, most_in_view(*counts));
      }
      if (limit["needed"] == "lights in the scene") {
        EXPECT_EQ(seen, static_cast<std::uint64_t>(level.lights));
      }
      EXPECT_EQ(limit["is_too_much"], !limit["most"].is_null() && limit["most"] < seen) << limit;
      EXPECT_NE(told.find("the most seen: " + std::to_string(seen) + " " + limit["needed"].get<std::string>()),
                std::string::npos)
          << told;
      if (limit["value"].is_null()) continue;
      EXPECT_TRUE(limit["is_too_much"] || limit["value"] >= seen) << limit;
      EXPECT_NE(told.find(limit["name"].get<std::string>() + ": " + limit["value"].dump()), std::string::npos) << told;
    }
    EXPECT_EQ(structure["nothing_seen"].is_null(), told.find("  NO LI") == std::string::npos) << told;
  }
}

// Of the first buffer: what `worst-case` finds that one camera needs, in a file for --found.
std::uint64_t searched(const std::string& flags, const std::string& camera, std::uint64_t seed,
                       const std::string& file) {
  const test::Outcome done = test::tool("worst-case -q --random 0 --evaluations 12 --seed " + std::to_string(seed) +
                                        " --filter level/" + camera + "/ -o " + file + flags);
  EXPECT_EQ(done.code, 0) << done.err;
  return RandomJson::parse(test::file_text(file))["buffers"][0]["elements"];
}

// Some with room for all that there can be, some that are full in nearly every frame.
constexpr const char* k_searched_storages[] = {"packed",
                                               R"([{"name":"linked","nodes_per_cell":0.5}])",
                                               R"([{"name":"packed","max_entries":40}])",
                                               R"([{"name":"fixed","cap":2}])",
                                               "bitfield",
                                               "runs"};

TEST(SizeOfRandomLevels, finds_from_files_and_of_its_own_count_for_each_camera_and_add_up_for_views) {
  constexpr std::uint64_t k_cells = 8 * 5 * 6;
  const test::Folder folder;
  SplitMix64 random(5);
  for (int draw = 0; draw < test::tries(24); ++draw) {
    const std::string storage = k_searched_storages[static_cast<std::size_t>(draw) % std::size(k_searched_storages)];
    const bool has_equal_cells = storage.find("fixed") != std::string::npos;
    SCOPED_TRACE("draw " + std::to_string(draw) + " of " + storage);
    const RandomLevel level = random_level(1 + 3 * random.below(20), random);  // few lights
    const std::string scene = folder.write("level.gltf", level.gltf.dump()).string(),
                      flags =
                          " --viewport 320x180 --grid frustum --tiles 8x5t --slices 6 --assigner exact-fast "
                          "--set 'scenes.*.frames=3' --set 'scenes.*.camera=*' --set 'storages=" +
                          storage + "' " + scene,
                      sought = has_equal_cells ? " --measure longest" + flags : flags;
    std::map<std::string, std::uint64_t> most;
    std::string files;
    for (const RandomJson& node : level.gltf["nodes"]) {
      if (!node.contains("camera")) continue;
      const std::string camera = node["name"];
      most[camera] = searched(sought, camera, 1, (folder / "found.json").string());
      if (random.below(2) == 0) continue;
      const std::string file = (folder / (camera + ".json")).string();
      most[camera] = std::max(most[camera], searched(sought, camera, 2 + random.below(9), file));
      files += " --found " + file;
    }
    std::string views;
    for (const std::string& view : level.views) views += " --views '" + view + "'";
    const test::Outcome done = test::tool(
        "size -q --worst-case --evaluations 12 --format json --margin 1 --round none" + views + files + flags);
    ASSERT_EQ(done.code, 0) << done.err;
    const RandomJson structure = RandomJson::parse(done.out)["structures"][0];
    const RandomJson& buffer = structure["buffers"][0];
    std::uint64_t found = 0;
    for (const std::vector<std::string>& group : groups_of(structure)) {
      std::uint64_t sum = 0, longest = 0;
      for (const std::string& camera : group) {
        sum += most.at(camera);
        longest = std::max(longest, most.at(camera) / k_cells);
      }
      found = std::max(found, has_equal_cells ? k_cells * group.size() * longest : sum);
    }
    EXPECT_EQ(buffer["found"], found) << level.gltf << views << files;
    EXPECT_GE(buffer["capacity"], std::max(found, buffer["high_water"].get<std::uint64_t>()));
    // Recorded frames are among those that are tried.
    EXPECT_TRUE(!level.views.empty() || buffer["found"] >= buffer["high_water"]) << level.gltf << files;
  }
}

}  // namespace
}  // namespace clusterbench
