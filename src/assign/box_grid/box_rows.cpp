#include "assign/box_grid/box_rows.h"

namespace clusterbench::assign {
namespace {

// Receives rows of touched boxes and leaves out holes.
class RowSink {
 public:
  RowSink(const BoxGrid& boxes, const LightTest& test, const TestedLight& light, PairBuffer& pairs,
          std::uint64_t& tests)
      : boxes_(boxes), test_(test), light_(light), pairs_(pairs), tests_(tests) {}

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
    test_.add_row(light_, row_start + static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first + 1),
                  pairs_, tests_);
  }

  const BoxGrid& boxes_;
  const LightTest& test_;
  const TestedLight& light_;
  PairBuffer& pairs_;
  std::uint64_t& tests_;
};

}  // namespace

IndexRange indices_within(const BoxAxis& axis, float coordinate, float r) {
  if (axis.empty()) return {};
  const bool ascending = axis.front().lo <= axis.back().lo;
  // Both differences are monotonic along the axis, in single precision too.
  const auto before = [&](const Interval& extent) {
    return (ascending ? coordinate - extent.hi : extent.lo - coordinate) > r;
  };
  const auto not_beyond = [&](const Interval& extent) {
    return !((ascending ? extent.lo - coordinate : coordinate - extent.hi) > r);
  };
  const auto first = std::partition_point(axis.begin(), axis.end(), before);
  const auto end = std::partition_point(first, axis.end(), not_beyond);
  return {static_cast<int>(first - axis.begin()), static_cast<int>(end - axis.begin()) - 1};
}

void add_boxes(const BoxGrid& boxes, const LightTest& test, const TestedLight& light, PairBuffer& pairs,
               std::uint64_t& tests) {
  RowSink sink(boxes, test, light, pairs, tests);
  for_each_row_touched(boxes, light.ball, tests,
                       [&](int y, int z, int first, int last) { sink.add_row(y, z, first, last); });
}

}  // namespace clusterbench::assign
