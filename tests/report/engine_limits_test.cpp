// What `size --engine` says of an engine agrees with its preset: version, limits, and what the limits are compiled to.

#include "report/size_report/engine_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "config/presets/preset_library.h"

namespace clusterbench::report {
namespace {

const config::Preset& preset_of_row(const EngineRow& row) {
  return *config::find_preset(row.preset);
}

TEST(EngineLimits, are_of_the_version_that_the_preset_is_of) {
  for (const EngineRow& row : engine_rows()) {
    ASSERT_NE(config::find_preset(row.preset), nullptr) << row.preset;
    const config::Preset& preset = preset_of_row(row);
    const std::string text = version_text(row), engine = preset.engine;
    EXPECT_NE(text.find(preset.version), std::string::npos) << text;
    EXPECT_TRUE(text.starts_with(engine.substr(0, engine.find(',')) + " (")) << text;
  }
  EXPECT_EQ(version_text(*row_of_engine("bevy-gpu")), "Bevy (0.20-dev of August 2026), GlobalClusterGpuSettings");
}

TEST(EngineLimits, that_an_engine_comes_with_are_those_that_its_preset_has) {
  int compared = 0;
  for (const EngineRow& row : engine_rows()) {
    const nlohmann::json parts = config::preset_parts(preset_of_row(row), {1920, 1080});
    for (const LimitSetting& setting : row.limits) {
      if (setting.default_value == 0 && &setting != row.limits.data()) continue;  // room that grows
      std::uint64_t has = 0;
      if (setting.needed == Needed::longest_list)
        has = parts.value("/storage/cap"_json_pointer, std::uint64_t{0});
      else if (setting.needed == Needed::entries_per_cell)
        has = parts.value("/storage/nodes_per_cell"_json_pointer, std::uint64_t{0});
      else if (setting.needed == Needed::entries)
        has = parts.value("/grid/react/most"_json_pointer, std::uint64_t{0});
      else
        has = config::most_lights(preset_of_row(row));
      EXPECT_EQ(has, setting.default_value) << row.preset << ": " << setting.name;
      compared += has > 0 ? 1 : 0;
    }
    const std::string limit = config::limit_text(preset_of_row(row));
    const bool is_by_type = row.limits.front().needed == Needed::lights_of_type;
    EXPECT_EQ(limit.find("of each type") != std::string::npos, is_by_type) << row.preset;
    const bool counts_scene =
        std::ranges::any_of(row.limits, [](const LimitSetting& one) { return one.needed == Needed::lights_in_scene; });
    EXPECT_EQ(limit.find("in the scene") != std::string::npos, counts_scene) << row.preset;
  }
  EXPECT_GE(compared, 9);
}

TEST(EngineLimits, what_can_be_set_of_a_grid_is_a_value_that_the_preset_has) {
  for (const EngineRow& row : engine_rows()) {
    const nlohmann::json grid = config::preset_parts(preset_of_row(row), {1920, 1080})["grid"];
    for (const char* key : row.grid_keys)
      EXPECT_TRUE(grid.contains(nlohmann::json::json_pointer(key))) << row.preset << ": " << key;
    EXPECT_EQ(row.grid_keys.empty(), std::string(row.grid).empty()) << row.preset;
    EXPECT_EQ(row.grid_keys.empty(), settable_grid_text(row).empty()) << row.preset;
  }
  EXPECT_EQ(settable_grid_text(*row_of_engine("unreal")), "--tiles N (pixels of a square tile), --slices N");
}

// A preset with a limit of lights is either an engine that can be set, or says why not, or is no engine.
TEST(EngineLimits, that_are_compiled_in_name_the_number_of_the_preset) {
  for (const char* name : {"filament", "wicked"}) {
    const std::string why = why_nothing_is_set(name),
                      most = std::to_string(config::most_lights(*config::find_preset(name)));
    EXPECT_NE(why.find(most), std::string::npos) << why;
  }
}

}  // namespace
}  // namespace clusterbench::report
