// `babylon-masks` with the mistakes of Babylon.js. A light's rectangle is drawn from tangents to its ball, one axis at
// a time. For a tangent point behind the eye the depth becomes one centimetre, so the point may land on the wrong side
// of the picture; a rectangle that is turned over is not drawn. An orthographic view uses the tangents of a perspective
// one. Nothing is padded.

#include <algorithm>
#include <cmath>

#include "assign/depth_bins/babylon_order.h"
#include "core/arrays.h"
#include "grid/index_range.h"

namespace clusterbench::assign {
namespace {

// Extent along one axis of the picture, from -1 to 1 within it; `from` may lie beyond `to`.
struct Extent {
  float from, to;
};

// The extent between the ball's two tangents in the plane of an axis and the depth. The whole picture if the eye is in
// the ball, or nearly.
Extent tangents(float across, float depth, float radius, float middle, float half, bool orthographic) {
  constexpr float k_least = 0.01f;
  const float squared_distance = across * across + depth * depth;
  const float squared_sine = radius * radius / squared_distance;
  const float squared_cosine = std::max(1.0f - squared_sine, k_least);
  if (!(squared_distance > 0.0f) || !(squared_cosine > k_least)) return {-1.0f, 1.0f};
  const auto seen = [&](float side) {
    const float turn = side * std::sqrt(squared_sine * squared_cosine);
    const float x = squared_cosine * across + turn * depth, z = squared_cosine * depth - turn * across;
    return orthographic ? (x - middle) / half : (x - middle * z) / half / std::max(z, k_least);
  };
  return {seen(-1.0f), seen(1.0f)};
}

// Tiles whose middles lie within a rectangle's side, after rounding it out to whole tiles.
grid::IndexRange tiles_covered(const Extent& extent, int count) {
  const float scale = 0.5f * static_cast<float>(count);
  const float from = std::floor((extent.from + 1.0f) * scale), to = std::ceil((extent.to + 1.0f) * scale);
  const float first = std::min(from, to), last = std::max(from, to) - 1.0f, end = static_cast<float>(count);
  if (!(first < end) || !(last >= 0.0f)) return {0, -1};
  return {static_cast<int>(std::max(first, 0.0f)), static_cast<int>(std::min(last, end - 1.0f))};
}

class BabylonAsShipped final : public AssignerOf<SortedMasks<RangesOf::slices>> {
 public:
  explicit BabylonAsShipped(const Params&) {}

  void build(const grid::Grid& grid, const LightKinds&) override { grid_ = &grid; }

  std::uint64_t tests_done() const override { return order_.size(); }
  std::size_t scratch_bytes() const override { return bytes_of(order_); }

 protected:
  void fill(const FrameInput& input, SortedMasks<RangesOf::slices>& out) override {
    fill_in_one_order(*grid_, input.lights, order_, out,
                      [&](std::uint32_t light) { return box_of(input.lights.ball(light, 0.0f)); });
  }

 private:
  CellBox box_of(const geom::Ball& ball) const {
    const grid::Tiles& tiles = grid_->screen().tiles;
    const std::vector<float>& depths = grid_->screen().slices.boundaries;
    const float depth = -ball.center.z;
    const auto along = [&](float at, const std::vector<float>& sides) {
      const float middle = 0.5f * (sides.front() + sides.back()), half = 0.5f * std::abs(sides.back() - sides.front());
      return tangents(at, depth, ball.radius, middle, half, tiles.orthographic);
    };
    const Extent right = along(ball.center.x, tiles.x), up = along(ball.center.y, tiles.y);
    const grid::IndexRange slices =
        grid::intervals_touched(depths, depth - ball.radius, std::min(depth + ball.radius, depths.back()));
    CellBox box{{0, 0, slices.empty() ? 0 : slices.first}, {-1, -1, slices.empty() ? -1 : slices.last}};
    const bool is_turned_over = (right.from > right.to) != (up.from > up.to);
    if (is_turned_over) return box;
    const grid::IndexRange columns = tiles_covered(right, tiles.count.x), rows = tiles_covered(up, tiles.count.y);
    if (columns.empty() || rows.empty()) return box;
    box.first.x = columns.first;
    box.last.x = columns.last;
    box.first.y = tiles.count.y - 1 - rows.last;  // its rows count from the bottom
    box.last.y = tiles.count.y - 1 - rows.first;
    return box;
  }

  const grid::Grid* grid_ = nullptr;
  std::vector<std::uint32_t> order_;
};

}  // namespace

extern const AssignerDescriptor babylon_as_shipped_descriptor;
const AssignerDescriptor babylon_as_shipped_descriptor{
    .name = "babylon-as-shipped",
    .summary = "babylon-masks with rectangles from tangents of which one may lie behind the eye",
    .source = "Babylon.js, lightProxy (9.35), which loses lights",
    .kinds = {grid::Kind::frustum},
    .conservative = false,
    .naive = true,
    .by_name = true,
    .params = {},
    .make_own = make_structure_assigner<BabylonAsShipped>,
};

}  // namespace clusterbench::assign
