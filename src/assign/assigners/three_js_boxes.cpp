// Every light against every cell's box as in three.js, with its mistakes. Boxes belong to tiles that are spread evenly
// over the viewport, while samples look them up by tiles of whole pixels: if the tile size does not divide the
// viewport, samples find the lights of another place. A full cell keeps the lights that are farthest from the camera's
// plane. Boxes of an orthographic view grow with depth as those of a perspective. Nothing is padded. A spot is tested
// as the smallest ball around it.

#include <algorithm>
#include <cmath>
#include <utility>

#include "assign/contract/assigner.h"
#include "core/arrays.h"
#include "core/memory.h"
#include "geom/single_precision/touch_tests.h"

namespace clusterbench::assign {
namespace {

class ThreeJsBoxes final : public ListAssigner {
 public:
  explicit ThreeJsBoxes(const Params& params) : most_(static_cast<std::size_t>(params.number("most"))) {}

  void build(const grid::Grid& grid, const LightKinds&) override { grid_ = &grid; }

  void assign(const FrameInput& input, Lists& out) override {
    const view::LightArrays& lights = input.lights;
    const grid::Tiles& tiles = grid_->screen().tiles;
    tests_ = 0;
    find_balls(lights);
    out.lights.clear();
    out.begin.assign(1, 0);
    for (int z = 0; z < grid_->cells().z; ++z) {
      find_reaching(z);
      for (int y = 0; y < tiles.count.y; ++y)
        for (int x = 0; x < tiles.count.x; ++x) add_cell(box_of({x, y, z}), out);
    }
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override { return bytes_of(balls_, reaching_); }

 private:
  struct OrderedBall {
    geom::Ball ball;
    std::uint32_t light;
  };

  // Sorted, farthest first.
  void find_balls(const view::LightArrays& lights) {
    balls_.clear();
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      if (!lights.is_empty(light)) balls_.push_back({lights.bounding_ball(light, 0.0f), light});
    std::ranges::sort(balls_, {}, [](const OrderedBall& each) { return std::pair(each.ball.center.z, each.light); });
  }

  // The balls that reach the slice's depths, in their order.
  void find_reaching(int z) {
    const std::vector<float>& depths = grid_->screen().slices.boundaries;
    const float near = depths[static_cast<std::size_t>(z)], far = depths[static_cast<std::size_t>(z) + 1];
    reaching_.clear();
    for (const OrderedBall& each : balls_) {
      const float depth = -each.ball.center.z;
      if (depth - each.ball.radius <= far && depth + each.ball.radius >= near) reaching_.push_back(each);
    }
  }

  // The box around a cell of even tiles, as in a perspective whose middle is the view axis.
  geom::Box box_of(const Vec3i& at) const {
    const grid::Tiles& tiles = grid_->screen().tiles;
    const std::vector<float>& depths = grid_->screen().slices.boundaries;
    const float near = depths[static_cast<std::size_t>(at.z)], far = depths[static_cast<std::size_t>(at.z) + 1];
    const float half_width = 0.5f * (tiles.x.back() - tiles.x.front());
    const float half_height = 0.5f * (tiles.y.front() - tiles.y.back());
    const auto side = [](int tile, int count) {
      return 2.0f * static_cast<float>(tile) / static_cast<float>(count) - 1.0f;
    };
    const float left = half_width * side(at.x, tiles.count.x), right = half_width * side(at.x + 1, tiles.count.x);
    const float top = -half_height * side(at.y, tiles.count.y), bottom = -half_height * side(at.y + 1, tiles.count.y);
    return {{std::min(left * near, left * far), std::min(bottom * near, bottom * far), -far},
            {std::max(right * near, right * far), std::max(top * near, top * far), -near}};
  }

  void add_cell(const geom::Box& box, Lists& out) {
    const std::size_t begin = out.lights.size();
    for (const OrderedBall& each : reaching_) {
      if (out.lights.size() - begin >= most_) break;
      ++tests_;
      if (geom::ball_touches_box(each.ball, box)) out.lights.push_back(each.light);
    }
    std::sort(out.lights.begin() + static_cast<std::ptrdiff_t>(begin), out.lights.end());
    check_memory("pairs of light lists", out.lights.size(), sizeof(std::uint32_t));
    check_pair_count(out.lights.size());
    out.begin.push_back(out.pair_count());
  }

  std::size_t most_;
  const grid::Grid* grid_ = nullptr;
  std::vector<OrderedBall> balls_, reaching_;
  std::uint64_t tests_ = 0;
};

}  // namespace

extern const AssignerDescriptor three_js_boxes_descriptor;
const AssignerDescriptor three_js_boxes_descriptor{
    .name = "three-js-boxes",
    .summary =
        "every light against the boxes of even tiles, which are looked up by whole pixels; a full cell keeps the "
        "farthest lights",
    .source = "three.js, ClusteredLightsNode (r187), which loses lights",
    .kinds = {grid::Kind::frustum},
    .conservative = false,
    .all_pairs = true,
    .naive = true,
    .by_name = true,
    .params = {{.name = "most",
                .summary = "lights that a cell keeps, the farthest ones",
                .default_value = 64.0,
                .unit = "lights",
                .min = 1.0,
                .max = 65535.0,
                .choices = {},
                .whole = true}},
    .make = make_list_assigner<ThreeJsBoxes>,
};

}  // namespace clusterbench::assign
