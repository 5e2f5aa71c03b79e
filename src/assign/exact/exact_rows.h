#pragma once
// The parts that the exact assigners share: the columns of a row in closed form (bounds), the exact test of a single
// cell, and the trimming of a range to the cells that are touched.

#include <algorithm>
#include <cmath>
#include <optional>

#include "assign/grid_cull/frustum_cull.h"
#include "geom/ball/ball_decider.h"
#include "geom/projection/row_slopes.h"
#include "geom/shapes/verdict.h"
#include "geom/single_precision/bounding_volumes.h"
#include "geom/spot/spot_decider.h"
#include "grid/grid.h"
#include "grid/index_range.h"
#include "view/frame.h"

namespace clusterbench::assign {

// One row of cells (one slice, one row of tiles): the index of its first cell, and its bounds.
struct Row {
  std::uint32_t first_cell;
  float y0, y1, depth0, depth1;
};

inline Row row_of(const grid::ScreenGrid& grid, int slice, int row) {
  const auto z = static_cast<std::size_t>(slice);
  const Vec2i tiles = grid.tiles.count;
  return {grid::cell_index({0, row, slice}, {tiles.x, tiles.y, grid.slices.count()}), grid.tiles.y_min(row),
          grid.tiles.y_max(row), grid.slices.boundaries[z], grid.slices.boundaries[z + 1]};
}

inline geom::FrustumCell piece_of(const grid::Tiles& tiles, const Row& row, int column) {
  const auto x = static_cast<std::size_t>(column);
  return {tiles.x[x], tiles.x[x + 1], row.y0, row.y1, row.depth0, row.depth1, tiles.orthographic};
}

// In units of single-precision roundoff, as centres and radii are single precision: more than the sum of a centre's
// rounding (1) and the steps of row_slopes.h (12). Twice as many would double the exact decisions, which are rare; too
// few would lose lights.
inline constexpr float k_exact_roundoffs = 32.0f;

// Lights of larger reach, which are outside the domain (geom/shapes/domain.h), are decided cell by cell.
inline constexpr float k_most_exact_reach = 1e17f;

// The columns of a row that a ball touches. The result is right for some ball whose centre and surface are off by less
// than k_exact_roundoffs.
class RowColumns {
 public:
  explicit RowColumns(const grid::Tiles& tiles) : tiles_(tiles) {}

  grid::IndexRange touched(const geom::Ball& ball, const Row& row, geom::Errs errs) const {
    if (!(ball.radius > 0.0f)) return {};
    return tiles_.orthographic ? in_box(ball, row) : in_wedge(ball, row, errs);
  }

 private:
  grid::IndexRange in_wedge(const geom::Ball& ball, const Row& row, geom::Errs errs) const {
    // In double precision: if the surface passes close to the eye, the tangents touch too close to it for single
    // precision.
    const geom::BallFromEye<double> visible{ball.center.x, ball.center.y, -ball.center.z, ball.radius};
    const geom::SlopeHull<double> slopes =
        geom::row_slopes<double>(visible, row.y0, row.y1, {row.depth0, row.depth1}, errs);
    return grid::intervals_touched(tiles_.x, slopes.lo, slopes.hi);
  }
  grid::IndexRange in_box(const geom::Ball& ball, const Row& row) const {
    const float depth = -ball.center.z;
    const float gap_z = std::max({0.0f, row.depth0 - depth, depth - row.depth1});
    const float gap_y = std::max({0.0f, row.y0 - ball.center.y, ball.center.y - row.y1});
    const float square = ball.radius * ball.radius - gap_z * gap_z - gap_y * gap_y;
    if (!(square >= 0.0f)) return {};
    const float half = std::sqrt(square);
    return grid::intervals_touched(tiles_.x, ball.center.x - half, ball.center.x + half);
  }

  const grid::Tiles& tiles_;
};

// Two balls that each bound a spot; neither contains the other.
class SpotBalls {
 public:
  SpotBalls(const view::LightArrays& lights, std::uint32_t light)
      : light_(light),
        cone_(lights.cone(light, view::k_given_roundoffs)),
        around_(geom::bounding_ball(cone_)),
        range_(lights.ball(light, k_exact_roundoffs)) {
    around_.radius += k_exact_roundoffs * 0x1p-24f * lights.reach[light];
  }

  std::uint32_t light() const { return light_; }
  const geom::SphericalCone& cone() const { return cone_; }
  const geom::Ball& around() const { return around_; }
  // All columns of a row that the spot touches, perhaps with a few more.
  grid::IndexRange touched(const RowColumns& columns, const Row& row) const {
    const grid::IndexRange around = columns.touched(around_, row, geom::Errs::outward),
                           in_range = columns.touched(range_, row, geom::Errs::outward);
    if (around.empty() || in_range.empty()) return {};
    return {std::max(around.first, in_range.first), std::min(around.last, in_range.last)};
  }

 private:
  std::uint32_t light_;
  geom::SphericalCone cone_;
  geom::Ball around_, range_;
};

// The exact test of cells against one point light. Constructed for every light, and cheap until the first test.
class PointLightCellTest {
 public:
  PointLightCellTest(const grid::Grid& grid, const view::LightArrays& lights, std::uint32_t light)
      : tiles_(grid.screen().tiles), lights_(lights), light_(light) {}

  bool touches(const Row& row, int column) {
    if (!decider_) {
      const auto ball = std::get<geom::BallVolume>(lights_.volume(light_));
      decider_.emplace(ball.center, ball.range);
    }
    return decider_->meets(piece_of(tiles_, row, column));
  }

 private:
  const grid::Tiles& tiles_;
  const view::LightArrays& lights_;
  std::uint32_t light_;
  std::optional<geom::BallDecider> decider_;
};

// The exact test of cells against one spot.
class SpotCellTest {
 public:
  SpotCellTest(const grid::Grid& grid, const view::LightArrays& lights, std::uint32_t light)
      : grid_(grid), lights_(lights), light_(light) {}

  std::uint32_t light() const { return light_; }

  // is_close: the caller knows that contact or gap is tiny.
  bool touches(std::uint32_t cell, bool is_close = false) {
    if (!decider_) decider_.emplace(std::get<geom::SpotVolume>(lights_.volume(light_)));
    return decider_->meets(grid_.cell(cell), is_close) != geom::Verdict::no;
  }

 private:
  const grid::Grid& grid_;
  const view::LightArrays& lights_;
  std::uint32_t light_;
  std::optional<geom::SpotDecider> decider_;
};

inline grid::IndexRange hull(const grid::IndexRange& a, const grid::IndexRange& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  return {std::min(a.first, b.first), std::max(a.last, b.last)};
}

// Removes the cells at both ends of a range for which misses(column) is true. Only the ends need tests, because all
// cells between two touched cells are touched.
template <class Misses>
grid::IndexRange trimmed(grid::IndexRange range, Misses&& misses) {
  while (!range.empty() && misses(range.first)) ++range.first;
  while (range.last > range.first && misses(range.last)) --range.last;
  return range;
}

// The columns of a row that a point light touches; `outer` contains all of them. cell_test decides the columns that
// single precision leaves uncertain; each of these tests adds 1 to `decisions`.
inline grid::IndexRange decided_columns(const grid::IndexRange& outer, const RowColumns& columns,
                                        const geom::Ball& smaller, const Row& row, PointLightCellTest& cell_test,
                                        std::uint64_t& decisions) {
  const grid::IndexRange inner = columns.touched(smaller, row, geom::Errs::inward);
  if (outer.first == inner.first && outer.last == inner.last) return outer;
  const auto misses = [&](int column) {
    if (inner.holds(column)) return false;
    ++decisions;
    return !cell_test.touches(row, column);
  };
  return hull(inner, trimmed(outer, misses));
}

}  // namespace clusterbench::assign
