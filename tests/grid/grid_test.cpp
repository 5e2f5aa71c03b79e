#include "grid/grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "core/error.h"
#include "core/random.h"

namespace clusterbench::grid {
namespace {

view::Frame frame_of(Vec2i viewport, view::Projection projection) {
  view::Frame frame;
  frame.viewport = viewport;
  frame.projection = projection;
  return frame;
}

const view::Projection k_perspective{false, -1.25, 0.75, -0.5, 0.625, 0.5, 100.0};  // off-centre
const view::Projection k_orthographic{true, -20.0, 20.0, -10.0, 10.0, 0.0, 100.0};

GridSpec spec_of(Kind kind) {
  GridSpec spec;
  spec.kind = kind;
  spec.tiles.pixels = {64, 48};
  spec.slices.scheme = Scheme::linear;
  spec.slices.count = 12;
  spec.slices.far_m = 60.0;
  spec.cells = kind == Kind::cascades ? Vec3i{16, 12, 8} : Vec3i{12, 7, 9};
  spec.levels = 4;
  spec.finest_m = 0.75;
  return spec;
}

Grid grid_for(const GridSpec& spec, const view::Frame& frame) {
  return make_grid(spec, grid_inputs(spec, frame, 60.0, {-70.0, -40.0, -90.0}, {75.0, 30.0, 10.0}));
}

// How far a point is outside of a cell; negative inside.
struct Outside {
  Vec3d p;

  static double beyond(double lo, double value, double hi) { return std::max(lo - value, value - hi); }
  double operator()(const geom::FrustumCell& c) const {
    const double depth = -p.z, scale = c.orthographic ? 1.0 : depth;
    return std::max({beyond(c.depth0, depth, c.depth1), beyond(c.x0 * scale, p.x, c.x1 * scale),
                     beyond(c.y0 * scale, p.y, c.y1 * scale)});
  }
  double operator()(const geom::ShellCell& c) const {
    const double depth = -p.z;
    return std::max({beyond(c.distance0, glm::length(p), c.distance1), beyond(c.x0 * depth, p.x, c.x1 * depth),
                     beyond(c.y0 * depth, p.y, c.y1 * depth)});
  }
  double operator()(const geom::Box& c) const {
    return std::max({beyond(c.lo.x, p.x, c.hi.x), beyond(c.lo.y, p.y, c.hi.y), beyond(c.lo.z, p.z, c.hi.z)});
  }
};

Sample sample_in_view(const view::Frame& frame, SplitMix64& random) {
  const view::Projection& projection = frame.projection;
  const double px = random.between(0.0, frame.viewport.x), py = random.between(0.0, frame.viewport.y);
  const double depth = random.between(projection.near_m, 70.0), scale = projection.orthographic ? 1.0 : depth;
  const Vec3d p{(projection.left + (projection.right - projection.left) * px / frame.viewport.x) * scale,
                (projection.top - (projection.top - projection.bottom) * py / frame.viewport.y) * scale, -depth};
  return {static_cast<float>(px), static_cast<float>(py), Vec3f(p), p, Vec3d(0.0)};
}

struct Setting {
  Kind kind;
  Vec2i viewport;
  view::Projection projection;
};

class Partition : public testing::TestWithParam<Setting> {};

TEST_P(Partition, every_point_lies_in_the_one_cell_that_the_lookup_gives) {
  const view::Frame frame = frame_of(GetParam().viewport, GetParam().projection);
  const Grid grid = grid_for(spec_of(GetParam().kind), frame);
  SplitMix64 random(3);
  constexpr double k_boundary = 1e-3;  // closer than this, single precision may choose the neighbour
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const Sample sample = sample_in_view(frame, random);
    const Vec3d local = grid.kind() == Kind::world ? sample.from(grid.world().origin) : Vec3d(sample.view);
    const std::int64_t found = lookup(grid, sample);
    int holding = 0;
    bool is_at_boundary = false;
    for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
      if (grid.is_hole(cell)) continue;
      const double outside = std::visit(Outside{local}, grid.cell(cell));
      is_at_boundary = is_at_boundary || std::abs(outside) < k_boundary;
      if (outside > 0.0) continue;
      ++holding;
      if (outside < -k_boundary) {
        EXPECT_EQ(found, cell);
      }
    }
    if (is_at_boundary) continue;
    EXPECT_LE(holding, 1);
    EXPECT_EQ(found >= 0, holding == 1);
    inside += holding;
  }
  EXPECT_GT(inside, 60);
}

TEST_P(Partition, indices_and_places_belong_together) {
  const Grid grid = grid_for(spec_of(GetParam().kind), frame_of(GetParam().viewport, GetParam().projection));
  const Vec3i cells = grid.cells();
  EXPECT_EQ(grid.cell_count(), static_cast<std::uint32_t>(cells.x * cells.y * cells.z));
  for (std::uint32_t index = 0; index < grid.cell_count(); index += 7) {
    const Vec3i place = grid.cell_at(index);
    EXPECT_EQ(index, static_cast<std::uint32_t>((place.z * cells.y + place.y) * cells.x + place.x));
  }
}

INSTANTIATE_TEST_SUITE_P(Grids, Partition,
                         testing::Values(Setting{Kind::frustum, {640, 360}, k_perspective},
                                         Setting{Kind::frustum, {1366, 768}, k_perspective},
                                         Setting{Kind::frustum, {1000, 700}, k_orthographic},
                                         Setting{Kind::frustum, {1, 1}, k_perspective},
                                         Setting{Kind::distance, {640, 360}, k_perspective},
                                         Setting{Kind::distance, {1000, 700}, k_perspective},
                                         Setting{Kind::cascades, {640, 360}, k_perspective},
                                         Setting{Kind::world, {640, 360}, k_perspective}));

TEST(Tiles, at_the_right_and_bottom_edge_are_clipped_to_the_viewport) {
  Tiling tiling;
  tiling.pixels = {64, 64};
  const Tiles tiles = make_tiles(tiling, {false, -1.0, 1.0, -0.5, 0.5, 0.1, 10.0}, {1000, 700});
  EXPECT_EQ(tiles.count, Vec2i(16, 11));
  EXPECT_GE(static_cast<double>(tiles.x.back()), 1.0);
  EXPECT_LT(static_cast<double>(tiles.x.back()), 1.0 + 1e-6);
  EXPECT_NEAR(tiles.x[15], -1.0 + 2.0 * 960 / 1000, 1e-6);
  EXPECT_NEAR(tiles.y[10], 0.5 - 640.0 / 700, 1e-6);
  EXPECT_EQ(tiles.tile_of(999.5f, 699.5f), Vec2i(15, 10));
  EXPECT_EQ(tiles.tile_of(0.5f, 0.5f), Vec2i(0, 0));
  EXPECT_EQ(tiles.tile_of(1000.0f, -1.0f), Vec2i(15, 0)) << "clamped, never wrapped";
}

TEST(Tiles, every_pixel_centre_finds_the_tile_whose_planes_enclose_it) {
  const view::Projection projection{false, -1.25, 0.75, -0.5, 0.625, 0.1, 10.0};
  for (const Vec2i viewport : {Vec2i{1366, 768}, Vec2i{7680, 4320}, Vec2i{640, 360}}) {
    for (const Vec2i count : {Vec2i{12, 12}, Vec2i{30, 17}, Vec2i{61, 50}}) {
      Tiling tiling;
      tiling.count = count;
      const Tiles tiles = make_tiles(tiling, projection, viewport);
      for (int pixel = 0; pixel < viewport.x; ++pixel) {
        const int column = tiles.tile_of(static_cast<float>(pixel) + 0.5f, 0.5f).x;
        const double slope = projection.left + (projection.right - projection.left) * (pixel + 0.5) / viewport.x;
        EXPECT_LE(tiles.x[static_cast<std::size_t>(column)], slope + 1e-6);
        EXPECT_GE(tiles.x[static_cast<std::size_t>(column) + 1], slope - 1e-6);
      }
    }
  }
}

TEST(Tiles, that_cannot_be_are_refused) {
  const view::Projection projection{false, -1.0, 1.0, -1.0, 1.0, 0.1, 10.0};
  EXPECT_THROW(make_tiles({.pixels = {0, 64}, .count = {0, 0}}, projection, {640, 360}), Error);
  EXPECT_THROW(make_tiles({.pixels = {64, 64}, .count = {641, 1}}, projection, {640, 360}), Error);
  EXPECT_THROW(make_tiles({.pixels = {64, 64}, .count = {8, -1}}, projection, {640, 360}), Error);
}

TEST(Cascades, levels_share_their_boundaries_exactly_and_fill_each_others_holes) {
  const Grid grid = grid_for(spec_of(Kind::cascades), frame_of({640, 360}, k_perspective));
  const CascadesGrid& nested = grid.cascades();
  for (int level = 1; level < nested.levels; ++level) {
    const auto per_level = static_cast<std::uint32_t>(nested.cells.x * nested.cells.y * nested.cells.z);
    std::uint32_t holes = 0;
    for (std::uint32_t i = 0; i < per_level; ++i)
      holes += grid.is_hole(static_cast<std::uint32_t>(level) * per_level + i);
    EXPECT_EQ(holes * 8, per_level) << "the finer level fills an eighth";
  }
  const auto finer = std::get<geom::Box>(grid.cell(15));
  const auto beside = std::get<geom::Box>(grid.cell(static_cast<std::uint32_t>(16 * 12 * 8 + (0 * 12 + 3) * 16 + 12)));
  EXPECT_EQ(finer.hi.x, beside.lo.x);
}

TEST(Cascades, whose_cells_would_be_cut_by_the_finer_level_are_refused) {
  GridSpec spec = spec_of(Kind::cascades);
  const view::Frame frame = frame_of({640, 360}, k_perspective);
  for (const Vec3i cells : {Vec3i{6, 8, 8}, Vec3i{8, 6, 8}, Vec3i{8, 8, 3}, Vec3i{0, 8, 8}}) {
    spec.cells = cells;
    EXPECT_THROW(grid_for(spec, frame), Error);
  }
}

TEST(World, boundaries_enclose_the_rig_far_from_the_origin_too) {
  GridSpec spec = spec_of(Kind::world);
  const view::Frame frame = frame_of({640, 360}, k_perspective);
  const Vec3d lo{1e7, -3.3, 1e6}, hi{1e7 + 41.7, 12.1, 1e6 + 13.0};
  const WorldGrid grid = make_grid(spec, grid_inputs(spec, frame, 0.0, lo, hi)).world();
  EXPECT_LT(grid.origin.x + grid.x.front(), lo.x);
  EXPECT_GT(grid.origin.x + grid.x.back(), hi.x);
  EXPECT_NEAR(grid.x[1] - grid.x[0], 41.7 / 12, 1e-4);
  EXPECT_NO_THROW(make_grid(spec, grid_inputs(spec, frame, 0.0, lo, lo))) << "a rig without extent still has a grid";
}

TEST(GridInputs, hold_only_what_the_grid_depends_on) {
  view::Frame here = frame_of({640, 360}, k_perspective), there = here;
  there.view_space.origin = {5.0, 6.0, 7.0};
  for (const Kind kind : {Kind::frustum, Kind::distance, Kind::cascades, Kind::world}) {
    const GridSpec spec = spec_of(kind);
    EXPECT_EQ(grid_inputs(spec, here, 1.0, {}, {}), grid_inputs(spec, there, 1.0, {}, {}));
  }
}

TEST(GridSpec, a_long_list_of_boundaries_has_a_short_name_of_its_own) {
  GridSpec spec = spec_of(Kind::frustum);
  spec.slices.scheme = Scheme::list;
  for (int i = 0; i <= 65536; ++i) spec.slices.boundaries_m.push_back(0.25 + i);
  const std::string name = spec.name();
  EXPECT_LT(name.size(), 80u) << name;
  EXPECT_NE(name.find("65536 list 0.25..65536.25 #"), std::string::npos) << name;
  spec.slices.boundaries_m[40000] += 0.25;
  EXPECT_NE(spec.name(), name);
}

TEST(GridSpec, different_grids_have_different_names) {
  std::set<std::string> names;
  int count = 0;
  const auto add = [&](const GridSpec& spec) {
    names.insert(spec.name());
    ++count;
  };
  for (const Kind kind : {Kind::frustum, Kind::distance}) {
    for (const Scheme scheme :
         {Scheme::linear, Scheme::exponential, Scheme::exponential_first, Scheme::power, Scheme::fit}) {
      for (const double near : {0.0, 0.1}) {
        GridSpec spec = spec_of(kind);
        spec.slices.scheme = scheme;
        spec.slices.near_m = near;
        add(spec);
        spec.slices.far_m = 0.0;
        add(spec);
        spec.tiles.count = {64, 48};
        add(spec);
      }
    }
  }
  GridSpec world = spec_of(Kind::world);
  add(world);
  world.has_bounds = true;
  world.bounds_hi_m = {1.0, 2.0, 3.0};
  add(world);
  add(spec_of(Kind::cascades));
  EXPECT_EQ(static_cast<int>(names.size()), count);
}

TEST(Grids, whose_numbers_single_precision_cannot_hold_are_refused) {
  const view::Frame frame = frame_of({640, 360}, k_perspective);
  GridSpec far = spec_of(Kind::frustum), cascades = spec_of(Kind::cascades), world = spec_of(Kind::world);
  far.slices.scheme = Scheme::exponential;
  far.slices.far_m = 1e39;
  EXPECT_THROW(grid_for(far, frame), Error);
  for (const double finest : {1e-50, 1e-44, 1e38}) {
    cascades.finest_m = finest;
    EXPECT_THROW(grid_for(cascades, frame), Error);
  }
  world.has_bounds = true;
  world.bounds_lo_m = Vec3d(-1e39);
  world.bounds_hi_m = Vec3d(1e39);
  EXPECT_THROW(grid_for(world, frame), Error);
}

TEST(Grids, that_are_refused_have_their_values_in_the_error) {
  const view::Frame frame = frame_of({640, 360}, k_perspective);
  const auto text = [&](const GridSpec& spec) -> std::string {
    try {
      grid_for(spec, frame);
    } catch (const Error& error) {
      return error.where() + ": " + error.message();
    }
    return "not refused";
  };
  GridSpec cascades = spec_of(Kind::cascades), world = spec_of(Kind::world), screen = spec_of(Kind::frustum);
  cascades.cells = {16, 16, 16};
  cascades.levels = 99;
  EXPECT_EQ(text(cascades), "levels: are 99; allowed: 1 to 24");
  cascades.levels = 2;
  cascades.cells.z = 3;
  EXPECT_TRUE(text(cascades).starts_with("cells: of cascades are 16x16x3; allowed: multiples of 4, 4 and 2"));
  world.has_bounds = true;
  world.bounds_lo_m = Vec3d(2.0);
  world.bounds_hi_m = Vec3d(1.0);
  EXPECT_TRUE(text(world).starts_with("bounds: are from 2 m to 1 m along x; allowed: the first below the second"));
  world.bounds_hi_m = Vec3d(3.0);
  world.cells = {2000, 2000, 2000};
  EXPECT_EQ(text(world), "cells: are more than 10^9: 2000x2000x2000");
  screen.tiles = {{0, 0}, {8, 361}};
  EXPECT_EQ(text(screen), "tiles.count: gives 361 tiles along 360 pixels; at most one tile per pixel down");
  screen.tiles.count = {8, -1};
  EXPECT_EQ(text(screen), "tiles.count: is -1 down; allowed: 1 or more");
  screen.tiles = {{0, 64}, {0, 0}};
  EXPECT_EQ(text(screen), "tiles.pixels: is 0 x 64; allowed: 1 or more each");
}

// The sum of viewport and tile is beyond the whole numbers.
TEST(Tiles, of_any_size_are_counted) {
  constexpr int k_most = std::numeric_limits<int>::max();
  EXPECT_EQ(tile_counts({{k_most, 64}, {0, 0}}, {640, 360}), (Vec2i{1, 6}));
}

TEST(Grids, are_held_to_the_domain) {
  view::Frame frame = frame_of({640, 360}, k_perspective);
  const auto refused_key = [&](const GridSpec& spec) -> std::string {
    try {
      grid_for(spec, frame);
    } catch (const Error& error) {
      return error.where();
    }
    return "";
  };
  GridSpec screen = spec_of(Kind::frustum), cascades = spec_of(Kind::cascades), world = spec_of(Kind::world);
  screen.slices.scheme = Scheme::exponential;
  screen.slices.far_m = 7e14;
  EXPECT_EQ(refused_key(screen), "");
  screen.slices.far_m = 1.1e15;
  EXPECT_EQ(refused_key(screen), "slices.far");
  screen.slices.far_m = 7e14;
  frame.projection.right = 100.0;  // the picture's corners are a hundred times as far to the side
  EXPECT_EQ(refused_key(screen), "slices.far");
  frame.projection.right = 1.0;
  screen.slices.scheme = Scheme::list;
  screen.slices.boundaries_m = {0, 1e-16, 1};
  EXPECT_EQ(refused_key(screen), "slices.boundaries");
  screen.slices.boundaries_m = {1e-16, 1e-14, 1};
  EXPECT_EQ(refused_key(screen), "");
  EXPECT_EQ(grid_for(screen, frame).screen().slices.boundaries.front(), 0.0F) << "nearer than the domain: at the eye";
  world.has_bounds = true;
  world.bounds_lo_m = Vec3d(-1e15);
  world.bounds_hi_m = Vec3d(1e15);
  EXPECT_EQ(refused_key(world), "");
  world.bounds_hi_m.y = 1.001e15;
  EXPECT_EQ(refused_key(world), "bounds");
  for (const double finest : {0.9e-15, 1e14}) {
    cascades.finest_m = finest;
    EXPECT_EQ(refused_key(cascades), "finest");
  }
}

// By its ball, before or behind the eye, or outside of one of the picture's sides.
TEST(GridInputs, of_fit_slices_hold_the_reach_of_lights_in_view_and_of_no_others) {
  const auto light_at = [](Vec3d place, double range) {
    scene::WorldLight light;
    light.position = place;
    light.range_m = range;
    return light;
  };
  for (const Kind kind : {Kind::frustum, Kind::distance})
    for (const bool orthographic : {false, true}) {
      if (orthographic && kind == Kind::distance) continue;
      view::Frame frame = frame_of({640, 360}, orthographic ? k_orthographic : k_perspective);
      frame.projection.far_m = 1000.0;
      GridSpec spec = spec_of(kind);
      spec.slices.scheme = Scheme::fit;
      const view::Projection& picture = frame.projection;
      const double w = orthographic ? 1.0 : 300.0;
      frame.lights = {light_at({0, 0, -20}, 5)};
      const GridInputs alone = grid_inputs(spec, frame, 0.0, {}, {});
      EXPECT_DOUBLE_EQ(alone.light_near_m, 15.0);
      EXPECT_DOUBLE_EQ(alone.light_far_m, 25.0);
      for (const Vec3d& place :
           {Vec3d{0, 0, 60}, Vec3d{0, 0, -1060}, Vec3d{picture.left * w - 60 - w, 0, -300},
            Vec3d{picture.right * w + 60 + w, 0, -300}, Vec3d{0, picture.bottom * w - 60 - w, -300},
            Vec3d{0, picture.top * w + 60 + w, -300}}) {
        frame.lights.push_back(light_at(place, 50));
        EXPECT_EQ(grid_inputs(spec, frame, 0.0, {}, {}), alone) << place.x << " " << place.y << " " << place.z;
        frame.lights.pop_back();
      }
      frame.lights.push_back(light_at({picture.right * w + 40, 0, -300}, 50));
      EXPECT_GT(grid_inputs(spec, frame, 0.0, {}, {}).light_far_m, 349.0);
    }
}

TEST(Distance, grids_are_refused_for_orthographic_cameras) {
  EXPECT_THROW(grid_for(spec_of(Kind::distance), frame_of({640, 360}, k_orthographic)), Error);
}

}  // namespace
}  // namespace clusterbench::grid
