// What each comparison of a ball and a cell loses in single precision is covered by the roundoffs that it derives for
// itself: tried on balls that single precision holds exactly and that reach their cell by less than one step of the
// radius. In lists the padding for the light's rounded centre, which lies on top, hides a padding that is too small.

#include <functional>
#include <limits>

#include "assign/bounds/bounds_method.h"
#include "assign/box_grid/box_rows.h"
#include "assign/settings.h"
#include "geom/single_precision/bounding_volumes.h"

namespace clusterbench::assign::testing {
namespace {

// A method's comparison: the true distance from a place to a cell, and what the method says.
struct Comparison {
  float roundoffs;
  std::function<double(std::uint32_t cell, const Vec3d& place)> distance;
  std::function<bool(std::uint32_t cell, const geom::Ball& ball)> touches;
};

geom::Ball padded(const geom::Ball& ball, float roundoffs) {
  view::LightArrays lights;
  static_cast<view::LightRanges&>(lights) = {1, 0};
  lights.x = {ball.center.x};
  lights.y = {ball.center.y};
  lights.z = {ball.center.z};
  lights.radius = {ball.radius};
  lights.reach = {std::fabs(ball.center.x) + std::fabs(ball.center.y) + std::fabs(ball.center.z) + ball.radius};
  return lights.ball(0, roundoffs);
}

// The balls of 20,000 that are lost without padding; with it none may be.
int lost_without_padding(const Comparison& comparison, const std::vector<geom::Box>& cells) {
  Random random(61);
  int lost_without = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto cell = static_cast<std::uint32_t>(random.unit() * static_cast<double>(cells.size()));
    const Vec3d middle = 0.5 * (Vec3d(cells[cell].lo) + Vec3d(cells[cell].hi));
    const double size = glm::length(Vec3d(cells[cell].hi) - middle) * random.log_between(1, 20);
    const Vec3f center(middle + size * random.direction());
    const double distance = comparison.distance(cell, Vec3d(center)) * (1 + 1e-15);
    if (distance <= 0.0) continue;
    geom::Ball ball{center, static_cast<float>(distance)};
    if (static_cast<double>(ball.radius) < distance)
      ball.radius = std::nextafter(ball.radius, std::numeric_limits<float>::infinity());
    EXPECT_TRUE(comparison.touches(cell, padded(ball, comparison.roundoffs))) << "cell " << cell << ", ball " << i;
    lost_without += !comparison.touches(cell, ball);
  }
  return lost_without;
}

double distance_to(const geom::Box& box, const Vec3d& p) {
  return glm::length(glm::max(Vec3d(0), glm::max(Vec3d(box.lo) - p, p - Vec3d(box.hi))));
}

// How far p lies beyond the farthest plane of a cell; negative inside.
double height_above(const geom::FrustumCell& cell, const Vec3d& p) {
  const double depth = -p.z, scale = cell.orthographic ? 1.0 : depth;
  const auto beside = [&](double place, double slope) {
    return (place - slope * scale) / (cell.orthographic ? 1.0 : std::hypot(1.0, slope));
  };
  return std::max({cell.depth0 - depth, depth - cell.depth1, -beside(p.x, cell.x0), beside(p.x, cell.x1),
                   -beside(p.y, cell.y0), beside(p.y, cell.y1)});
}

TEST(Padding, of_boxes_and_planes_around_frustum_cells_covers_what_their_comparison_loses) {
  int lost_by_boxes = 0, lost_by_planes = 0;  // over all views: planes along the axes lose nothing
  for (const Setting& setting : settings_for(*find_assigner("aabb"), 1)) {
    CellAabbs aabbs;
    CellPlanes planes;
    aabbs.build(setting.grid);
    planes.build(setting.grid);
    std::vector<geom::Box> cells;
    for (std::uint32_t cell = 0; cell < setting.grid.cell_count(); ++cell)
      cells.push_back(geom::box_around(std::get<geom::FrustumCell>(setting.grid.cell(cell))));
    const auto height = [&](std::uint32_t cell, const Vec3d& place) {
      return height_above(std::get<geom::FrustumCell>(setting.grid.cell(cell)), place);
    };
    lost_by_boxes += lost_without_padding(
        {CellAabbs::k_roundoffs, [&](std::uint32_t cell, const Vec3d& p) { return distance_to(cells[cell], p); },
         [&](std::uint32_t cell, const geom::Ball& ball) { return aabbs.touches(ball, cell); }},
        cells);
    lost_by_planes +=
        lost_without_padding({CellPlanes::k_roundoffs, height,
                              [&](std::uint32_t cell, const geom::Ball& ball) { return planes.touches(ball, cell); }},
                             cells);
  }
  EXPECT_GT(lost_by_boxes, 10);
  EXPECT_GT(lost_by_planes, 10);
}

TEST(Padding, of_rows_of_boxes_covers_what_their_comparison_loses) {
  BoxGrid boxes;
  Random random(62);
  for (BoxAxis* axis : {&boxes.x, &boxes.y, &boxes.z})
    for (auto [i, at] = std::pair(0, -20.0f); i < 6; ++i) {
      const float next = at + static_cast<float>(random.between(1, 9));
      axis->push_back({at, next});
      at = next;
    }
  std::vector<geom::Box> cells;
  for (const Interval& z : boxes.z)
    for (const Interval& y : boxes.y)
      for (const Interval& x : boxes.x) cells.push_back({{x.lo, y.lo, z.lo}, {x.hi, y.hi, z.hi}});
  const auto touches = [&](std::uint32_t cell, const geom::Ball& ball) {
    const int column = static_cast<int>(cell % 6), row = static_cast<int>(cell / 6 % 6),
              layer = static_cast<int>(cell / 36);
    bool is_in_row = false;
    std::uint64_t tests = 0;
    for_each_row_touched(boxes, ball, tests, [&](int y, int z, int first, int last) {
      is_in_row = is_in_row || (y == row && z == layer && first <= column && column <= last);
    });
    return is_in_row;
  };
  const Comparison comparison{k_box_roundoffs,
                              [&](std::uint32_t cell, const Vec3d& p) { return distance_to(cells[cell], p); }, touches};
  EXPECT_GT(lost_without_padding(comparison, cells), 10);
}

// Whole numbers, so that single precision loses nothing.
TEST(IndicesWithin, hold_boxes_that_end_or_begin_just_where_the_range_does) {
  const BoxAxis ascending{{0, 2}, {2, 4}, {4, 6}, {6, 8}}, descending{{6, 8}, {4, 6}, {2, 4}, {0, 2}};
  for (const BoxAxis& axis : {ascending, descending}) {
    EXPECT_EQ(indices_within(axis, 5, 1).count(), 3);
    EXPECT_EQ(indices_within(axis, 5, 0.75f).count(), 1);
    EXPECT_EQ(indices_within(axis, -3, 3).count(), 1);
    EXPECT_EQ(indices_within(axis, 11, 3).count(), 1);
    EXPECT_TRUE(indices_within(axis, 11, 2.75f).empty());
    EXPECT_TRUE(indices_within(axis, -3, 2.75f).empty());
  }
}

}  // namespace
}  // namespace clusterbench::assign::testing
