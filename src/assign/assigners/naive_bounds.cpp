// The light's extents as engines have shipped them, each with one mistake on purpose. A spot is tested as its bounding
// ball, and no radius is padded.

#include <algorithm>
#include <cmath>

#include "assign/bounds/cell_bounds.h"
#include "assign/pipeline/light_by_light.h"
#include "geom/projection/disk_tangents.h"
#include "grid/index_range.h"

namespace clusterbench::assign {
namespace {

using grid::IndexRange;

enum class BoundsFlaw { log_slice, fast_log_slice, textbook_tangents, tile_division, padded_tiles };

BoundsFlaw bounds_flaw(const std::string& name) {
  if (name == "log-slice") return BoundsFlaw::log_slice;
  if (name == "fast-log-slice") return BoundsFlaw::fast_log_slice;
  if (name == "textbook-tangents") return BoundsFlaw::textbook_tangents;
  return name == "tile-division" ? BoundsFlaw::tile_division : BoundsFlaw::padded_tiles;
}

// Slices of exponential schemes by a logarithm that differs from the lookup's: of depth / first boundary to base e, or
// of depth / far by fast_log2. Other schemes have no logarithm.
class LogSlices {
 public:
  LogSlices(const grid::Slices& slices, bool fast)
      : slices_(slices), fast_(fast), special_(slices.lookup.first_slice > 0 ? 1 : 0) {}

  IndexRange of(float nearest, float farthest) const {
    if (slices_.lookup.form != grid::SliceLookup::Form::log2)
      return grid::intervals_touched(slices_.boundaries, nearest, farthest);
    if (farthest < slices_.boundaries.front() || nearest > slices_.boundaries.back()) return {};
    return {slice_of(nearest), slice_of(farthest)};
  }

 private:
  int slice_of(float depth) const {
    const float near = slices_.boundaries[static_cast<std::size_t>(special_)], far = slices_.boundaries.back();
    if (!(depth > near)) return depth > 0.0f && special_ > 0 && depth >= near ? special_ : 0;
    const auto count = static_cast<float>(slices_.count() - special_);
    const float slice = fast_ ? grid::log2_by(grid::Log2::fast, depth / far) * (count / std::log2(far / near)) + count
                              : std::log(depth / near) * count / std::log(far / near);
    return special_ + static_cast<int>(std::clamp(slice, 0.0f, count - 1.0f));
  }

  const grid::Slices& slices_;
  bool fast_;
  int special_;  // slices before the logarithm begins
};

// The roots of (d² - r²) s² - 2 u d s + (u² - r²) = 0 in the textbook form, in single precision. A ball that reaches
// the eye's plane has one tangent ahead, a ball around the eye none.
geom::SlopeRange textbook_slopes(float u, float depth, float r) {
  constexpr float k_infinity = std::numeric_limits<float>::infinity();
  const float a = depth * depth - r * r, squared_tangent = u * u + depth * depth - r * r;
  if (!(squared_tangent > 0.0f) || a == 0.0f) return {-k_infinity, k_infinity};
  const float root = r * std::sqrt(squared_tangent);
  const float low = (u * depth - root) / a, high = (u * depth + root) / a;
  if (a > 0.0f) return {low, high};
  return u > 0.0f ? geom::SlopeRange{low, k_infinity} : geom::SlopeRange{-k_infinity, high};
}

class NaiveBounds final : public LightByLight<NaiveBounds> {
 public:
  explicit NaiveBounds(const Params& params) : flaw_(bounds_flaw(params.text("flaw"))) {}

  void build(const grid::Grid& grid, const LightKinds&) override { start_grid(grid); }

  void start_frame(const view::LightArrays&) {}
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    ++tests_;
    add_box(box_of(lights.bounding_ball(light, 0.0f)), light);
  }
  std::size_t own_bytes() const { return 0; }

 private:
  CellBox box_of(const geom::Ball& ball) const {
    CellBox box = cell_box(*grid_, ball);
    const float depth = -ball.center.z;
    const Vec3f& c = ball.center;
    switch (flaw_) {
      case BoundsFlaw::log_slice:
      case BoundsFlaw::fast_log_slice: {
        const LogSlices slices(grid_->screen().slices, flaw_ == BoundsFlaw::fast_log_slice);
        const IndexRange range = slices.of(depth - ball.radius, depth + ball.radius);
        box.first.z = range.first;
        box.last.z = range.last;
        break;
      }
      case BoundsFlaw::textbook_tangents: {
        if (grid_->screen().tiles.orthographic) break;
        set_tiles(box, textbook_slopes(c.x, depth, ball.radius), textbook_slopes(c.y, depth, ball.radius));
        break;
      }
      case BoundsFlaw::tile_division:
      case BoundsFlaw::padded_tiles:
        shift_tiles(box, ball);
        break;
    }
    return box;
  }

  void set_tiles(CellBox& box, const geom::SlopeRange& x, const geom::SlopeRange& y) const {
    const grid::Tiles& tiles = grid_->screen().tiles;
    const IndexRange columns = grid::intervals_touched(tiles.x, x.lo, x.hi);
    const IndexRange rows = grid::descending_intervals_touched(tiles.y, y.lo, y.hi);
    box = {{columns.first, rows.first, box.first.z}, {columns.last, rows.last, box.last.z}};
  }

  // Tiles by whole pixels per tile: rounded down (the tiles at the right and bottom are lost), or rounded up (tiles lie
  // elsewhere than in the lookup).
  void shift_tiles(CellBox& box, const geom::Ball& ball) const {
    if (box.empty()) return;
    const grid::Tiles& tiles = grid_->screen().tiles;
    const auto extent = tiles.orthographic ? geom::offset_range : geom::slope_range;
    const std::vector<float>& depths = grid_->screen().slices.boundaries;
    const auto extents = [&](float u) { return extent(u, -ball.center.z, ball.radius, depths.front(), depths.back()); };
    const geom::SlopeRange x = extents(ball.center.x), y = extents(ball.center.y);
    const auto pixel = [](float slope, float from, float to, int size) {
      return (slope - from) / (to - from) * static_cast<float>(size);
    };
    const Vec2i size = tiles.viewport;
    set_axis(box.first.x, box.last.x, pixel(x.lo, tiles.x.front(), tiles.x.back(), size.x),
             pixel(x.hi, tiles.x.front(), tiles.x.back(), size.x), size.x, tiles.count.x);
    set_axis(box.first.y, box.last.y, pixel(y.hi, tiles.y.front(), tiles.y.back(), size.y),
             pixel(y.lo, tiles.y.front(), tiles.y.back(), size.y), size.y, tiles.count.y);
  }

  void set_axis(int& first, int& last, float from, float to, int pixels, int count) const {
    const int up = (pixels + count - 1) / count;
    const int tile =
        flaw_ == BoundsFlaw::padded_tiles ? up : std::max(1, static_cast<int>(1.0 / grid_scale(pixels, count)));
    const int tiles = std::min(count, pixels / tile + (flaw_ == BoundsFlaw::padded_tiles ? 1 : 0));
    if (tiles < 1) {  // less than one whole tile fits
      last = first - 1;
      return;
    }
    const auto index = [&](float at) {
      return static_cast<int>(std::clamp(at / static_cast<float>(tile), 0.0f, static_cast<float>(tiles - 1)));
    };
    first = index(from);
    last = index(to);
  }

  // Tiles per pixel of the lookup.
  double grid_scale(int pixels, int count) const {
    const grid::Tiles& tiles = grid_->screen().tiles;
    return pixels == tiles.viewport.x && count == tiles.count.x ? static_cast<double>(tiles.scale_x)
                                                                : static_cast<double>(tiles.scale_y);
  }

  void add_box(const CellBox& box, std::uint32_t light) {
    if (box.empty()) return;
    for (int z = box.first.z; z <= box.last.z; ++z)
      for (int y = box.first.y; y <= box.last.y; ++y)
        pairs_.add_row(index_of({box.first.x, y, z}), static_cast<std::uint32_t>(box.last.x - box.first.x + 1), light);
  }

  BoundsFlaw flaw_;
};

}  // namespace

extern const AssignerDescriptor naive_bounds_descriptor;
const AssignerDescriptor naive_bounds_descriptor{
    .name = "naive-bounds",
    .summary = "the light's extents with one mistake that engines have shipped",
    .source = "Filament (fast-log-slice), Bevy (padded-tiles), textbooks (textbook-tangents)",
    .kinds = {grid::Kind::frustum},
    .conservative = false,
    .naive = true,
    .params = {{.name = "flaw",
                .summary = "the mistake. log-slice: slices by a natural logarithm where the lookup has log2; "
                           "fast-log-slice: by a fast logarithm; textbook-tangents: cancellation in single precision; "
                           "tile-division: whole tiles only; padded-tiles: tile sizes rounded up",
                .default_value = std::string("log-slice"),
                .unit = "",
                .choices = {"log-slice", "fast-log-slice", "textbook-tangents", "tile-division", "padded-tiles"}}},
    .make = make_list_assigner<NaiveBounds>,
};

}  // namespace clusterbench::assign
