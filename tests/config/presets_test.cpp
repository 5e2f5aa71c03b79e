#include "config/presets.h"

#include <gtest/gtest.h>

#include <set>

#include "assign/contract/assigner.h"
#include "config/config.h"
#include "config/grid_json.h"
#include "core/error.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

Config with_presets(const std::string& rest, const std::vector<FlagValue>& flags = {}) {
  return parse_config(R"({"scenes": ["a.glb"])" + rest + "}", "c.json", flags);
}

// The grid as it is resolved for a viewport, the method and the storage of the only preset.
struct Resolved {
  Json grid;
  MethodRequest assigner;
  std::optional<MethodRequest> storage;
};

Resolved resolved(const std::string& name, const std::string& viewport = "[1920, 1080]") {
  const Config config = with_presets(R"(, "viewport": )" + viewport + R"(, "presets": [")" + name + R"("])");
  EXPECT_EQ(config.presets.size(), 1u) << name;
  const PresetChoice& choice = config.presets.at(0);
  Resolved out{Json::parse(grid_request(config.grids.at(choice.grid)).dump()), config.assigners.at(choice.assigner),
               std::nullopt};
  if (choice.storage) out.storage = config.storages.at(*choice.storage);
  return out;
}

std::string refusal_of(const std::string& rest, const std::vector<FlagValue>& flags = {}) {
  try {
    with_presets(rest, flags);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Presets, there_is_one_for_every_row_of_the_table_of_engines) {
  const std::vector<std::string> rows{
      "just-cause-3", "just-cause-2", "humus",     "ortegren-persson", "daveh355",   "black-mesa", "wicked",
      "filament",     "bevy",         "godot",     "three-js",         "playcanvas", "babylon",    "unity-urp",
      "unity-hdrp",   "unreal",       "doom-2016", "call-of-duty-iw",  "olsson-2012"};
  EXPECT_EQ(preset_names(), rows);
}

TEST(Presets, each_says_where_it_comes_from_and_takes_a_method_that_takes_its_grid) {
  for (const Preset& preset : presets()) {
    EXPECT_FALSE(std::string(preset.source).empty() || std::string(preset.summary).empty()) << preset.name;
    const Config config = with_presets(std::string(R"(, "presets": [")") + preset.name + R"("])");
    ASSERT_EQ(config.presets.size(), 1u);
    const PresetChoice& choice = config.presets[0];
    const assign::AssignerDescriptor& method = *assign::find_assigner(config.assigners[choice.assigner].name);
    EXPECT_TRUE(method.takes(config.grids[choice.grid].kind)) << preset.name;
    EXPECT_TRUE(method.answers(choice.storage ? assign::Answer::lists : assign::Answer::structure)) << preset.name;
  }
}

TEST(Presets, those_of_engines_that_make_lists_in_a_shader_or_by_rasterisation_say_that_these_are_not_uploaded) {
  for (const char* name : {"three-js", "wicked", "godot", "unity-hdrp", "unreal", "call-of-duty-iw", "daveh355"})
    EXPECT_EQ(find_preset(name)->assigns_on, AssignsOn::gpu) << name;
  for (const char* name : {"filament", "bevy", "playcanvas", "unity-urp", "just-cause-3"})
    EXPECT_EQ(find_preset(name)->assigns_on, AssignsOn::cpu) << name;
}

struct Fact {
  const char *preset, *pointer, *value;
};

TEST(Presets, grids_are_those_of_the_engines) {
  constexpr Fact k_facts[] = {
      {"just-cause-3", "/tiles/pixels", "[64, 64]"},
      {"just-cause-3", "/slices/scheme", R"("exponential-first")"},
      {"just-cause-3", "/slices/count", "16"},
      {"just-cause-3", "/slices/near", "0.1"},
      {"just-cause-3", "/slices/first", "5.0"},
      {"just-cause-3", "/slices/far", "500.0"},
      {"just-cause-2", "/cells", "[128, 1, 128]"},
      {"ortegren-persson", "/tiles/count", "[24, 12]"},
      {"ortegren-persson", "/slices/count", "64"},
      {"daveh355", "/tiles/count", "[12, 12]"},
      {"daveh355", "/slices/count", "24"},
      {"daveh355", "/slices/scheme", R"("exponential")"},
      {"black-mesa", "/tiles/count", "[16, 9]"},
      {"black-mesa", "/slices/count", "128"},
      {"wicked", "/tiles/pixels", "[16, 16]"},
      {"filament", "/tiles/pixels", "[72, 72]"},
      {"filament", "/slices/count", "16"},
      {"filament", "/slices/first", "5.0"},
      {"filament", "/slices/far", "100.0"},
      {"bevy", "/tiles/pixels", "[113, 120]"},
      {"bevy", "/slices/count", "24"},
      {"bevy", "/slices/first", "5.0"},
      {"bevy", "/slices/fit/to", R"("lights")"},
      {"godot", "/slices/count", "32"},
      {"godot", "/slices/scheme", R"("linear")"},
      {"three-js", "/tiles/pixels", "[32, 32]"},
      {"three-js", "/slices/count", "24"},
      {"playcanvas", "/cells", "[10, 3, 10]"},
      {"babylon", "/tiles/count", "[64, 64]"},
      {"babylon", "/slices/count", "16"},
      {"unity-urp", "/tiles/pixels", "[8, 8]"},
      {"unity-urp", "/react/to", R"("mask-words")"},
      {"unity-urp", "/react/most", "16384"},
      {"unity-urp", "/react/most_lights", "256"},
      {"bevy", "/react/to", R"("entries")"},
      {"bevy", "/react/most", "16384"},
      {"bevy", "/react/of", R"("bevy-refinement")"},
      {"unity-urp", "/slices/scheme", R"("exponential")"},
      {"unity-hdrp", "/tiles/pixels", "[32, 32]"},
      {"unity-hdrp", "/slices/count", "64"},
      {"unreal", "/tiles/pixels", "[64, 64]"},
      {"unreal", "/slices/count", "32"},
      {"doom-2016", "/tiles/count", "[16, 8]"},
      {"doom-2016", "/slices/count", "24"},
      {"call-of-duty-iw", "/tiles/pixels", "[8, 8]"},
      {"call-of-duty-iw", "/slices/scheme", R"("linear")"},
      {"olsson-2012", "/slices/scheme", R"("cubical")"},
  };
  for (const Fact& fact : k_facts)
    EXPECT_EQ(resolved(fact.preset).grid.at(Json::json_pointer(fact.pointer)), Json::parse(fact.value))
        << fact.preset << fact.pointer;
}

TEST(Presets, just_cause_2_has_tiles_of_four_metres_around_the_camera) {
  const Json grid = resolved("just-cause-2").grid;
  EXPECT_EQ(grid["follow"], "camera");
  EXPECT_EQ(grid["cell_size"], Json::parse("[4.0, null, 4.0]"));
}

TEST(Presets, what_fits_into_a_cell_is_what_the_engines_have_room_for) {
  constexpr std::pair<const char*, double> k_caps[] = {
      {"just-cause-2", 4}, {"daveh355", 100}, {"three-js", 64}, {"playcanvas", 255}};
  for (const auto& [name, cap] : k_caps) {
    const Resolved preset = resolved(name);
    ASSERT_TRUE(preset.storage);
    EXPECT_EQ(preset.storage->name, "fixed");
    EXPECT_EQ(std::get<double>(preset.storage->params.values().at("cap")), cap) << name;
  }
  EXPECT_EQ(std::get<double>(resolved("unreal").storage->params.values().at("nodes_per_cell")), 32.0);
  EXPECT_EQ(std::get<std::string>(resolved("filament").storage->params.values().at("equal_lists")), "shared");
  EXPECT_EQ(std::get<double>(resolved("filament").storage->params.values().at("max_entries")), 65534.0)
      << "of 65535 records the last is never used";
  EXPECT_EQ(std::get<std::string>(resolved("just-cause-3").storage->params.values().at("index_bits")), "16");
}

// By the engines' own arithmetic, on paper: Filament has 512 tiles in a slice, of whole eights of pixels; Bevy 170.
TEST(Presets, tiles_that_follow_the_viewport_are_those_of_the_engines) {
  EXPECT_EQ(resolved("filament", "[1280, 720]").grid["tiles"]["pixels"], Json::parse("[48, 48]"));
  EXPECT_EQ(resolved("filament", "[3840, 2160]").grid["tiles"]["pixels"], Json::parse("[136, 136]"));
  EXPECT_EQ(resolved("bevy", "[1000, 1000]").grid["tiles"]["pixels"], Json::parse("[77, 77]"));
}

TEST(Presets, each_viewport_has_its_own_choice) {
  const Config config = with_presets(R"(, "viewports": [[1920, 1080], [1280, 720]], "presets": ["filament", "godot"])");
  ASSERT_EQ(config.presets.size(), 4u);
  EXPECT_NE(config.presets[0].grid, config.presets[2].grid);
  EXPECT_EQ(config.presets[1].grid, config.presets[3].grid) << "the same pixels in both";
}

TEST(Presets, alone_they_are_all_that_is_measured) {
  const Config config = with_presets(R"(, "presets": ["filament"])");
  EXPECT_EQ(config.own_grids, 0u);
  EXPECT_EQ(config.own_assigners, 0u);
  EXPECT_FALSE(config.resolved.contains("grids"));
  EXPECT_TRUE(config.resolved["samples"].contains("opaque"));
}

TEST(Presets, stand_beside_what_a_configuration_or_a_flag_names) {
  const Config by_file = with_presets(R"(, "assigners": ["aabb"], "presets": ["filament"])");
  EXPECT_EQ(by_file.own_assigners, 1u);
  EXPECT_EQ(by_file.own_grids, 5u) << "the default ones";
  const Config by_flag = with_presets("", {{"--preset", "filament"}, {"--grid", "world"}});
  EXPECT_EQ(by_flag.own_grids, 1u);
  EXPECT_EQ(by_flag.presets.size(), 1u);
  const Config alone = with_presets("", {{"--preset", "filament"}, {"--rounds", "5"}});
  EXPECT_EQ(alone.own_grids, 0u);
}

TEST(Presets, a_configuration_is_read_again_as_it_was_resolved) {
  for (const char* rest :
       {R"(, "presets": ["filament", "unity-*"])", R"(, "presets": ["bevy"], "storages": ["runs"])"}) {
    const Config config = with_presets(rest);
    const Config again = parse_config(config.resolved.dump(), "c.json");
    EXPECT_EQ(again.resolved, config.resolved);
    EXPECT_EQ(again.own_grids, config.own_grids);
    EXPECT_EQ(again.presets.size(), config.presets.size());
  }
}

TEST(Presets, patterns_name_several_and_each_once) {
  const Config config = with_presets("", {{"--preset", "unity-hdrp,unity-*"}});
  ASSERT_EQ(config.presets.size(), 2u);
  EXPECT_EQ(config.presets[0].preset, "unity-hdrp");
  EXPECT_EQ(config.presets[1].preset, "unity-urp");
  EXPECT_EQ(with_presets("", {{"--preset", "*"}}).presets.size(), presets().size());
}

TEST(Presets, a_name_that_is_none_is_refused_with_its_place_and_near_ones) {
  const std::string in_file = refusal_of(R"(, "presets": ["filamnet"])");
  EXPECT_NE(in_file.find("/presets"), std::string::npos) << in_file;
  EXPECT_NE(in_file.find("did you mean 'filament'?"), std::string::npos) << in_file;
  const std::string by_flag = refusal_of("", {{"--preset", "unreel"}});
  EXPECT_NE(by_flag.find("--preset=unreel"), std::string::npos) << by_flag;
  EXPECT_NE(by_flag.find("did you mean 'unreal'?"), std::string::npos) << by_flag;
  EXPECT_NE(refusal_of("", {{"--preset", "x-*"}}).find("allowed: just-cause-3"), std::string::npos);
}

TEST(Presets, a_configuration_without_them_says_nothing_of_them) {
  const Config config = with_presets("");
  EXPECT_FALSE(config.resolved.contains("presets"));
  EXPECT_TRUE(config.presets.empty());
  EXPECT_EQ(config.own_grids, config.grids.size());
}

}  // namespace
}  // namespace clusterbench::config
