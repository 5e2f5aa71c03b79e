#include <limits>

#include "assign/dense_check.h"

namespace clusterbench::assign::testing {
namespace {

grid::Grid boxes_over(const view::Frame& frame, Vec3i cells) {
  grid::GridSpec spec;
  spec.kind = grid::Kind::world;
  spec.cells = cells;
  spec.has_bounds = true;
  spec.bounds_lo_m = Vec3d{-64, -32, -256};
  spec.bounds_hi_m = Vec3d{64, 32, 0};
  return grid_of(spec, frame);
}

view::Frame lit_by(std::vector<scene::WorldLight> lights) {
  return frame_of(perspective(M_PI / 3, 16.0 / 9.0, 0.1, 400), {1920, 1080}, std::move(lights));
}

Lists light_boxes(const view::Frame& frame, const grid::Grid& grid, const std::string& upper_end) {
  return lists_by("light-boxes", frame, grid, {{"upper_end", upper_end}});
}

// By drawn points of the cylinder around the light's volume: its farthest ones in both directions along an axis.
Vec3d half_extent_of_ring(const scene::WorldLight& light) {
  Vec3d most(0.0);
  const Vec3d any = std::abs(light.direction.x) < 0.9 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  const Vec3d u = glm::normalize(glm::cross(light.direction, any)), v = glm::cross(light.direction, u);
  constexpr int k_points = 20000;
  for (int i = 0; i < k_points; ++i) {
    const double angle = 2 * M_PI * i / k_points;
    most = glm::max(most, glm::abs(std::cos(angle) * u + std::sin(angle) * v));
  }
  return most * light.range_m * std::sin(light.outer_cone_rad);
}

struct Box {
  Vec3d lo, hi;
};

Box box_of(const scene::WorldLight& light) {
  if (light.type == scene::LightType::point) return {light.position - light.range_m, light.position + light.range_m};
  const Vec3d ring = half_extent_of_ring(light), end = light.position + light.range_m * light.direction;
  return {glm::min(light.position, end) - ring, glm::max(light.position, end) + ring};
}

TEST(LightBoxes, list_the_cells_that_a_lights_box_meets_and_as_playcanvas_the_ones_after) {
  const Vec3i cells{16, 8, 32};  // of 8 m
  const view::Frame frame = lit_by(random_lights(60, 60, 41));
  const grid::Grid grid = boxes_over(frame, cells);
  const Lists tight = light_boxes(frame, grid, "floor"), as_shipped = light_boxes(frame, grid, "ceil");
  const auto holds = [](const Lists& lists, std::uint32_t cell, std::uint32_t light) {
    const auto list = lists.of(cell);
    return std::find(list.begin(), list.end(), light) != list.end();
  };
  int more = 0;
  for (std::uint32_t light = 0; light < frame.lights.size(); ++light) {
    const Box box = box_of(frame.lights[light]);
    const Vec3d lo = (box.lo - Vec3d{-64, -32, -256}) / 8.0, hi = (box.hi - Vec3d{-64, -32, -256}) / 8.0;
    const Vec3d off = glm::min(glm::abs(lo - glm::round(lo)), glm::abs(hi - glm::round(hi)));
    if (std::min({off.x, off.y, off.z}) < 1e-5) continue;  // too close to a boundary to call
    for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
      const Vec3d at(grid.cell_at(cell));
      bool meets = true, is_shipped = true;
      for (int i = 0; i < 3; ++i) {
        const bool reaches_grid = lo[i] < cells[i] && hi[i] > 0.0;
        meets = meets && reaches_grid && at[i] >= std::floor(lo[i]) && at[i] <= std::floor(hi[i]);
        is_shipped = is_shipped && reaches_grid && at[i] >= std::floor(lo[i]) && at[i] <= std::ceil(hi[i]);
      }
      EXPECT_EQ(holds(tight, cell, light), meets) << cell << " " << light;
      EXPECT_EQ(holds(as_shipped, cell, light), is_shipped) << cell << " " << light;
      more += is_shipped && !meets ? 1 : 0;
    }
  }
  EXPECT_GT(more, 100);
}

TEST(LightBoxes, hold_every_drawn_point_of_random_points_and_spots) {
  const view::Frame frame = lit_by(random_lights(100, 150, 42));
  const grid::Grid grid = boxes_over(frame, {32, 8, 40});
  EXPECT_EQ(count_misses(frame, grid, light_boxes(frame, grid, "floor"), 2000, 43), 0);
}

TEST(LightBoxes, list_a_light_on_both_sides_of_a_boundary_that_its_box_touches) {
  const view::Frame frame = lit_by({point_light({10, 0, -100}, 10)});
  const grid::Grid grid = boxes_over(frame, {2, 1, 1});
  EXPECT_EQ(light_boxes(frame, grid, "floor").lights, (std::vector<std::uint32_t>{0, 0}));
}

TEST(LightBoxes, take_a_light_without_end_everywhere_and_one_without_volume_nowhere) {
  const view::Frame frame =
      lit_by({point_light({0, 0, -10}, std::numeric_limits<double>::infinity()), point_light({0, 0, -10}, 0),
              spot_light({0, 0, -10}, std::numeric_limits<double>::infinity(), {0, 0, 1}, 0.1)});
  const grid::Grid grid = boxes_over(frame, {2, 1, 1});
  EXPECT_EQ(light_boxes(frame, grid, "floor").lights, (std::vector<std::uint32_t>{0, 2, 0, 2}));
}

}  // namespace
}  // namespace clusterbench::assign::testing
