#pragma once
// Methods whose answer is a light structure of their own, run on the settings of the contract.

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "assign/contract/assigner_run.h"
#include "assign/settings.h"
#include "effort.h"

namespace clusterbench::gpu::testing {

using Values = std::map<std::string, assign::ParamValue>;

inline view::LightArrays lights_of(const assign::testing::Setting& setting) {
  return view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
}

inline assign::AssignerRun run_of(const std::string& name, const Values& values, assign::Answer answer,
                                  const assign::testing::Setting& setting) {
  const assign::AssignerDescriptor& method = *assign::find_assigner(name);
  const view::LightArrays lights = lights_of(setting);
  assign::AssignerRun run(method, assign::Params(method.params, values), answer);
  run.build(setting.grid, assign::kinds_of(lights));
  run.assign(setting.input(lights));
  return run;
}

// The settings of the contract, and views and lights of all sizes.
inline std::vector<assign::testing::Setting> settings_of_tiles(std::uint64_t seed) {
  const assign::AssignerDescriptor& row = *assign::find_assigner("gpu-tiled");
  std::vector<assign::testing::Setting> all = assign::testing::settings_for(row, seed);
  for (assign::testing::Setting& setting : test::some(assign::testing::settings_of_any_size(row, 60, seed)))
    all.push_back(std::move(setting));
  return all;
}

inline void expect_same_cells(const assign::LightStructure& found, const assign::LightStructure& expected,
                              const std::string& where) {
  const grid::OccupiedCells cells = found.occupied_cells(), wanted = expected.occupied_cells();
  ASSERT_EQ(cells.begin, wanted.begin) << where;
  for (std::size_t i = 0; i < cells.parts.size(); ++i) {
    ASSERT_EQ(cells.parts[i].depth0, wanted.parts[i].depth0) << where << ", part " << i;
    ASSERT_EQ(cells.parts[i].depth1, wanted.parts[i].depth1) << where << ", part " << i;
  }
}

}  // namespace clusterbench::gpu::testing
