#include "assign/cone/cone_against_cell_spheres.h"

#include <cmath>
#include <limits>

#include "assign/simd/lanes.h"
#include "core/arrays.h"
#include "core/memory.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/cone/cone_against_cell_spheres.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 8>;  // rows are short: longer vectors would hold few cells and cost more
using V = hn::Vec<D>;

V all(float value) {
  return Set(D(), value);
}

struct Vector {
  V x, y, z;
};

HWY_INLINE V dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE V length(const Vector& a) {
  return Sqrt(dot(a, a));
}

class Cone {
 public:
  HWY_INLINE explicit Cone(const geom::SphericalCone& cone)
      : apex_{all(cone.apex.x), all(cone.apex.y), all(cone.apex.z)},
        axis_{all(cone.axis.x), all(cone.axis.y), all(cone.axis.z)},
        range_(all(cone.range)),
        cos_angle_(all(cone.cos_angle)),
        sin_angle_(all(cone.sin_angle)),
        apex_size_(all(std::fabs(cone.apex.x) + std::fabs(cone.apex.y) + std::fabs(cone.apex.z))) {}

  HWY_INLINE hn::Mask<D> touches(const CellBalls& cells, std::size_t cell) const {
    const D d;
    const auto at = [&](const std::vector<float>& list) { return LoadU(d, list.data() + cell); };
    const Vector to_center{at(cells.x) - apex_.x, at(cells.y) - apex_.y, at(cells.z) - apex_.z};
    const V along = dot(to_center, axis_), radius = at(cells.radius);
    const V across =
        length({to_center.x - along * axis_.x, to_center.y - along * axis_.y, to_center.z - along * axis_.z});
    const V reach = radius + all(0x1p-20f) * (apex_size_ + at(cells.size));
    const V farthest = range_ + reach;
    const auto beside = cos_angle_ * across - sin_angle_ * along > reach;
    const auto beyond = Or(along > farthest, length(to_center) > farthest);
    const auto behind = along < Neg(reach);
    const auto is_endless = radius == all(std::numeric_limits<float>::infinity());
    return Or(is_endless, Not(Or(beside, Or(beyond, behind))));
  }

 private:
  Vector apex_, axis_;
  V range_, cos_angle_, sin_angle_, apex_size_;
};

std::uint64_t touched_of(const CellRun& run, const Cone& cone, const CellBalls& cells) {
  const D d;
  const auto lanes = static_cast<std::uint32_t>(Lanes(d));
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < run.count; i += lanes) {
    std::uint8_t bytes[8] = {};
    StoreMaskBits(d, cone.touches(cells, std::size_t{run.cell} + i), bytes);
    for (std::uint32_t byte = 0; 8 * byte < lanes; ++byte) bits |= std::uint64_t{bytes[byte]} << (i + 8 * byte);
  }
  return run.count < 64 ? bits & ((std::uint64_t{1} << run.count) - 1) : bits;
}

void touched_cells(const geom::SphericalCone& given, const CellBalls& cells, std::span<const CellRun> runs,
                   std::uint64_t* touched) {
  const Cone cone(given);
  for (std::size_t i = 0; i < runs.size(); ++i) touched[i] = touched_of(runs[i], cone, cells);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(touched_cells);

CellBalls::CellBalls(std::span<const geom::Ball> balls) {
  const std::size_t padded = balls.size() + k_most_lanes;
  check_memory("balls around cells, side by side", padded, 5 * sizeof(float));
  grow_to(padded, x, y, z, radius, size);
  for (std::size_t cell = 0; cell < balls.size(); ++cell) {
    const Vec3f& center = balls[cell].center;
    x[cell] = center.x;
    y[cell] = center.y;
    z[cell] = center.z;
    radius[cell] = balls[cell].radius;
    size[cell] = std::fabs(center.x) + std::fabs(center.y) + std::fabs(center.z);
  }
}

std::size_t CellBalls::capacity_bytes() const {
  return bytes_of(x, y, z, radius, size);
}

void find_touched_cells(const geom::SphericalCone& cone, const CellBalls& cells, std::span<const CellRun> runs,
                        std::vector<std::uint64_t>& touched) {
  if (touched.size() < runs.size()) touched.resize(runs.size());
  HWY_DYNAMIC_DISPATCH(touched_cells)(cone, cells, runs, touched.data());
}

}  // namespace clusterbench::assign
#endif
