// Lists of values in a configuration, which multiply.

#include <gtest/gtest.h>

#include "config/config.h"
#include "config/parsed.h"

namespace clusterbench::config {
namespace {

using testing::parsed;

std::size_t grids_of(const std::string& grid) {
  return parsed(R"(, "grids": [)" + grid + "]").grids.size();
}

TEST(ConfigAxes, expand_into_their_product) {
  EXPECT_EQ(grids_of(R"({"tiles": {"pixels": [[32, 32], [64, 64]]},
                         "slices": {"scheme": ["linear", "exponential"], "count": [8, 16, 32]}})"),
            12U);
  EXPECT_EQ(grids_of(R"({"kind": "cascades", "levels": [4, 5], "cells": [[16, 16, 16], [32, 32, 32]]})"), 4U);
  EXPECT_EQ(grids_of(R"({"slices": {"scheme": "list", "boundaries": [[0.1, 1, 2], [0.1, 5]]}})"), 2U);
}

std::vector<std::string> tiles_of(const std::string& pixels) {
  std::vector<std::string> names;
  for (const grid::GridSpec& grid :
       parsed(R"(, "grids": [{"tiles": {"pixels": )" + pixels + R"(}, "slices": {"scheme": "linear"}}])").grids)
    names.push_back(std::to_string(grid.tiles.pixels.x) + "x" + std::to_string(grid.tiles.pixels.y));
  return names;
}

TEST(ConfigAxes, a_number_is_a_square_tile_and_two_numbers_alone_are_one_size) {
  using Sizes = std::vector<std::string>;
  EXPECT_EQ(tiles_of("32"), Sizes{"32x32"});
  EXPECT_EQ(tiles_of("[32]"), Sizes{"32x32"});
  EXPECT_EQ(tiles_of("[32, 16]"), Sizes{"32x16"});
  EXPECT_EQ(tiles_of("[[32, 16]]"), Sizes{"32x16"});
  EXPECT_EQ(tiles_of("[16, 32, 64]"), (Sizes{"16x16", "32x32", "64x64"}));
  EXPECT_EQ(tiles_of("[16, [64, 32]]"), (Sizes{"16x16", "64x32"}));
  EXPECT_EQ(tiles_of("[[16, 16], [32, 32]]"), (Sizes{"16x16", "32x32"}));
}

TEST(ConfigAxes, a_pattern_stands_for_the_assigners_that_the_list_does_not_name) {
  const auto labels = [](const std::string& list) {
    std::vector<std::string> all;
    for (const MethodRequest& assigner : parsed(R"(, "assigners": )" + list).assigners) all.push_back(assigner.label());
    return all;
  };
  using Labels = std::vector<std::string>;
  EXPECT_EQ(labels(R"(["exact*", "bounds"])"), (Labels{"exact", "exact-fast", "bounds"}));
  EXPECT_EQ(labels(R"(["*exact*", "exact-?ast", {"name": "exact-fast", "threads": 2}])"),
            (Labels{"exact", "exact-fast(threads=2)"}));
  EXPECT_EQ(labels(R"(["naive-*"])").size(), 6u);
  EXPECT_EQ(labels(R"(["*planes"])"), Labels{"planes"}) << "naive methods run only where they are named";
  EXPECT_EQ(labels(R"(["tiled*"])"), (Labels{"tiled", "tiled-2.5d"}));
  EXPECT_EQ(labels(R"(["ex*t*"])"), (Labels{"exact", "exact-fast"})) << "so do those that need depth";
  const nlohmann::json resolved = parsed(R"(, "assigners": ["exact*"])").resolved["assigners"];
  EXPECT_EQ(resolved[1]["name"], "exact-fast");
}

TEST(ConfigAxes, of_one_scheme_do_not_multiply_the_others) {
  EXPECT_EQ(grids_of(R"({"slices": {"scheme": ["linear", "exponential-first"], "first": [2, 5]}})"), 3U);
}

TEST(ConfigAxes, can_have_every_choice_of_a_parameter) {
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors()) {
    for (const assign::ParamSpec& param : row->params) {
      if (param.choices.empty()) continue;
      const nlohmann::json method{{"name", row->name}, {param.name, param.choices}};
      EXPECT_EQ(parsed(R"(, "assigners": [)" + method.dump() + "]").assigners.size(), param.choices.size());
    }
  }
}

TEST(ConfigAxes, of_a_rig_expand_into_their_product) {
  const Config config = parse_config(
      R"({"scenes": [{"rig": {"lights": [10, 100, 1000], "size": [[20, 5, 20], [2, 2, 2]], "spots": 0.5}}, "a.glb"]})",
      "c.json");
  ASSERT_EQ(config.scenes.size(), 7u);
  EXPECT_EQ(config.scenes[0].rig->name(), "rig-10-r2-s0.5-20x5x20");
  EXPECT_EQ(config.scenes[5].rig->name(), "rig-1000-r2-s0.5-2x2x2");
  EXPECT_FALSE(config.scenes[6].rig);
  const Config plain = parse_config(R"({"scenes": [{"rig": {}}]})", "c.json");
  ASSERT_EQ(plain.scenes.size(), 1u);
  EXPECT_EQ(plain.scenes[0].rig->name(), scene::RigSpec().name());
}

}  // namespace
}  // namespace clusterbench::config
