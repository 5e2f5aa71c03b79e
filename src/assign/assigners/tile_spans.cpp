// Like `z-binning`, but with own columns for each row of tiles: those of the light's outline in that row, not those of
// the box around the outline.
//
// For a ball these are the slopes of its part between the row's two planes and the near and the far plane, in closed
// form (geom/projection/row_slopes.h). A spot has the columns of both the ball of its range and the ball around its
// cone, clipped by the two planes through the eye that touch the cone: their lines are the straight sides of the
// outline. These planes do not exist if the eye lies in the cone, or in its mirror image behind the apex; then the
// balls alone decide.
//
// Roundoffs: balls are enlarged by k_exact_roundoffs, as in `exact`, which uses the same functions. The planes are
// moved out by k_plane_roundoffs: two for the given numbers, and two for the axis (three components off by half a
// roundoff) and the angle (its sine and cosine likewise) over the light's range; planes are in double precision.

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "assign/depth_bins/sorted_masks.h"
#include "assign/exact/exact_rows.h"
#include "assign/grid_cull/view_cull.h"
#include "geom/single_precision/bounding_volumes.h"
#include "grid/index_range.h"

namespace clusterbench::assign {
namespace {

using grid::IndexRange;

constexpr double k_plane_roundoffs = 5.0;

using Slopes = geom::SlopeHull<double>;

IndexRange common(const IndexRange& a, const IndexRange& b) {
  return {std::max(a.first, b.first), std::min(a.last, b.last)};
}

// A spot lies where normal · (X, Y, 1) >= least, for a position (X, Y) in the picture.
struct OutlineSide {
  Vec3d normal{0.0};
  double least = -std::numeric_limits<double>::infinity();

  // The range of X in a row of tiles. The sum is off by less than 8 roundoffs of its terms, the quotient by one.
  Slopes across(double y0, double y1) const {
    constexpr double k_infinity = std::numeric_limits<double>::infinity();
    const double up = std::max(normal.y * y0, normal.y * y1);
    const double error = 0x1p-50 * (std::fabs(least) + std::fabs(normal.z) + std::fabs(up));
    const double rest = least - normal.z - up - error;
    if (!(rest > -k_infinity)) return {-k_infinity, k_infinity};
    if (normal.x == 0.0) return rest > 0.0 ? Slopes{} : Slopes{-k_infinity, k_infinity};
    const double at = rest / normal.x, outward = 0x1p-52 * std::fabs(at);
    return normal.x > 0.0 ? Slopes{at - outward, k_infinity} : Slopes{-k_infinity, at + outward};
  }
};

// The two planes along the lines of sight (through the eye, or along the view axis) that touch the cone, moved out by
// `margin`. They need not touch it precisely: `least` is the spot's least value along the normal. In x, y and depth;
// `nearest`: the least depth that matters.
struct ConeOutline {
  OutlineSide sides[2];

  ConeOutline() = default;
  ConeOutline(const geom::SphericalCone& cone, double margin, double nearest, bool orthographic) {
    const Vec3d apex{cone.apex.x, cone.apex.y, -cone.apex.z}, axis{cone.axis.x, cone.axis.y, -cone.axis.z};
    const Vec3d sight = orthographic ? Vec3d{0, 0, 1} : apex;
    const double distance = glm::length(sight);
    if (!(distance > 0.0) || !(nearest > 0.0 || orthographic)) return;
    const Vec3d ahead = sight / distance, side = glm::cross(ahead, axis);
    const double sine = glm::length(side);  // of the angle between axis and sight
    const double lean = double{cone.sin_angle} / sine;
    if (!(sine > 0.0) || !(lean < 1.0)) return;
    const Vec3d across = side / sine, toward_axis = glm::cross(across, ahead);
    for (const double turn : {-1.0, 1.0}) {
      const Vec3d normal = lean * toward_axis + turn * std::sqrt((1.0 - lean) * (1.0 + lean)) * across;
      // Minimum of normal · u over the unit vectors u of the cone.
      const double along =
          glm::dot(normal, axis) * double{cone.cos_angle} - glm::length(glm::cross(normal, axis)) * cone.sin_angle;
      const double start = orthographic ? normal.x * apex.x + normal.y * apex.y : glm::dot(normal, apex);
      const double range = cone.range, size = glm::length(apex) + range;
      const double least = start + (along < 0.0 ? range * along : 0.0) - margin - 0x1p-48 * size;
      OutlineSide& out = sides[turn < 0.0 ? 0 : 1];
      out.normal = normal;
      if (orthographic) {
        out.normal.z = 0.0;
        out.least = least;
      } else {
        out.least = std::min(least, 0.0) / nearest;
      }
    }
  }
};

class TileSpans final : public AssignerOf<SortedMasks<RangesOf::slices>> {
 public:
  explicit TileSpans(const Params& params)
      : inflation_(params.number("inflation")), form_{.has_bin_masks = params.text("bins") == "masks"} {}

  void build(const grid::Grid& grid, const LightKinds&) override {
    grid_ = &grid;
    view_ = ViewCull(grid.screen());
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override { return bytes_of(listed_, spans_); }

 protected:
  void fill(const FrameInput& input, SortedMasks<RangesOf::slices>& out) override {
    const view::LightArrays& lights = input.lights;
    tests_ = 0;
    listed_.clear();
    spans_.clear();
    listed_.reserve(lights.size());
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      if (!lights.is_empty(light)) find_spans(lights, light);
    // Equal depths are ordered by slices, so that a bin's content does not depend on the order of the lights.
    std::sort(listed_.begin(), listed_.end(), [](const Listed& a, const Listed& b) { return a.order() < b.order(); });
    out.start(*grid_, lights.size(), static_cast<std::uint32_t>(listed_.size()), form_);
    std::uint32_t rank = 0;
    for (const Listed& each : listed_)
      out.add(rank++, each.light, each.type, each.slices, each.first_row, {spans_.data() + each.first_span, each.rows});
  }

 private:
  struct Listed {
    std::uint32_t light;
    std::size_t type;
    float depth;
    IndexRange slices;
    int first_row;
    std::size_t first_span, rows;  // in spans_

    std::tuple<std::size_t, float, int, int, std::uint32_t> order() const {
      return {type, depth, slices.first, slices.last, light};
    }
  };

  void find_spans(const view::LightArrays& lights, std::uint32_t light) {
    const auto padding = static_cast<float>(inflation_ * double{k_exact_roundoffs});
    const geom::Ball range = lights.ball(light, padding);
    // The ball around an enlarged cone is not enlarged as much: its radius is that of the cone times 1 / (2 cos a).
    geom::Ball ball = lights.bounding_ball(light, static_cast<float>(inflation_) * view::k_given_roundoffs);
    ball.radius = lights.is_spot(light) ? ball.radius + padding * 0x1p-24f * lights.reach[light] : range.radius;
    ++tests_;
    if (view_.misses(ball)) return;
    const std::vector<float>& boundaries = grid_->screen().slices.boundaries;
    const IndexRange slices = common(slices_of(ball, boundaries), slices_of(range, boundaries));
    const IndexRange rows = rows_of(ball);
    if (slices.empty() || rows.empty()) return;
    Listed listed{light, lights.type_of(light), -ball.center.z, slices, rows.first, spans_.size(), 0};
    const bool is_spot = lights.is_spot(light);
    const ConeOutline outline = is_spot ? outline_of(lights, light) : ConeOutline();
    bool is_anywhere = false;
    for (int row = rows.first; row <= rows.last; ++row, ++listed.rows) {
      IndexRange columns = columns_of(ball, row);
      if (is_spot && !columns.empty()) columns = common(columns, columns_of(range, row));
      if (is_spot && !columns.empty()) columns = common(columns, columns_of(outline, row));
      ++tests_;
      is_anywhere = is_anywhere || !columns.empty();
      spans_.push_back(columns);
    }
    if (is_anywhere)
      listed_.push_back(listed);
    else
      spans_.resize(listed.first_span);
  }

  static IndexRange slices_of(const geom::Ball& ball, const std::vector<float>& boundaries) {
    return grid::intervals_touched(boundaries, -ball.center.z - ball.radius, -ball.center.z + ball.radius);
  }

  IndexRange rows_of(const geom::Ball& ball) const {
    const CellBox box = cell_box(*grid_, ball);
    return box.empty() ? IndexRange{} : IndexRange{box.first.y, box.last.y};
  }

  // With all slices as one.
  Row whole_row(int row) const {
    const grid::ScreenGrid& screen = grid_->screen();
    return {0, screen.tiles.y_min(row), screen.tiles.y_max(row), screen.slices.boundaries.front(),
            screen.slices.boundaries.back()};
  }

  IndexRange columns_of(const geom::Ball& ball, int row) const {
    if (!(ball.radius <= k_most_exact_reach)) return {0, grid_->cells().x - 1};
    return RowColumns(grid_->screen().tiles).touched(ball, whole_row(row), geom::Errs::outward);
  }

  ConeOutline outline_of(const view::LightArrays& lights, std::uint32_t light) const {
    const double margin = inflation_ * k_plane_roundoffs * 0x1p-24 * double{lights.reach[light]};
    const geom::SphericalCone cone = lights.cone(light, 0.0f);
    const double nearest =
        std::max(double{grid_->screen().slices.boundaries.front()}, -double{cone.apex.z} - double{cone.range} - margin);
    return {cone, margin, nearest, grid_->screen().tiles.orthographic};
  }

  IndexRange columns_of(const ConeOutline& outline, int row) const {
    const grid::Tiles& tiles = grid_->screen().tiles;
    double lo = -std::numeric_limits<double>::infinity(), hi = -lo;
    for (const OutlineSide& side : outline.sides) {
      const Slopes across = side.across(tiles.y_min(row), tiles.y_max(row));
      lo = std::max(lo, across.lo);
      hi = std::min(hi, across.hi);
    }
    return grid::intervals_touched(tiles.x, lo, hi);
  }

  double inflation_;
  MaskForm form_;
  const grid::Grid* grid_ = nullptr;
  ViewCull view_;
  std::vector<Listed> listed_;
  std::vector<IndexRange> spans_;  // row by row, of all listed lights
  std::uint64_t tests_ = 0;
};

}  // namespace

extern const AssignerDescriptor tile_spans_descriptor;
const AssignerDescriptor tile_spans_descriptor{
    .name = "tile-spans",
    .summary =
        "depth bins and tile masks as z-binning has them; each row of tiles has columns of its own, of the light's "
        "outline",
    .source = "Unity's URP (Forward+): horizons of spheres and cones, a range of x for each row of tiles",
    .kinds = {grid::Kind::frustum},
    .by_name = true,
    .params = {inflation_param(),
               {.name = "bins",
                .summary =
                    "what a depth bin has. ranges: the first and the last of its lights; masks: a bit for each of "
                    "them, too, so that a sample loops over none that its bin has not (Unity URP)",
                .default_value = std::string("ranges"),
                .unit = "",
                .choices = {"ranges", "masks"},
                .is_late = true}},
    .make_own = make_structure_assigner<TileSpans>,
};

}  // namespace clusterbench::assign
