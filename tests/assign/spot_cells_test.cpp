// What is said of spots and cells in single precision is true, however close they are.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "assign/each_target.h"
#include "assign/exact_rows.h"
#include "assign/settings.h"
#include "assign/simd/spot_rows.h"

namespace clusterbench::assign {
namespace {

using testing::on_each_target;

// Spots that touch cells by a hair, and the same ones a little longer, shorter, wider and narrower: some of these still
// touch, and what they leave between them is of the size of roundings.
struct CloseSpots {
  grid::Grid grid;
  view::Frame frame;
  std::vector<std::uint32_t> cells;  // of each spot
  view::LightArrays lights;
};

CloseSpots close_spots(const testing::settings::Plan& plan, std::uint64_t seed) {
  CloseSpots close;
  close.frame = testing::frame_of(plan.projection, {1280, 717}, {});
  close.frame.view_space = plan.view_space;
  close.grid = testing::grid_of(plan.spec, close.frame);
  const view::Space space = grid::space_of(close.grid, close.frame);
  const auto add = [&](const scene::WorldLight& light, std::uint32_t cell) {
    close.frame.lights.push_back(light);
    close.cells.push_back(cell);
  };
  for (const testing::TouchingLight& touching : testing::touching_spots(close.grid, space, 200, seed))
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

// Calls check(plan, close, planes, from) for each view in perspective.
template <class Check>
void for_close_spots(std::uint64_t seed, Check&& check) {
  for (const testing::settings::Plan& plan :
       testing::settings::plans_for(*find_assigner("exact"), grid::Kind::frustum)) {
    if (plan.projection.orthographic) continue;
    const CloseSpots close = close_spots(plan, seed);
    const RowPlanes planes(close.grid.screen());
    check(plan, close, planes,
          SpotsAndPlanes{&close.lights, planes.side.data(), planes.slope.data(), planes.depth.data()});
  }
}

TEST(SpotLooks, say_yes_and_no_only_where_it_is_true_on_every_target) {
  for_close_spots(5, [](const testing::settings::Plan& plan, const CloseSpots& close, const RowPlanes&,
                        const SpotsAndPlanes& from) {
    SpotCells pairs;
    std::vector<bool> touched;
    for (std::uint32_t spot = 0; spot < close.cells.size(); ++spot) {
      pairs.add(place_of(close.grid, spot, close.cells[spot]));
      touched.push_back(CellJudge(close.grid, close.lights, spot).touches(close.cells[spot]));
    }
    on_each_target([&](const std::string& target) {
      for (const Look look : {Look::apart, Look::quick, Look::approach, Look::closer, Look::thorough}) {
        look_at_cells(from, look, pairs);
        std::size_t wrong = 0, settled = 0;
        for (std::uint32_t i = 0; i < pairs.count; ++i) {
          if (pairs.touch[i] == Touch::open) continue;
          ++settled;
          if ((pairs.touch[i] == Touch::yes) != touched[i]) ++wrong;
        }
        EXPECT_EQ(wrong, 0u) << target << ", " << plan.name << ", look " << static_cast<int>(look);
        EXPECT_GT(settled, pairs.count / 100) << target << ", " << plan.name << ", look " << static_cast<int>(look);
      }
    });
  });
}

TEST(SpotRows, know_only_ends_that_are_true_on_every_target) {
  for_close_spots(6, [](const testing::settings::Plan& plan, const CloseSpots& close, const RowPlanes& planes,
                        const SpotsAndPlanes& from) {
    const auto columns = static_cast<std::uint32_t>(planes.columns);
    SpotCells rows;
    std::vector<grid::IndexRange> truth;
    for (std::uint32_t spot = 0; spot < close.cells.size(); spot += 3) {
      SpotCell row = place_of(close.grid, spot, close.cells[spot]);
      const std::uint32_t first_cell = close.cells[spot] - row.column;
      CellJudge judge(close.grid, close.lights, spot);
      truth.push_back(narrowed({0, planes.columns - 1}, [&](int column) {
        return !judge.touches(first_cell + static_cast<std::uint32_t>(column));
      }));
      row.column = 0;
      row.end_column = columns;
      rows.add(row);
    }
    on_each_target([&](const std::string& target) {
      SpotRowEnds ends;
      find_ends(from, planes, rows, ends);
      std::size_t wrong = 0, known = 0;
      for (std::uint32_t i = 0; i < rows.count; ++i) {
        const bool first = (ends.known[i] & SpotRowEnds::k_first) != 0,
                   last = (ends.known[i] & SpotRowEnds::k_last) != 0;
        known += static_cast<std::size_t>(first) + static_cast<std::size_t>(last);
        if (first && (truth[i].empty() || ends.first[i] != truth[i].first)) ++wrong;
        if (last && (truth[i].empty() || ends.last[i] != truth[i].last)) ++wrong;
      }
      EXPECT_EQ(wrong, 0u) << target << ", " << plan.name;
      EXPECT_GT(known, rows.count / 2) << target << ", " << plan.name;
    });
  });
}

}  // namespace
}  // namespace clusterbench::assign
