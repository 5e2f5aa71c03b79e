// The true lists of a frustum grid: exactly the pairs whose volume and cell share a point.
//
// The cells of one row (one slice, one row of tiles) that a light touches are one interval, because row ∩ volume is
// convex. For a ball its ends come from the slopes' extremes in closed form, once with the radius enlarged by more than
// the error of single precision and once with it reduced: beyond the larger ball no cell is touched, within the smaller
// one every cell is, and exact arithmetic from the scene's own numbers decides the few cells between. For a spot the
// interval of its bounding ball is trimmed from both ends to the first cells that the cone touches.

#include <algorithm>
#include <cmath>
#include <vector>

#include "assign/contract/light_test.h"
#include "assign/exact/exact_rows.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/pipeline/light_by_light.h"
#include "core/arrays.h"
#include "geom/single_precision/touch_tests.h"
#include "grid/index_range.h"

namespace clusterbench::assign {
namespace {

using grid::IndexRange;

class Exact final : public LightByLight<Exact> {
 public:
  explicit Exact(const Params&) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    start_grid(grid);
    view_ = ViewCull(grid.screen());
    cell_balls_.clear();
    if (kinds.spots) cell_balls_ = grid.balls_around_cells();
  }

  void start_frame(const view::LightArrays& lights) {
    fallbacks_ = 0;
    check_prepared(lights, cell_balls_);
  }
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    lights.is_spot(light) ? add_spot(lights, light) : add_point(lights, light);
  }
  std::uint64_t fallbacks() const override { return fallbacks_; }
  std::size_t own_bytes() const { return bytes_of(cell_balls_); }

 private:
  // Calls visit(row) for the rows that a ball may touch, and perhaps a few more.
  template <class Visit>
  void each_row(const geom::Ball& ball, Visit&& visit) {
    const std::vector<float>& depths = grid_->screen().slices.boundaries;
    const float depth = -ball.center.z;
    const IndexRange slices = grid::intervals_touched(depths, depth - ball.radius, depth + ball.radius);
    for (int slice = slices.first; slice <= slices.last; ++slice) {
      const auto z = static_cast<std::size_t>(slice);
      const IndexRange rows = rows_touched(ball, depths[z], depths[z + 1]);
      for (int row = rows.first; row <= rows.last; ++row) {
        ++tests_;
        visit(row_of(grid_->screen(), slice, row));
      }
    }
  }

  IndexRange rows_touched(const geom::Ball& ball, float depth0, float depth1) const {
    const grid::Tiles& tiles = grid_->screen().tiles;
    if (tiles.orthographic)
      return grid::descending_intervals_touched(tiles.y, ball.center.y - ball.radius, ball.center.y + ball.radius);
    geom::SlopeHull<double> slopes;
    const double radius = ball.radius;
    geom::add_disk<double>(slopes, ball.center.y, -ball.center.z, radius * radius, depth0, depth1, 1.0,
                           geom::Errs::outward);
    return grid::descending_intervals_touched(tiles.y, slopes.lo, slopes.hi);
  }

  void add_point(const view::LightArrays& lights, std::uint32_t light) {
    if (std::isinf(lights.radius[light])) return pairs_.add_row(0, grid_->cell_count(), light);
    const geom::Ball larger = lights.ball(light, k_exact_roundoffs);
    if (view_.misses(larger)) return;
    PointLightCellTest cell_test(*grid_, lights, light);
    if (lights.reach[light] > k_most_exact_reach)
      return add_cell_by_cell(light, [&](const Row& row, int column) { return cell_test.touches(row, column); });
    const geom::Ball smaller = lights.ball(light, -k_exact_roundoffs);
    const RowColumns columns(grid_->screen().tiles);
    each_row(larger, [&](const Row& row) {
      const IndexRange outer = columns.touched(larger, row, geom::Errs::outward);
      if (!outer.empty())
        add_interval(row, decided_columns(outer, columns, smaller, row, cell_test, fallbacks_), light);
    });
  }

  void add_spot(const view::LightArrays& lights, std::uint32_t light) {
    const SpotBalls balls(lights, light);
    if (view_.misses(balls.around())) return;
    SpotCellTest cell_test(*grid_, lights, light);
    if (lights.reach[light] > k_most_exact_reach)
      return add_cell_by_cell(light, [&](const Row& row, int column) {
        return cell_test.touches(row.first_cell + static_cast<std::uint32_t>(column));
      });
    const RowColumns columns(grid_->screen().tiles);
    each_row(balls.around(), [&](const Row& row) {
      const IndexRange both = balls.touched(columns, row);
      if (both.empty()) return;
      const auto misses = [&](int column) {
        const std::uint32_t cell = row.first_cell + static_cast<std::uint32_t>(column);
        ++tests_;
        if (!geom::cone_touches_ball(balls.cone(), cell_balls_[cell])) return true;
        ++fallbacks_;
        return !cell_test.touches(cell);
      };
      add_interval(row, trimmed(both, misses), light);
    });
  }

  template <class Touches>
  void add_cell_by_cell(std::uint32_t light, Touches&& touches) {
    fallbacks_ += grid_->cell_count();
    const Vec3i cells = grid_->cells();
    for (int slice = 0; slice < cells.z; ++slice)
      for (int y = 0; y < cells.y; ++y) {
        const Row row = row_of(grid_->screen(), slice, y);
        for (int column = 0; column < cells.x; ++column)
          if (touches(row, column)) pairs_.add(row.first_cell + static_cast<std::uint32_t>(column), light);
      }
  }

  void add_interval(const Row& row, const IndexRange& columns, std::uint32_t light) {
    if (columns.empty()) return;
    pairs_.add_row(row.first_cell + static_cast<std::uint32_t>(columns.first),
                   static_cast<std::uint32_t>(columns.count()), light);
  }

  ViewCull view_;
  std::vector<geom::Ball> cell_balls_;
  std::uint64_t fallbacks_ = 0;
};

}  // namespace

extern const AssignerDescriptor exact_descriptor;
const AssignerDescriptor exact_descriptor{
    .name = "exact",
    .summary =
        "the true lists: each row's interval in closed form, what single precision leaves uncertain decided exactly",
    .source = "this project",
    .kinds = {grid::Kind::frustum},
    .exact = true,
    .params = {},
    .make = make_list_assigner<Exact>,
};

}  // namespace clusterbench::assign
