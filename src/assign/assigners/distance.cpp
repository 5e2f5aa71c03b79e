// Tiles x distance shells. The directions in which a ball reaches one shell fill a circular cap around the direction of
// its centre. So a tile's cell is touched iff the cap at its widest distance meets the tile. Along a row of tiles that
// is one interval of slopes: between the cap's tangents if they touch in the row, otherwise between the points where
// the row's planes cut the cap.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "assign/contract/light_test.h"
#include "assign/distance/shells.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/pipeline/light_by_light.h"
#include "geom/projection/disk_tangents.h"
#include "grid/index_range.h"

namespace clusterbench::assign {
namespace {

constexpr float k_inf = std::numeric_limits<float>::infinity();
constexpr geom::SlopeRange k_all{-k_inf, k_inf};

// The cap as a ball around the light's centre that covers the same directions from the eye. radius +inf: every
// direction.
struct Cap {
  float x, y, depth, radius;
};

// The distance in the shell, and within reach, at which a ball whose centre is at distance `length` is widest as seen
// from the eye: the distance of its tangents' touch points, or else the nearer end.
double widest_distance(double length, double r, double distance0, double distance1) {
  const double touch = length > r ? std::sqrt((length - r) * (length + r)) : 0.0;
  return std::clamp(touch, distance0, distance1);
}

// From the angle between the centre's direction and the sphere's points at this distance: cos = (d² + L² - r²) / (2 d
// L), and 1 ∓ cos in the form that does not cancel.
Cap cap_in_shell(const geom::Ball& ball, double length, double distance) {
  const double r = ball.radius, twice = 2.0 * distance * length;
  Cap cap{ball.center.x, ball.center.y, -ball.center.z, k_inf};
  const double cosine = (distance * distance + (length - r) * (length + r)) / twice;
  if (!(cosine > 0.0)) return cap;  // 90° and more, the eye in the ball, or an unbounded one
  const double apart = std::fabs(distance - length);
  const double squared_sine = (r - apart) * (r + apart) / twice * (1.0 + cosine);
  const double lost = 0x1p-24 * static_cast<double>(k_shell_roundoffs) * length;
  cap.radius = static_cast<float>(length * std::sqrt(std::max(0.0, squared_sine)) + lost);
  return cap;
}

// The section of the cap in the plane y = slope * depth, as slopes x / depth.
geom::SlopeRange cut_by_plane(const Cap& cap, float slope) {
  if (cap.radius == k_inf) return k_all;
  const double stretch = std::sqrt(1.0 + static_cast<double>(slope) * static_cast<double>(slope));
  const double away =
      (static_cast<double>(cap.y) - static_cast<double>(slope) * static_cast<double>(cap.depth)) / stretch;
  const double along =
      (static_cast<double>(cap.depth) + static_cast<double>(slope) * static_cast<double>(cap.y)) / stretch;
  const double squared = (static_cast<double>(cap.radius) - away) * (static_cast<double>(cap.radius) + away);
  if (squared < 0.0) return {k_inf, -k_inf};
  const float chord = static_cast<float>(std::sqrt(squared));
  const geom::SlopeRange cut = geom::slope_range(cap.x, static_cast<float>(along), chord, 0.0f, k_inf);
  return {static_cast<float>(cut.lo * stretch), static_cast<float>(cut.hi * stretch)};
}

// Does the cap's tangent with this slope x / depth touch within the row? A tangent plane through the y axis touches at
// the centre's y.
bool touches_in_row(const Cap& cap, float slope, float row_lo, float row_hi) {
  if (!std::isfinite(slope)) return false;
  const double x = cap.x, depth = cap.depth, r = cap.radius, s = slope;
  const double touch_depth = std::sqrt(std::max(0.0, x * x + depth * depth - r * r) / (1.0 + s * s));
  const double tolerance = k_touch_tolerance * (touch_depth + std::fabs(static_cast<double>(cap.y)));
  return cap.y >= row_lo * touch_depth - tolerance && cap.y <= row_hi * touch_depth + tolerance;
}

geom::SlopeRange hull(const geom::SlopeRange& a, const geom::SlopeRange& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

// A row's plane, and the section of the cap in it.
struct RowCut {
  float slope;
  geom::SlopeRange cut;
};

// The cap's slopes x / depth in the row between two planes.
geom::SlopeRange slopes_in_row(const Cap& cap, const geom::SlopeRange& tangents, const RowCut& lo, const RowCut& hi) {
  geom::SlopeRange slopes = hull(lo.cut, hi.cut);
  for (const float tangent : {tangents.lo, tangents.hi})
    if (touches_in_row(cap, tangent, lo.slope, hi.slope)) slopes = hull(slopes, {tangent, tangent});
  return slopes;
}

class Distance final : public LightByLight<Distance> {
 public:
  explicit Distance(const Params& params) : test_(params, k_shell_roundoffs) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    start_grid(grid);
    view_ = ViewCull(grid.screen());
    test_.start_grid(grid, kinds);
  }

  void start_frame(const view::LightArrays& lights) { test_.start_frame(lights); }
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    const TestedLight tested = test_.tested(lights, light);
    const geom::Ball& ball = tested.ball;
    if (view_.misses(ball)) return;
    const grid::Slices& shells = grid_->screen().slices;
    const double length = glm::length(Vec3d(ball.center)), r = ball.radius;
    for (int shell = 0; shell < shells.count(); ++shell) {
      const double distance0 = shells.boundaries[static_cast<std::size_t>(shell)];
      const double distance1 = shells.boundaries[static_cast<std::size_t>(shell) + 1];
      if (length - r > distance1 || length + r < distance0) continue;
      const Cap cap = cap_in_shell(ball, length, widest_distance(length, r, distance0, distance1));
      add_cap(cap, shell, tested);
    }
  }
  std::size_t own_bytes() const { return test_.capacity_bytes(); }

 private:
  void add_cap(const Cap& cap, int shell, const TestedLight& light) {
    const grid::Tiles& tiles = grid_->screen().tiles;
    const geom::SlopeRange across = geom::slope_range(cap.x, cap.depth, cap.radius, 0.0f, k_inf);
    const geom::SlopeRange upright = geom::slope_range(cap.y, cap.depth, cap.radius, 0.0f, k_inf);
    const grid::IndexRange rows = grid::descending_intervals_touched(tiles.y, upright.lo, upright.hi);
    if (rows.empty()) return;
    const auto cut_at = [&](float slope) { return RowCut{slope, cut_by_plane(cap, slope)}; };
    RowCut top = cut_at(tiles.y_max(rows.first));
    for (int row = rows.first; row <= rows.last; ++row) {
      ++tests_;
      const RowCut bottom = cut_at(tiles.y_min(row));
      const geom::SlopeRange slopes = slopes_in_row(cap, across, bottom, top);
      const grid::IndexRange columns = grid::intervals_touched(tiles.x, slopes.lo, slopes.hi);
      if (!columns.empty()) add_row(columns, row, shell, light);
      top = bottom;
    }
  }

  void add_row(const grid::IndexRange& columns, int row, int shell, const TestedLight& light) {
    test_.add_row(light, index_of({columns.first, row, shell}), static_cast<std::uint32_t>(columns.count()), pairs_,
                  tests_);
  }

  LightTest test_;
  ViewCull view_;
};

}  // namespace

extern const AssignerDescriptor distance_descriptor;
const AssignerDescriptor distance_descriptor{
    .name = "distance",
    .summary = "the circular cap that a sphere covers in each distance shell, row by row of tiles",
    .source = "this project: the closed form of a sphere's cap; shells of distance are an idea of Persson 2015",
    .kinds = {grid::Kind::distance},
    .orthographic = false,
    .params = light_params(),
    .make = make_list_assigner<Distance>,
};

}  // namespace clusterbench::assign
