// The methods on frustum grids beside each other and beside double precision.

#include <limits>

#include "assign/bounds/cell_bounds.h"
#include "assign/contract.h"
#include "assign/dense_check.h"

namespace clusterbench::assign::testing {
namespace {

constexpr const char* k_spot_choices[] = {"sphere", "range", "cone-sphere", "both"};

std::vector<Setting> frustum_settings(std::uint64_t seed) {
  return settings_for(*find_assigner("bounds"), seed);
}

Lists common(const Lists& a, const Lists& b) {
  Lists both;
  both.begin.push_back(0);
  for (std::uint32_t cell = 0; cell < a.cell_count(); ++cell) {
    const auto x = a.of(cell), y = b.of(cell);
    std::set_intersection(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(both.lights));
    both.begin.push_back(both.pair_count());
  }
  return both;
}

Lists listed(const Setting& setting, const char* assigner, const char* spot) {
  return lists_by(assigner, setting.frame, setting.grid, {{"spot", std::string(spot)}});
}

TEST(BoxAssigners, aabb_lists_exactly_what_both_brute_force_and_bounds_list) {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const Setting& setting : frustum_settings(seed))
      for (const char* spot : k_spot_choices)
        EXPECT_EQ(listed(setting, "aabb", spot),
                  common(listed(setting, "brute-force", spot), listed(setting, "bounds", spot)))
            << setting.name << ", " << spot;
}

TEST(TwoLevel, lists_what_aabb_lists_and_what_its_coarse_tiles_add) {
  for (const Setting& setting : frustum_settings(6))
    for (const char* spot : k_spot_choices) {
      const auto with_coarse = [&](double side) {
        return lists_by("two-level", setting.frame, setting.grid, {{"spot", std::string(spot)}, {"coarse", side}});
      };
      const Lists aabb = listed(setting, "aabb", spot), brute_force = listed(setting, "brute-force", spot);
      EXPECT_EQ(with_coarse(1.0), aabb) << setting.name << ", " << spot;
      for (const double side : {2.0, 4.0, 5.0, 64.0}) {
        const Lists lists = with_coarse(side);
        EXPECT_TRUE(contained(aabb, lists)) << setting.name << ", " << spot << ", " << side;
        EXPECT_TRUE(contained(lists, brute_force)) << setting.name << ", " << spot << ", " << side;
      }
    }
}

TEST(BoxAssigners, planes_aabb_and_sphere_refinement_stay_within_bounds) {
  for (const Setting& setting : frustum_settings(4))
    for (const char* spot : k_spot_choices) {
      const Lists bounds = listed(setting, "bounds", spot);
      for (const char* assigner : {"planes", "aabb", "sphere-refinement"}) {
        const Lists lists = listed(setting, assigner, spot);
        EXPECT_TRUE(contained(lists, bounds)) << assigner << ", " << setting.name << ", " << spot;
        if (std::string(assigner) == "planes") continue;  // made of the planes that bounds looks at
        EXPECT_LT(lists.pair_count(), bounds.pair_count()) << assigner << ", " << setting.name << ", " << spot;
      }
    }
}

TEST(BoxAssigners, planes_cost_a_test_per_cell_and_exclude_next_to_nothing_within_bounds) {
  for (const Setting& setting : frustum_settings(4)) {
    const double planes = listed(setting, "planes", "sphere").pair_count();
    EXPECT_GT(planes, 0.999 * listed(setting, "bounds", "sphere").pair_count()) << setting.name;
  }
}

TEST(BoxAssigners, the_cone_test_only_takes_cells_away) {
  for (const Setting& setting : frustum_settings(5))
    for (const char* assigner : {"brute-force", "bounds", "planes", "aabb"}) {
      const Lists both = listed(setting, assigner, "both"), ball = listed(setting, assigner, "sphere");
      EXPECT_TRUE(contained(both, ball)) << assigner << ", " << setting.name;
      EXPECT_LT(both.pair_count(), ball.pair_count()) << assigner << ", " << setting.name;
    }
}

// --- Beside double precision ---

// Distance from a place to the view-space box of a cell, all in double.
double distance_to_box(const geom::FrustumCell& cell, const Vec3d& p) {
  Vec3d lo(std::numeric_limits<double>::infinity()), hi = -lo;
  for (const double depth : {cell.depth0, cell.depth1})
    for (const double x : {cell.x0, cell.x1})
      for (const double y : {cell.y0, cell.y1}) {
        const double scale = cell.orthographic ? 1.0 : depth;
        const Vec3d corner{x * scale, y * scale, -depth};
        lo = glm::min(lo, corner);
        hi = glm::max(hi, corner);
      }
  return glm::length(glm::max(Vec3d(0), glm::max(lo - p, p - hi)));
}

// How far p lies beyond the farthest side of the cell; negative inside.
double height_above_sides(const geom::FrustumCell& cell, const Vec3d& p) {
  const double depth = -p.z, scale = cell.orthographic ? 1.0 : depth;
  const auto beside = [&](double place, double slope) {
    return (place - slope * scale) / (cell.orthographic ? 1.0 : std::hypot(1.0, slope));
  };
  return std::max({cell.depth0 - depth, depth - cell.depth1, -beside(p.x, cell.x0), beside(p.x, cell.x1),
                   -beside(p.y, cell.y0), beside(p.y, cell.y1)});
}

// Where lists may differ from what double precision says: by the padding of the radius, a few float steps of the
// numbers involved.
template <class Distance>
void expect_lists_of(const Setting& setting, const Lists& lists, const Lists& candidates, Distance&& distance) {
  const view::Space& space = setting.frame.view_space;
  for (std::uint32_t light = 0; light < setting.frame.points; ++light) {
    const scene::WorldLight& world = setting.frame.lights[light];
    if (world.range_m == 0.0 || std::isinf(world.range_m)) continue;
    const Vec3d p = space.rotation * (world.position - space.origin);
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      const double gap = distance(std::get<geom::FrustumCell>(setting.grid.cell(cell)), p);
      const double slack = 2e-6 * (std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z) + world.range_m);
      const bool is_listed = lists_light(lists, cell, light);
      if (gap <= world.range_m && lists_light(candidates, cell, light)) {
        ASSERT_TRUE(is_listed) << setting.name << ", cell " << cell << ", light " << light;
      }
      if (gap > world.range_m + slack) {
        ASSERT_FALSE(is_listed) << setting.name << ", cell " << cell << ", light " << light;
      }
    }
  }
}

TEST(BruteForce, lists_a_point_where_its_ball_reaches_the_box_of_the_cell) {
  for (const Setting& setting : frustum_settings(6)) {
    const Lists lists = listed(setting, "brute-force", "both");
    Lists everything = lists;  // no method has looked before
    everything.lights.clear();
    everything.begin.assign(1, 0);
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      for (std::uint32_t light = 0; light < setting.frame.lights.size(); ++light) everything.lights.push_back(light);
      everything.begin.push_back(everything.pair_count());
    }
    expect_lists_of(setting, lists, everything, distance_to_box);
  }
}

TEST(Planes, list_a_point_where_its_ball_reaches_behind_each_side_of_the_cell) {
  for (const Setting& setting : frustum_settings(7))
    expect_lists_of(setting, listed(setting, "planes", "both"), listed(setting, "bounds", "both"), height_above_sides);
}

TEST(Bounds, list_no_column_row_or_slice_that_a_dense_sampling_of_the_ball_stays_clear_of) {
  const view::Frame frame =
      frame_of(perspective(M_PI / 3, 16.0 / 9.0, 0.1, 400), {1920, 1080}, random_lights(60, 0, 8));
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, {48, 27}};
  spec.slices = {.scheme = grid::Scheme::exponential, .count = 24, .near_m = 0.1, .far_m = 400, .boundaries_m = {}};
  const grid::Grid grid = grid_of(spec, frame);
  const Lists lists = lists_by("bounds", frame, grid);
  Random random(9);
  for (std::uint32_t light = 0; light < frame.lights.size(); ++light) {
    Vec3d lo(1e30), hi(-1e30);  // of slope x, slope y, depth over what is in the grid's depths
    const auto take = [&](const Vec3d& p) {
      const double depth = std::clamp<double>(-p.z, grid.screen().slices.boundaries.front(), 400);
      const Vec3d c = frame.lights[light].position;
      const double r = frame.lights[light].range_m, beyond = depth + c.z;
      if (std::fabs(beyond) > r) return;
      // The same direction around the axis, at this depth, on the ball's surface.
      const double across = std::sqrt(r * r - beyond * beyond), turn = std::atan2(p.y - c.y, p.x - c.x);
      const Vec3d place{(c.x + across * std::cos(turn)) / depth, (c.y + across * std::sin(turn)) / depth, depth};
      lo = glm::min(lo, place);
      hi = glm::max(hi, place);
    };
    for (int i = 0; i < 20000; ++i) take(point_in(frame.lights[light], random));
    for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
      if (!lists_light(lists, cell, light)) continue;
      const auto frustum = std::get<geom::FrustumCell>(grid.cell(cell));
      const Vec3d slack = 0.03 * (hi - lo) + 1e-6;
      ASSERT_TRUE(frustum.x0 <= hi.x + slack.x && frustum.x1 >= lo.x - slack.x)
          << "light " << light << ", cell " << cell;
      ASSERT_TRUE(frustum.y0 <= hi.y + slack.y && frustum.y1 >= lo.y - slack.y)
          << "light " << light << ", cell " << cell;
      ASSERT_TRUE(frustum.depth0 <= hi.z + slack.z && frustum.depth1 >= lo.z - slack.z) << light << ", cell " << cell;
    }
  }
}

// --- The cell box, by hand: 10 x 10 tiles of 0.2 over slopes -1..1, 20 slices of 1 m from 1 m on ---

grid::Grid ten_by_ten() {
  const view::Frame frame = frame_of({false, -1, 1, -1, 1, 1, 21}, {1000, 1000}, {});
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, {10, 10}};
  spec.slices = {.scheme = grid::Scheme::linear, .count = 20, .near_m = 1, .far_m = 21, .boundaries_m = {}};
  return grid_of(spec, frame);
}

TEST(CellBox, of_a_ball_ahead_holds_the_tiles_and_slices_that_its_tangents_and_ends_reach) {
  // Slopes ±1 / sqrt 99 = ±0.1005 around the centre line; depths 9..11 touch slices 7 (8..9 m) to 10 (11..12 m).
  const CellBox box = cell_box(ten_by_ten(), {{0, 0, -10}, 1});
  EXPECT_EQ(box.first, Vec3i(4, 4, 7));
  EXPECT_EQ(box.last, Vec3i(5, 5, 10));
}

TEST(CellBox, counts_rows_from_the_top_and_columns_from_the_left) {
  const CellBox box = cell_box(ten_by_ten(), {{-7, 5, -10}, 0.1f});
  EXPECT_EQ(box.first, Vec3i(1, 2, 8));
  EXPECT_EQ(box.last, Vec3i(1, 2, 9));
}

TEST(CellBox, of_a_ball_around_the_eye_is_the_whole_screen_to_the_end_of_the_ball) {
  const CellBox box = cell_box(ten_by_ten(), {{0, 0, 0}, 3.5f});
  EXPECT_EQ(box.first, Vec3i(0, 0, 0));
  EXPECT_EQ(box.last, Vec3i(9, 9, 2));
}

TEST(CellBox, of_a_ball_behind_beside_before_or_beyond_the_grid_is_empty) {
  const grid::Grid grid = ten_by_ten();
  EXPECT_TRUE(cell_box(grid, {{0, 0, 5}, 4}).empty());
  EXPECT_TRUE(cell_box(grid, {{0, 0, 0}, 0.99f}).empty());
  EXPECT_TRUE(cell_box(grid, {{0, 0, -25}, 3.9f}).empty());
  EXPECT_TRUE(cell_box(grid, {{20, 0, -10}, 3}).empty());
  EXPECT_TRUE(cell_box(grid, {{0, -20, -10}, 3}).empty());
}

TEST(CellBox, touching_the_last_boundary_or_the_outermost_plane_counts) {
  const grid::Grid grid = ten_by_ten();
  EXPECT_EQ(cell_box(grid, {{0, 0, -25}, 4}).first.z, 19);
  EXPECT_EQ(cell_box(grid, {{0, 0, 1}, 2}).last.z, 0);
}

TEST(CellBox, of_a_ball_without_end_is_the_whole_grid) {
  const CellBox box = cell_box(ten_by_ten(), {{50, 0, -10}, std::numeric_limits<float>::infinity()});
  EXPECT_EQ(box.first, Vec3i(0, 0, 0));
  EXPECT_EQ(box.last, Vec3i(9, 9, 19));
}

// --- Spots ---

TEST(Spots, an_unbounded_spot_is_listed_along_its_cone_and_not_behind_it) {
  const double infinity = std::numeric_limits<double>::infinity();
  const grid::Grid grid = ten_by_ten();
  const view::Frame frame =
      frame_of({false, -1, 1, -1, 1, 1, 21}, {1000, 1000}, {spot_light({0.1, 0.1, -10}, infinity, {0, 0, -1}, 0.1)});
  for (const char* assigner : {"brute-force", "bounds", "planes", "aabb"}) {
    const Lists lists = lists_by(assigner, frame, grid);
    EXPECT_TRUE(lists_light(lists, cell_index(grid.cells(), 5, 4, 9), 0)) << assigner;
    EXPECT_TRUE(lists_light(lists, cell_index(grid.cells(), 5, 4, 19), 0)) << assigner;
    EXPECT_FALSE(lists_light(lists, cell_index(grid.cells(), 5, 4, 2), 0)) << assigner;
    EXPECT_FALSE(lists_light(lists, cell_index(grid.cells(), 0, 0, 19), 0)) << assigner;
  }
}

TEST(Spots, a_long_thin_spot_across_the_view_takes_a_fraction_of_its_balls_cells) {
  const grid::Grid grid = ten_by_ten();
  const view::Frame frame =
      frame_of({false, -1, 1, -1, 1, 1, 21}, {1000, 1000}, {spot_light({-9, -9, -3}, 25, {1, 1, -0.7}, 0.02)});
  const auto pairs = [&](const char* spot) {
    return lists_by("aabb", frame, grid, {{"spot", std::string(spot)}}).pair_count();
  };
  EXPECT_LT(5 * pairs("both"), pairs("sphere"));
  EXPECT_LE(pairs("both"), pairs("cone-sphere"));
}

TEST(Spots, take_no_memory_where_there_are_none) {
  const grid::Grid grid = ten_by_ten();
  const auto scratch = [&](const char* spot, int spots) {
    const view::Frame frame = frame_of({false, -1, 1, -1, 1, 1, 21}, {1000, 1000}, random_lights(20, spots, 10));
    const auto assigner = find_assigner("bounds")->make(
        Params(find_assigner("bounds")->params, std::map<std::string, ParamValue>{{"spot", std::string(spot)}}));
    const view::LightArrays lights = view::lights_in(frame, frame.view_space);
    assigner->build(grid, kinds_of(lights));
    Lists lists;
    assigner->assign({frame, lights}, lists);
    return assigner->scratch_bytes();
  };
  EXPECT_EQ(scratch("both", 0), scratch("sphere", 0));
  EXPECT_GE(scratch("both", 1), scratch("both", 0) + grid.cell_count() * sizeof(geom::Ball));
}

// --- Counted tests ---

TEST(CountedTests, are_the_cells_that_a_method_looks_at) {
  const grid::Grid grid = ten_by_ten();
  const view::Frame frame =
      frame_of({false, -1, 1, -1, 1, 1, 21}, {1000, 1000}, {point_light({0, 0, -10}, 1), point_light({0, 0, -10}, 0)});
  const auto tests = [&](const char* name) {
    const AssignerDescriptor* row = find_assigner(name);
    const auto assigner = row->make(Params(row->params));
    assigner->build(grid);
    Lists lists;
    assigner->assign({frame, view::lights_in(frame, frame.view_space)}, lists);
    return assigner->tests_done();
  };
  EXPECT_EQ(tests("brute-force"), 2000u);
  for (const char* name : {"planes", "aabb"}) EXPECT_EQ(tests(name), 2u * 2u * 4u) << name;
  EXPECT_EQ(tests("bounds"), 2u * 4u) << "rows are taken whole";
  // Each slice, its two rows, and in each of these one plane from the left and one from the right.
  EXPECT_EQ(tests("sphere-refinement"), 4u * (1u + 2u * (1u + 2u)));
}

}  // namespace
}  // namespace clusterbench::assign::testing
