#pragma once
// What the tests of lists share: grids as an engine and a configuration ask for them, settings, lists of a frame.

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "assign/contract/assigner.h"
#include "depth/depth_image.h"
#include "library/assign.h"
#include "library/engine_frame.h"

namespace clusterbench::library::testing {

inline Grid frustum_grid() {
  Grid grid;
  grid.columns = 16, grid.rows = 9, grid.slices = 24;
  grid.slicing = Grid::Slicing::exponential;
  return grid;
}

struct GridCase {
  Grid grid;
  grid::GridSpec spec;
};

// The same grids, as an engine asks for them and as a configuration does.
inline std::vector<GridCase> grid_cases() {
  std::vector<GridCase> cases;
  {
    GridCase& by_count = cases.emplace_back();
    by_count.grid = frustum_grid();
    by_count.spec.tiles = {{0, 0}, {16, 9}};
    by_count.spec.slices.scheme = grid::Scheme::exponential;
    by_count.spec.slices.count = 24;
  }
  {
    GridCase& by_pixels = cases.emplace_back();
    by_pixels.grid.far_m = 90.0;
    by_pixels.spec.slices.far_m = 90.0;
  }
  {
    static constexpr double k_boundaries[] = {0.1, 3.0, 20.0, 100.0};
    GridCase& list = cases.emplace_back();
    list.grid.slicing = Grid::Slicing::list;
    list.grid.boundaries_m = k_boundaries;
    list.spec.slices.scheme = grid::Scheme::list;
    list.spec.slices.boundaries_m = {0.1, 3.0, 20.0, 100.0};
  }
  {
    GridCase& distance = cases.emplace_back();
    distance.grid.kind = Grid::Kind::distance;
    distance.grid.slicing = Grid::Slicing::power;
    distance.grid.lambda = 0.7;
    distance.spec.kind = grid::Kind::distance;
    distance.spec.slices.scheme = grid::Scheme::power;
    distance.spec.slices.lambda = 0.7;
  }
  {
    GridCase& cascades = cases.emplace_back();
    cascades.grid.kind = Grid::Kind::cascades;
    cascades.grid.levels = 4;
    cascades.spec.kind = grid::Kind::cascades;
    cascades.spec.cells = {16, 16, 16};
    cascades.spec.levels = 4;
  }
  {
    GridCase& world = cases.emplace_back();
    world.grid.kind = Grid::Kind::world;
    world.spec.kind = grid::Kind::world;
    world.spec.cells = {16, 16, 16};
    world.spec.has_bounds = true;
    for (int i = 0; i < 3; ++i) {
      world.grid.lo_m[i] = -50.0 - i, world.grid.hi_m[i] = 55.0 + i;
      world.spec.bounds_lo_m[i] = -50.0 - i, world.spec.bounds_hi_m[i] = 55.0 + i;
    }
  }
  return cases;
}

inline std::vector<std::uint32_t> copy_of(std::span<const std::uint32_t> numbers) {
  return {numbers.begin(), numbers.end()};
}

inline assign::Lists lists_of(const LightLists& made) {
  return {copy_of(made.begins()), copy_of(made.light_indices())};
}

inline Settings settings_for(const Grid& grid, std::string_view method) {
  Settings settings;
  settings.grid = grid;
  settings.method = method;
  return settings;
}

// The lists of a frame; fails the test with the reason if there are none.
inline assign::Lists made_lists(const Settings& settings, const EngineFrame& frame) {
  LightLists lists;
  EXPECT_TRUE(lists.start(settings)) << lists.error();
  EXPECT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
  return lists_of(lists);
}

// A frame of lights that the method takes, with the depths that it may need.
struct FrameForMethod {
  EngineFrame engine;
  depth::DepthImage depths;

  explicit FrameForMethod(const assign::AssignerDescriptor& method) : engine(engine_frame(150, 5)) {
    if (!method.spots) engine.spots.clear();
    if (!method.points) engine.points.clear();
    depths = depth::seeded_depths(program_frame(engine), 4);
    engine.view.depths = depths.nearest;
  }
};

inline Grid grid_for(const assign::AssignerDescriptor& method) {
  for (const GridCase& each : grid_cases())
    if (each.spec.kind == method.kinds.front()) return each.grid;
  ADD_FAILURE() << "no grid for " << method.name;
  return {};
}

}  // namespace clusterbench::library::testing
