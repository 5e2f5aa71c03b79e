// What is said of spots and cells in single precision is true, however close they are.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "assign/cone/spot_rows.h"
#include "assign/each_target.h"
#include "assign/exact/exact_rows.h"
#include "assign/exact/nearest_points.h"
#include "assign/settings.h"
#include "effort.h"
#include "geom/light_meets_cell.h"

namespace clusterbench::assign {
namespace {

using testing::on_each_target;

// Spots that touch cells by a hair, and the same ones a little longer, shorter, wider and narrower: some of these still
// touch, and what they leave between them is of the size of roundoffs.
struct CloseSpots {
  grid::Grid grid;
  view::Frame frame;
  std::vector<std::uint32_t> cells;  // of each spot
  view::LightArrays lights;
};

CloseSpots close_spots(const testing::settings::Plan& plan, std::uint64_t seed, double longer) {
  CloseSpots close;
  close.frame = testing::frame_of(plan.projection, {1280, 717}, {});
  close.frame.view_space = plan.view_space;
  close.grid = testing::grid_of(plan.spec, close.frame);
  const view::Space space = grid::space_of(close.grid, close.frame);
  const auto add = [&](const scene::WorldLight& light, std::uint32_t cell) {
    close.frame.lights.push_back(light);
    close.cells.push_back(cell);
  };
  for (const testing::TouchingLight& touching : testing::touching_spots(close.grid, space, 200, seed, longer))
    for (const int power : {-24, -22, -20, -18, -16, -13, -6, -2})
      for (const double sign : {1.0, -1.0}) {
        const double off = sign * std::ldexp(1.0, power);
        scene::WorldLight other = touching.light;
        other.range_m *= 1.0 + off;
        add(other, touching.cell);
        other = touching.light;
        other.outer_cone_rad = std::min(M_PI / 2, other.outer_cone_rad * (1.0 + off));
        add(other, touching.cell);
      }
  close.lights = view::lights_in(close.frame, space);
  return close;
}

SpotCell place_of(const grid::Grid& grid, std::uint32_t spot, std::uint32_t cell) {
  const auto columns = static_cast<std::uint32_t>(grid.cells().x), rows = static_cast<std::uint32_t>(grid.cells().y);
  const std::uint32_t column = cell % columns;
  return {spot, cell / columns / rows, cell / columns % rows, column, column + 1};
}

std::vector<testing::settings::Plan> all_plans() {
  return testing::settings::plans_for(*find_assigner("exact"), grid::Kind::frustum);
}

// Of spots however small.
RowPlanes planes_of(const grid::Grid& grid) {
  RowPlanes planes(grid.screen());
  planes.least_reach = 0.0f;
  return planes;
}

// Calls check(plan, close, planes) for each view. `longer`: times the spots' usual ranges.
template <class Check>
void for_close_spots(std::uint64_t seed, double longer, Check&& check) {
  for (const testing::settings::Plan& plan : all_plans()) {
    const CloseSpots close = close_spots(plan, seed, longer);
    check(plan, close, planes_of(close.grid));
  }
}

TEST(SpotLooks, say_yes_and_no_only_where_it_is_true_on_every_target) {
  for_close_spots(5, 1.0, [](const testing::settings::Plan& plan, const CloseSpots& close, const RowPlanes& planes) {
    SpotCells pairs;
    std::vector<bool> touched;
    for (std::uint32_t spot = 0; spot < close.cells.size(); ++spot) {
      pairs.add(place_of(close.grid, spot, close.cells[spot]));
      touched.push_back(SpotCellTest(close.grid, close.lights, spot).touches(close.cells[spot]));
    }
    on_each_target([&](const std::string& target) {
      filter_spot_cells(close.lights, planes, pairs);
      std::size_t wrong = 0, settled = 0;
      for (std::uint32_t i = 0; i < pairs.count; ++i) {
        if (pairs.touch[i] == Touch::uncertain) continue;
        ++settled;
        if ((pairs.touch[i] == Touch::yes) != touched[i]) ++wrong;
      }
      EXPECT_EQ(wrong, 0u) << target << ", " << plan.name;
      EXPECT_GT(settled, pairs.count / 100) << target << ", " << plan.name;
    });
  });
}

// Squares of so short ways are denormal, or nothing.
TEST(SpotLooks, say_nothing_wrong_of_apexes_as_good_as_at_a_corner) {
  testing::Random random(23);
  std::vector<scene::WorldLight> spots;
  // What is across the axis has a coordinate of 2^-75, whose square rounds to nothing, or to the least number above.
  for (int i = 0; i < test::tries(50000); ++i) {
    const Vec3d axis = random.direction(), across = glm::cross(axis, random.direction());
    const double most = std::max({std::abs(across.x), std::abs(across.y), std::abs(across.z)});
    const Vec3d off = std::ldexp(random.between(1.0 - 1e-7, 1.0 + 2e-7), -75) / most * across;
    const double angle = random.between(0.05, 1.5), along = random.between(-5e-23, 5e-23);
    spots.push_back(testing::spot_light(off + along * axis, 5.0, axis, angle));
  }
  const view::Frame frame = testing::frame_of({true, -8, 8, -8, 8, 0, 20}, {1280, 720}, spots);
  const grid::Grid grid = testing::grid_of(
      testing::settings::screen_spec(grid::Kind::frustum, {2, 2}, grid::Scheme::linear, 4, 0.0), frame);
  const view::LightArrays lights = view::lights_in(frame, grid::space_of(grid, frame));
  const RowPlanes planes = planes_of(grid);
  SpotCells pairs;
  for (std::uint32_t spot = 0; spot < lights.spots.count; ++spot)
    for (std::uint32_t cell = 0; cell < 4; ++cell) pairs.add(place_of(grid, spot, cell));
  on_each_target([&](const std::string& target) {
    filter_spot_cells(lights, planes, pairs);
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < pairs.count; ++i)
      if (pairs.touch[i] == Touch::no && SpotCellTest(grid, lights, pairs.spot[i]).touches(i % 4)) ++wrong;
    EXPECT_EQ(wrong, 0u) << target;
  });
}

// Cells long in depth that a spot's ball touches: the plane between or the common point is often at an edge alone.
TEST(SpotLooks, tell_of_nearly_all_cells_whether_cones_touch_them) {
  const grid::GridSpec spec =
      testing::settings::screen_spec(grid::Kind::frustum, {24, 24}, grid::Scheme::linear, 4, 0.1);
  for (const testing::settings::Plan& plan : all_plans()) {
    const view::Frame frame = testing::frame_of(plan.projection, {1280, 717}, testing::random_lights(0, 100, 5));
    const grid::Grid grid = testing::grid_of(spec, frame);
    const view::LightArrays lights = view::lights_in(frame, grid::space_of(grid, frame));
    const RowPlanes planes = planes_of(grid);
    SpotCells missed, touched;
    for (std::uint32_t spot = 0; spot < lights.spots.count; ++spot) {
      SpotCellTest cell_test(grid, lights, spot);
      const geom::BallVolume ball{geom::source_of(lights.volume(spot)), geom::range_of(lights.volume(spot))};
      for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
        if (geom::decide_meets(ball, grid.cell(cell)) == geom::Verdict::yes)
          (cell_test.touches(cell) ? touched : missed).add(place_of(grid, spot, cell));
    }
    on_each_target([&](const std::string& target) {
      for (const auto& [pairs, truth] : {std::pair(&missed, Touch::no), std::pair(&touched, Touch::yes)}) {
        filter_spot_cells(lights, planes, *pairs);
        const auto told = std::count(pairs->touch.begin(), pairs->touch.begin() + pairs->count, truth);
        EXPECT_GT(pairs->count, 1000U) << plan.name;
        EXPECT_LE(1000 * (pairs->count - told), (truth == Touch::no ? 2 : 45) * pairs->count)
            << target << ", " << plan.name;
      }
    });
  }
}

// The columns of a row that a spot touches.
grid::IndexRange touched_columns(SpotCellTest& cell_test, const RowPlanes& planes, const SpotCell& in_row) {
  const auto columns = static_cast<std::uint32_t>(planes.columns);
  const std::uint32_t first_cell = (in_row.slice * static_cast<std::uint32_t>(planes.rows) + in_row.row) * columns;
  return trimmed({0, planes.columns - 1},
                 [&](int column) { return !cell_test.touches(first_cell + static_cast<std::uint32_t>(column)); });
}

// RowParts of rows and what is known to be true of them, against what is found: wrong answers and settled ones.
struct RowParts {
  SpotContacts touches;
  std::vector<SpotCell> asked;
  std::vector<grid::IndexRange> touched;  // of the row
  std::size_t wrong = 0, settled = 0, alone = 0;

  void add(const SpotCell& part, const grid::IndexRange& in_row) {
    touches.runs.add(part);
    asked.push_back(part);
    touched.push_back(in_row);
  }
  void test(const view::LightArrays& lights, const RowPlanes& planes) {
    touches.test(lights, planes);
    wrong = settled = alone = 0;
    for (std::uint32_t i = 0; i < touches.runs.count; ++i) {
      const Touch touch = touches.runs.touch[i];
      const int first = std::max(touched[i].first, static_cast<int>(asked[i].column));
      const int last = std::min(touched[i].last, static_cast<int>(asked[i].end_column) - 1);
      settled += touch != Touch::uncertain ? 1 : 0;
      if (touch != Touch::uncertain && (touch == Touch::yes) != (first <= last)) ++wrong;
      const grid::IndexRange only = touches.only_touched_columns(i, planes);
      alone += only.empty() ? 0 : 1;
      if (!only.empty() && (touch != Touch::yes || only.first != first || only.last != last)) ++wrong;
    }
  }
};

TEST(SpotTouches, are_true_on_every_target) {
  for_close_spots(9, 1.0, [](const testing::settings::Plan& plan, const CloseSpots& close, const RowPlanes& planes) {
    RowParts parts;
    const auto columns = static_cast<std::uint32_t>(planes.columns);
    for (std::uint32_t spot = 0; spot < close.cells.size(); spot += 3) {
      SpotCell cell = place_of(close.grid, spot, close.cells[spot]);
      SpotCellTest cell_test(close.grid, close.lights, spot);
      const grid::IndexRange touched = touched_columns(cell_test, planes, cell);
      parts.add(cell, touched);
      parts.add({cell.spot, cell.slice, cell.row, 0, columns}, touched);
      parts.add({cell.spot, cell.slice, cell.row, 0, cell.column + 1}, touched);
    }
    on_each_target([&](const std::string& target) {
      parts.test(close.lights, planes);
      EXPECT_EQ(parts.wrong, 0u) << target << ", " << plan.name;
      EXPECT_GT(parts.settled, parts.asked.size() / 4) << target << ", " << plan.name;
    });
  });
}

// Spots at whole places that shine at the middle planes of the picture and end there, before a camera that has come to
// where depths are rounded.
TEST(SpotTouches, say_which_columns_share_a_single_point) {
  for (const double turn : {0.0, 0.7}) {
    testing::settings::Plan plan = all_plans().front();
    plan.spec = testing::settings::screen_spec(grid::Kind::frustum, {16, 8}, grid::Scheme::exponential, 24, 0.1);
    view::Frame frame = testing::frame_of(plan.projection, {1280, 720}, {});
    frame.view_space.origin = {0.0, 0.0, 1.0 / 3.0};
    frame.view_space.rotation = Mat3d(std::cos(turn), 0, -std::sin(turn), 0, 1, 0, std::sin(turn), 0, std::cos(turn));
    for (int i = 0; i < 60; ++i) {
      const double size = 1 + i % 5, along = i % 9 - 4, depth = -3 - i % 31;
      frame.lights.push_back(testing::spot_light({along, size, depth}, size, {0, -1, 0}, 0.2 + 0.01 * i));
      if (turn == 0.0) frame.lights.push_back(testing::spot_light({size, along, depth}, size, {-1, 0, 0}, 0.5));
    }
    const grid::Grid grid = testing::grid_of(plan.spec, frame);
    const view::LightArrays lights = view::lights_in(frame, grid::space_of(grid, frame));
    const RowPlanes planes = planes_of(grid);
    const auto rows = static_cast<std::uint32_t>(planes.rows), columns = static_cast<std::uint32_t>(planes.columns);
    RowParts parts;
    for (std::uint32_t spot = 0; spot < lights.spots.count; ++spot)
      for (std::uint32_t slice = 0; slice < static_cast<std::uint32_t>(planes.slices); ++slice) {
        SpotCellTest cell_test(grid, lights, spot);
        const SpotCell below{spot, slice, rows / 2, 0, columns};
        parts.add(below, touched_columns(cell_test, planes, below));
        for (std::uint32_t row = 0; row < rows; ++row) {
          const SpotCell left{spot, slice, row, 0, columns / 2};
          parts.add(left, touched_columns(cell_test, planes, left));
        }
      }
    on_each_target([&](const std::string& target) {
      parts.test(lights, planes);
      EXPECT_EQ(parts.wrong, 0u) << target << ", turned by " << turn;
      EXPECT_GT(parts.alone, lights.spots.count / 3) << target << ", turned by " << turn;
    });
  }
}

// A row of cells, the columns of it that a spot touches, and its spot's place among the spots.
struct TrueRow {
  std::uint32_t spot, slice, row;
  grid::IndexRange columns;
};

// `usual`: spots of usual ranges, of which much is known.
void expect_only_what_is_true(double longer, bool usual) {
  for_close_spots(
      6, longer, [&](const testing::settings::Plan& plan, const CloseSpots& close, const RowPlanes& planes) {
        const auto columns = static_cast<std::uint32_t>(planes.columns), rows = static_cast<std::uint32_t>(planes.rows);
        SpotSlices slices;
        std::vector<TrueRow> truth;  // the row that is touched by a hair, and its neighbours
        for (std::uint32_t spot = 0; spot < close.cells.size(); spot += 3) {
          const SpotCell cell = place_of(close.grid, spot, close.cells[spot]);
          slices.add(spot, cell.slice);
          SpotCellTest cell_test(close.grid, close.lights, spot);
          for (std::uint32_t row = cell.row - std::min(cell.row, 1u); row <= std::min(cell.row + 1, rows - 1); ++row) {
            const std::uint32_t first_cell = (cell.slice * rows + row) * columns;
            truth.push_back({spot, cell.slice, row, trimmed({0, planes.columns - 1}, [&](int column) {
                               return !cell_test.touches(first_cell + static_cast<std::uint32_t>(column));
                             })});
          }
        }
        on_each_target([&](const std::string& target) {
          SpotRows found;
          find_spot_rows(close.lights, planes, slices, found);
          std::size_t wrong = 0, settled = 0, listed = 0, at = 0;
          for (const TrueRow& row : truth) {
            while (at < found.count && (found.spot[at] < row.spot ||
                                        (found.spot[at] == row.spot && static_cast<std::int32_t>(found.row[at]) <
                                                                           static_cast<std::int32_t>(row.row))))
              ++at;
            if (at == found.count || found.spot[at] != row.spot || found.row[at] != row.row) {
              if (!row.columns.empty()) ++wrong;
              continue;
            }
            ++listed;
            EXPECT_EQ(found.slice[at], row.slice);
            const std::uint8_t known = found.proven[at];
            const auto is = [&](std::uint8_t bit) { return (known & bit) != 0; };
            const auto touches = [&](int column) { return row.columns.first <= column && column <= row.columns.last; };
            if (is(SpotRows::k_none_before) && !row.columns.empty() && row.columns.first < found.first[at]) ++wrong;
            if (is(SpotRows::k_none_after) && !row.columns.empty() && row.columns.last > found.last[at]) ++wrong;
            if (known == SpotRows::k_all && found.first[at] > found.last[at]) {
              if (!row.columns.empty()) ++wrong;
            } else {
              if (is(SpotRows::k_first_is_touched) && !touches(found.first[at])) ++wrong;
              if (is(SpotRows::k_last_is_touched) && !touches(found.last[at])) ++wrong;
            }
            settled += known == SpotRows::k_all ? 1 : 0;
          }
          EXPECT_EQ(wrong, 0u) << target << ", " << plan.name;
          if (!usual) return;
          EXPECT_GT(listed, truth.size() / 4) << target << ", " << plan.name;
          EXPECT_GT(settled, listed / 3) << target << ", " << plan.name;
        });
      });
}

TEST(SpotRows, know_only_what_is_true_on_every_target) {
  expect_only_what_is_true(1.0, true);
}

// Cells are no larger than what single precision tells of such spots.
TEST(SpotRows, know_only_what_is_true_of_spots_much_longer_than_cells) {
  for (const double longer : test::some(std::vector{1e3, 1e4, 1e5, 1e6}, 3)) expect_only_what_is_true(longer, false);
}

// Spots in all slices of a grid.
struct SpotsInGrid {
  view::LightArrays lights;
  RowPlanes planes;
  SpotSlices slices;

  SpotsInGrid(const testing::settings::Plan& plan, const std::vector<scene::WorldLight>& spots) {
    const view::Frame frame = testing::frame_of(plan.projection, {1280, 717}, spots);
    const grid::Grid grid = testing::grid_of(plan.spec, frame);
    lights = view::lights_in(frame, grid::space_of(grid, frame));
    planes = planes_of(grid);
    for (std::uint32_t slice = 0; slice < static_cast<std::uint32_t>(planes.slices); ++slice)
      for (std::uint32_t spot = 0; spot < lights.spots.count; ++spot) slices.add(spot, slice);
  }
  SpotRows rows() {
    SpotRows found;
    find_spot_rows(lights, planes, slices, found);
    for (std::vector<std::uint32_t>* list : {&found.spot, &found.slice, &found.row}) list->resize(found.count);
    for (std::vector<std::int32_t>* list : {&found.first, &found.last}) list->resize(found.count);
    found.proven.resize(found.count);
    return found;
  }
};

// Else exact-fast is right, but slow.
TEST(SpotRows, settle_nearly_all_rows_of_ordinary_spots_on_every_target) {
  for (const testing::settings::Plan& plan : all_plans()) {
    std::vector<scene::WorldLight> spots = testing::random_lights(0, 300, 7);
    std::erase_if(spots, [](const scene::WorldLight& spot) { return spot.outer_cone_rad < 0.1; });
    SpotsInGrid in_grid(plan, spots);
    on_each_target([&](const std::string& target) {
      const SpotRows found = in_grid.rows();
      const auto settled = static_cast<std::uint32_t>(std::ranges::count(found.proven, SpotRows::k_all));
      EXPECT_GT(found.count, 500u) << target << ", " << plan.name;
      EXPECT_LE(100 * (found.count - settled), found.count) << target << ", " << plan.name << ": " << settled;
    });
  }
}

// Of spots in all slices.
void expect_the_same_rows_on_every_target(const testing::settings::Plan& plan,
                                          const std::vector<scene::WorldLight>& spots) {
  SpotsInGrid in_grid(plan, spots);
  std::optional<SpotRows> first;
  on_each_target([&](const std::string& target) {
    const SpotRows found = in_grid.rows();
    if (!first) first = found;
    EXPECT_EQ(found.spot, first->spot) << target << ", " << plan.name;
    EXPECT_EQ(found.slice, first->slice) << target << ", " << plan.name;
    EXPECT_EQ(found.row, first->row) << target << ", " << plan.name;
    EXPECT_EQ(found.first, first->first) << target << ", " << plan.name;
    EXPECT_EQ(found.last, first->last) << target << ", " << plan.name;
    EXPECT_EQ(found.proven, first->proven) << target << ", " << plan.name;
  });
}

// Counters would differ else, from machine to machine.
TEST(SpotRows, are_the_same_on_every_target) {
  for (const testing::settings::Plan& plan : all_plans()) {
    std::vector<scene::WorldLight> spots = testing::random_lights(0, 300, 8);
    for (const double range : {1e-12, 1e12, std::numeric_limits<double>::infinity()})
      for (const double angle : {0.0, 0.3, M_PI / 2})
        for (const double depth : {0.0, 1e-9, 5.0, 1e9})
          spots.push_back(testing::spot_light({0.0, 0.1 * depth, -depth}, range, {0.6, 0.0, -0.8}, angle));
    expect_the_same_rows_on_every_target(plan, spots);
  }
}

// What is proven of a spot must not depend on its neighbours in a vector, nor on what targets make of no number.
TEST(SpotRows, are_the_same_on_every_target_where_little_is_proven) {
  testing::Random random(12);
  const std::vector<double> depths = {0, 1, 2, 3, 4, 5, 6, 8, 14, 30, 1e3, 1e5};
  for (const view::Projection& view :
       {view::Projection{false, -1, 1, 1e-6, 1, 1e-3, 1e6}, testing::perspective(3.1, 0.4, 1e-3, 1e6),
        testing::perspective(1.0, 0.4, 1e-3, 1e6), view::Projection{true, -8, 8, -8, 8, 0, 1e3}}) {
    testing::settings::Plan plan = all_plans().front();
    plan.projection = view;
    plan.spec = testing::settings::screen_spec(grid::Kind::frustum, {4, 700}, grid::Scheme::list, 11, 0.0);
    plan.spec.slices.boundaries_m = depths;
    std::vector<scene::WorldLight> spots;
    const auto one_of = [&](const auto& list) {
      return list[static_cast<std::size_t>(random.unit() * static_cast<double>(std::size(list)))];
    };
    for (int i = 0; i < test::tries(200); ++i) {
      const Vec3d at{0.5 * (i % 9 - 4), 0.5 * (i % 17 - 8), -one_of(depths)};
      const Vec3d axes[] = {{0, 0, -1}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {0, -1, 0}, random.direction()};
      const double ranges[] = {0.5, 1.0, 2.0, 4.0, random.log_between(1e-6, 1e8)};
      const double angles[] = {1e-7, M_PI / 2 - 1e-3, random.between(0.1, 1.5), M_PI / 2};
      spots.push_back(testing::spot_light(at, one_of(ranges), one_of(axes), one_of(angles)));
    }
    // One that ends at the eye's depth, where points of its rows are no numbers.
    spots.push_back(testing::spot_light({-1, 0, -4}, 4.0, glm::normalize(Vec3d(1, 1, 0)), M_PI / 2 - 1e-7));
    expect_the_same_rows_on_every_target(plan, spots);
  }
}

}  // namespace
}  // namespace clusterbench::assign
