#include "assign/box_rows.h"

namespace clusterbench::assign {
namespace {

// Takes rows of touched boxes, leaves out holes and what the cone misses.
class RowSink {
 public:
  RowSink(const BoxGrid& boxes, const CellBalls& cell_balls, std::uint32_t light, const geom::SphericalCone* cone,
          PairBuffer& pairs, std::uint64_t& tests)
      : boxes_(boxes), cell_balls_(cell_balls), light_(light), cone_(cone), pairs_(pairs), tests_(tests) {}

  void add_row(int y, int z, int first, int last) {
    if (!boxes_.hole_y.holds(y) || !boxes_.hole_z.holds(z)) return add_solid(y, z, first, last);
    add_solid(y, z, first, std::min(last, boxes_.hole_x.first - 1));
    add_solid(y, z, std::max(first, boxes_.hole_x.last + 1), last);
  }

 private:
  void add_solid(int y, int z, int first, int last) {
    if (first > last) return;
    const std::size_t row = static_cast<std::size_t>(z) * boxes_.y.size() + static_cast<std::size_t>(y);
    const auto row_start = boxes_.first_cell + static_cast<std::uint32_t>(row * boxes_.x.size());
    if (cone_ == nullptr) {
      pairs_.add_row(row_start + static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first + 1),
                     light_);
      return;
    }
    for (int x = first; x <= last; ++x) {
      const std::uint32_t cell = row_start + static_cast<std::uint32_t>(x);
      ++tests_;
      if (geom::cone_touches_ball(*cone_, cell_balls_[cell])) pairs_.add(cell, light_);
    }
  }

  const BoxGrid& boxes_;
  const CellBalls& cell_balls_;
  std::uint32_t light_;
  const geom::SphericalCone* cone_;
  PairBuffer& pairs_;
  std::uint64_t& tests_;
};

}  // namespace

IndexRange indices_within(const BoxAxis& axis, float place, float r) {
  if (axis.empty()) return {};
  const bool ascending = axis.front().lo <= axis.back().lo;
  // Both differences are monotonous along the axis, in single precision too.
  const auto before = [&](const Interval& extent) { return (ascending ? place - extent.hi : extent.lo - place) > r; };
  const auto not_beyond = [&](const Interval& extent) {
    return !((ascending ? extent.lo - place : place - extent.hi) > r);
  };
  const auto first = std::partition_point(axis.begin(), axis.end(), before);
  const auto end = std::partition_point(first, axis.end(), not_beyond);
  return {static_cast<int>(first - axis.begin()), static_cast<int>(end - axis.begin()) - 1};
}

void add_light(const BoxGrid& boxes, const CellBalls& cell_balls, const view::LightArrays& lights, std::uint32_t light,
               SpotTest spot, PairBuffer& pairs, std::uint64_t& tests) {
  if (!(lights.padded_radius[light] > 0.0f)) return;
  const bool test_cone = lights.is_spot(light) && spot != SpotTest::ball;
  const geom::SphericalCone cone = test_cone ? lights.cone(light) : geom::SphericalCone{};
  RowSink sink(boxes, cell_balls, light, test_cone ? &cone : nullptr, pairs, tests);
  for_each_row_touched(boxes, ball_for(lights, light, spot), tests,
                       [&](int y, int z, int first, int last) { sink.add_row(y, z, first, last); });
}

}  // namespace clusterbench::assign
