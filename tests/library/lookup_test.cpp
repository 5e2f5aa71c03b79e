#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geom/light_meets_cell.h"
#include "grid/grid.h"
#include "library/assign.h"
#include "library/cases.h"

namespace clusterbench::library {
namespace {

using testing::engine_frame;
using testing::EngineFrame;
using testing::grid_cases;
using testing::GridCase;
using testing::program_frame;
using testing::settings_for;

// --- Cells and lookup ---

TEST(LightLists, look_up_cells_as_the_grid_does_and_a_shader_would) {
  for (const GridCase& grid : grid_cases()) {
    const EngineFrame frame = engine_frame(30, 9);
    LightLists lists;
    ASSERT_TRUE(lists.start(settings_for(grid.grid, "bvh")) || lists.start(settings_for(grid.grid, "brute-force")));
    ASSERT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
    const view::Frame program = program_frame(frame);
    const grid::Grid made = grid::make_grid(grid.spec, grid::grid_inputs(grid.spec, program, 0, Vec3d(0), Vec3d(0)));
    EXPECT_EQ(Vec3i(lists.cells().x, lists.cells().y, lists.cells().z), made.cells());
    SplitMix64 random(3);
    int inside = 0;
    for (int i = 0; i < 500; ++i) {
      const auto x = static_cast<float>(random.between(-10, 1290)), y = static_cast<float>(random.between(-10, 730));
      const auto depth = static_cast<float>(random.between(-1.0, 160.0));  // below 0 behind the eye
      const std::int64_t cell = lists.cell_at(x, y, depth);
      inside += cell >= 0;
      const bool is_shown = x >= 0 && x <= 1280 && y >= 0 && y <= 720;
      if (made.kind() == grid::Kind::frustum) {
        EXPECT_EQ(cell >= 0, is_shown && depth > 0.0f && depth <= made.screen().slices.boundaries.back());
      }
      EXPECT_FALSE(cell >= 0 && depth <= 0.0f);
      if (cell < 0 || depth < 0.1f) continue;
      const Vec3d at = view::picture_ray(program, {x, y}).at(depth);
      const geom::Cell exact = made.cell(static_cast<std::uint32_t>(cell));
      const view::Space space = grid::space_of(made, program);
      const Vec3d world = program.view_space.origin + glm::transpose(program.view_space.rotation) * at;
      const geom::BallVolume around{{world, space.origin, space.rotation}, 1e-3 * (1.0 + depth)};
      EXPECT_EQ(geom::decide_meets(around, exact), geom::Verdict::yes) << grid.spec.name() << " " << x << " " << y;
    }
    EXPECT_GT(inside, 50) << grid.spec.name();
    const float nan = std::numeric_limits<float>::quiet_NaN(), endless = std::numeric_limits<float>::infinity();
    EXPECT_EQ(lists.cell_at(nan, 1, 1), -1);
    EXPECT_EQ(lists.cell_at(1, 1, nan), -1);
    EXPECT_EQ(lists.cell_at(1, 1, endless), -1);
  }
}

// By the words of the header alone.
int slice_by_header(const Lookup& lookup, float depth) {
  const int slices = static_cast<int>(lookup.boundaries.size()) - 1;
  if (lookup.form == Lookup::Form::search) {
    int slice = 0;
    for (int k = 0; k < slices; ++k)
      if (lookup.boundaries[static_cast<std::size_t>(k)] <= depth) slice = k;
    return slice;
  }
  if (depth < lookup.first_m && lookup.first_slice == 1) return 0;
  const float f = lookup.form == Lookup::Form::log2 ? static_cast<float>(std::log2(static_cast<double>(depth))) : depth;
  return static_cast<int>(std::clamp(f * lookup.scale + lookup.bias, 0.0f, static_cast<float>(slices - 1)));
}

std::int64_t cell_by_header(const LightLists& lists, float x, float y, float depth, bool is_orthographic) {
  const Lookup lookup = lists.lookup();
  const Cells cells = lists.cells();
  if (depth > lookup.boundaries.back() || (!is_orthographic && depth <= 0.0f)) return -1;
  const int column = std::min(static_cast<int>(x * lookup.tile_scale_x), cells.x - 1);
  const int row = std::min(static_cast<int>(y * lookup.tile_scale_y), cells.y - 1);
  return (std::int64_t{slice_by_header(lookup, depth)} * cells.y + row) * cells.x + column;
}

// Near, far, both sides of every boundary, and depths between.
std::vector<float> depths_to_look_up(std::span<const float> boundaries) {
  std::vector<float> depths{-1.0f, 0.0f, 1e-30f, 0.01f, 0.0999f, 0.1f, 4.9999f, 5.0f, 5.0001f, 150.0f, 151.0f, 1e6f};
  for (const float boundary : boundaries)
    for (const float factor : {0.999f, 0.9999999f, 1.0f, 1.0000001f, 1.001f, 1.03f})
      depths.push_back(boundary * factor);
  return depths;
}

void expect_cells_by_header(const Grid& grid, View view, int first_slice) {
  LightLists lists;
  ASSERT_TRUE(lists.start(settings_for(grid, "bvh"))) << lists.error();
  ASSERT_TRUE(lists.update(view, {})) << lists.error();
  ASSERT_EQ(lists.lookup().boundaries.size(), static_cast<std::size_t>(lists.cells().z) + 1);
  EXPECT_EQ(lists.lookup().first_slice, first_slice);
  // The middle of the picture alone has a distance that is its depth.
  const bool is_distance = grid.kind == Grid::Kind::distance;
  std::vector<bool> seen(static_cast<std::size_t>(lists.cells().z));
  for (const float depth : depths_to_look_up(lists.lookup().boundaries))
    for (const float x : {640.0f, 0.0f, 700.5f, 1280.0f}) {
      if (is_distance && x != 640.0f) continue;
      const float y = x == 640.0f ? 360.0f : x / 2;
      const std::int64_t cell = cell_by_header(lists, x, y, depth, view.is_orthographic);
      EXPECT_EQ(lists.cell_at(x, y, depth), cell) << x << " " << depth << " " << static_cast<int>(grid.slicing);
      const auto slice = cell / (std::int64_t{lists.cells().x} * lists.cells().y);
      if (cell >= 0) seen[static_cast<std::size_t>(slice)] = true;
    }
  EXPECT_EQ(std::ranges::count(seen, true), lists.cells().z);
}

TEST(Lookup, finds_the_cells_by_the_formula_of_the_header) {
  using Slicing = Grid::Slicing;
  static constexpr double k_boundaries[] = {0.1, 3.0, 20.0, 100.0};
  const View view = engine_frame(1, 9).view;
  for (const Grid::Kind kind : {Grid::Kind::frustum, Grid::Kind::distance})
    for (const Slicing slicing :
         {Slicing::linear, Slicing::exponential, Slicing::exponential_first, Slicing::power, Slicing::list}) {
      Grid grid;  // tiles in pixels
      grid.kind = kind;
      grid.slicing = slicing;
      if (slicing == Slicing::list) grid.boundaries_m = k_boundaries;
      expect_cells_by_header(grid, view, slicing == Slicing::exponential_first);
      grid.columns = 16, grid.rows = 9;
      expect_cells_by_header(grid, view, slicing == Slicing::exponential_first);
    }
  Grid nearer;  // slices that begin beyond the camera's near plane and end before its far plane
  nearer.near_m = 1.0, nearer.far_m = 60.0;
  expect_cells_by_header(nearer, view, 1);
  nearer.slicing = Slicing::exponential;
  expect_cells_by_header(nearer, view, 0);
}

TEST(Lookup, finds_the_cells_of_an_orthographic_camera_that_sees_behind_itself) {
  View view = engine_frame(1, 9).view;
  view.is_orthographic = true;
  view.left = -32.0, view.right = 32.0, view.bottom = -18.0, view.top = 18.0;
  view.near_m = -20.0, view.far_m = 100.0;
  Grid grid;
  grid.slicing = Grid::Slicing::linear;
  expect_cells_by_header(grid, view, 0);
  grid.slicing = Grid::Slicing::exponential;  // with a first slice from near on
  expect_cells_by_header(grid, view, 1);
}

}  // namespace
}  // namespace clusterbench::library
