// `exact` for speed: balls outside of the view are left out a vector at a time, rows are found many tile planes at a
// time, and lists are built by compression. What single precision leaves open is decided as in exact.cpp.
//
// Only perspective grids; others take the scalar reference.

#include <cmath>
#include <limits>
#include <memory>

#include "assign/assigner.h"
#include "assign/exact_cells.h"
#include "assign/simd/ball_rows.h"
#include "assign/simd/span_lists.h"
#include "geom/predicates.h"

namespace clusterbench::assign {
namespace {

using grid::IndexRange;

class ExactFast final : public Assigner {
 public:
  explicit ExactFast(const Params&) {}

  void build(const grid::Grid& grid) override {
    grid_ = &grid;
    planes_ = RowPlanes(grid.screen());
    cell_balls_.clear();
  }

  void assign(const view::LightArrays& lights, Lists& out) override {
    tests_ = fallbacks_ = 0;
    const Vec3i cells = grid_->cells();
    spans_.start(static_cast<std::uint32_t>(cells.y * cells.z), static_cast<std::uint32_t>(cells.x));
    slack_.resize(lights.size());
    for (std::uint32_t i = 0; i < lights.size(); ++i) slack_[i] = k_ball_rows_roundings * 0x1p-24f * lights.reach[i];
    cull_balls(planes_, lights.x.data(), lights.y.data(), lights.z.data(), lights.radius.data(), slack_.data(),
               lights.size(), seen_);
    tests_ = lights.size();
    for (const std::uint32_t light : seen_) lights.is_spot(light) ? add_spot(lights, light) : add_point(lights, light);
    spans_.finish(out);
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::uint64_t fallbacks() const override { return fallbacks_; }
  std::size_t scratch_bytes() const override {
    return spans_.capacity_bytes() + cell_balls_.capacity() * sizeof(geom::Ball) +
           (slack_.capacity() + hulls_.capacity()) * sizeof(float) + seen_.capacity() * sizeof(std::uint32_t) +
           rows_.capacity() * sizeof(TouchedRow);
  }

 private:
  void add_point(const view::LightArrays& lights, std::uint32_t light) {
    if (std::isinf(lights.radius[light])) return add_everywhere(light);
    rows_.clear();
    find_rows(planes_, lights.ball(light, 0.0f), slack_[light], hulls_, rows_);
    tests_ += rows_.size();
    for (const TouchedRow& row : rows_) {
      if (row.outer_first == row.inner_first && row.outer_last == row.inner_last)
        spans_.add(row.row, row.outer_first, row.outer_last, light);
      else
        add_undecided(row, lights, light);
    }
  }

  void add_undecided(const TouchedRow& row, const view::LightArrays& lights, std::uint32_t light) {
    CellJudge judge(*grid_, lights, light);
    const IndexRange inner{row.inner_first, row.inner_last};
    add_range(row.row,
              narrowed({row.outer_first, row.outer_last},
                       [&](int column) {
                         if (inner.holds(column)) return false;
                         ++fallbacks_;
                         return !judge.touches(cell_at(row.row, column));
                       }),
              light);
  }

  void add_spot(const view::LightArrays& lights, std::uint32_t light) {
    if (cell_balls_.empty()) cell_balls_ = grid_->balls_around_cells();
    const geom::SphericalCone cone = lights.cone(light, view::k_given_roundings);
    CellJudge judge(*grid_, lights, light);
    if (std::isinf(cone.range)) return add_endless_spot(light, judge);
    rows_.clear();
    find_rows(planes_, geom::bounding_ball(cone), slack_[light], hulls_, rows_);
    tests_ += rows_.size();
    for (const TouchedRow& row : rows_)
      add_range(row.row,
                narrowed({row.outer_first, row.outer_last},
                         [&](int column) {
                           const std::uint32_t cell = cell_at(row.row, column);
                           ++tests_;
                           if (!geom::cone_touches_ball(cone, cell_balls_[cell])) return true;
                           ++fallbacks_;
                           return !judge.touches(cell);
                         }),
                light);
  }

  void add_endless_spot(std::uint32_t light, CellJudge& judge) {
    const Vec3i cells = grid_->cells();
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(cells.y * cells.z); ++row)
      add_range(row,
                narrowed({0, cells.x - 1},
                         [&](int column) {
                           ++fallbacks_;
                           return !judge.touches(cell_at(row, column));
                         }),
                light);
  }

  void add_everywhere(std::uint32_t light) {
    const Vec3i cells = grid_->cells();
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(cells.y * cells.z); ++row)
      add_range(row, {0, cells.x - 1}, light);
  }

  void add_range(std::uint32_t row, const IndexRange& range, std::uint32_t light) {
    if (!range.empty())
      spans_.add(row, static_cast<std::uint32_t>(range.first), static_cast<std::uint32_t>(range.last), light);
  }

  std::uint32_t cell_at(std::uint32_t row, int column) const {
    return row * static_cast<std::uint32_t>(planes_.columns) + static_cast<std::uint32_t>(column);
  }

  const grid::Grid* grid_ = nullptr;
  RowPlanes planes_;
  std::vector<geom::Ball> cell_balls_;
  std::vector<float> slack_, hulls_;
  std::vector<std::uint32_t> seen_;
  std::vector<TouchedRow> rows_;
  SpanLists spans_;
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

std::unique_ptr<Assigner> make(const Params& params) {
  return std::make_unique<ExactFast>(params);
}

}  // namespace

extern const AssignerRow exact_fast_row;
const AssignerRow exact_fast_row{
    .name = "exact-fast",
    .summary = "exact, many tile planes at a time, lists by compression (SIMD, dispatched at run time)",
    .source = "this project",
    .kinds = {grid::Kind::frustum},
    .exact = true,
    .orthographic = false,
    .params = {},
    .make = make,
};

}  // namespace clusterbench::assign
