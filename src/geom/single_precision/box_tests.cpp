#include "geom/single_precision/box_tests.h"

#include <algorithm>
#include <cmath>

#include "geom/numbers/round_to_float.h"
#include "geom/single_precision/plane.h"

namespace clusterbench::geom {
namespace {

constexpr float k_roundoff = 0x1p-24f;
// More than the loss of products by underflow.
constexpr float k_smallest = 0x1p-100f;

float dot(const Vec3f& a, const Vec3f& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The extent of a box from its middle along a vector, times the vector's length.
float extent_along(const HalfAxes& axes, const Vec3f& along) {
  return std::fabs(dot(axes[0], along)) + std::fabs(dot(axes[1], along)) + std::fabs(dot(axes[2], along));
}

Vec3f unit_normal(const Vec3f& a, const Vec3f& b) {
  const Vec3d normal = glm::cross(Vec3d(a), Vec3d(b));
  const double size = glm::length(normal);
  return std::isnormal(size) ? Vec3f(normal / size) : Vec3f(0.0f);
}

// Is the box beyond the side x = slope * depth (or y)? Comparisons with NaN are false, so NaN never excludes a box.
bool is_beyond(const PaddedBox& box, float sign, int axis, float slope) {
  const auto outward = [&](const Vec3f& v) { return sign * (v[axis] + slope * v.z); };
  const float extent =
      std::fabs(outward(box.box.axes[0])) + std::fabs(outward(box.box.axes[1])) + std::fabs(outward(box.box.axes[2]));
  return outward(box.box.center) - extent > box.padding * (1.0f + std::fabs(slope)) + k_smallest;
}

// The extent of a cell along a vector, times the vector's length.
struct Interval {
  float lo, hi;

  void include(float value) {
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
};

// The directions and numbers of a frustum cell for the separating-axis test.
struct CellEdges {
  std::array<Vec3f, 6> along;  // the last four: the edges from near to far
  int count;
  float farthest;  // an upper bound of |x| + |y| + |z| of all corners, up to rounding
};

CellEdges edges_of(const FrustumCell& cell) {
  const float x = std::max(std::fabs(cell.x0), std::fabs(cell.x1)),
              y = std::max(std::fabs(cell.y0), std::fabs(cell.y1));
  if (cell.orthographic)
    return {{Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)},
            3,
            x + y + std::max(std::fabs(cell.depth0), std::fabs(cell.depth1))};
  return {{Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(cell.x0, cell.y0, -1), Vec3f(cell.x1, cell.y0, -1),
           Vec3f(cell.x0, cell.y1, -1), Vec3f(cell.x1, cell.y1, -1)},
          6,
          (x + y + 1.0f) * cell.depth1};
}

Interval interval_along(const Vec3f& along, const FrustumCell& cell, const CellEdges& edges) {
  if (cell.orthographic) {
    const float x0 = along.x * cell.x0, x1 = along.x * cell.x1, y0 = along.y * cell.y0, y1 = along.y * cell.y1,
                z0 = -along.z * cell.depth0, z1 = -along.z * cell.depth1;
    return {std::min(x0, x1) + std::min(y0, y1) + std::min(z0, z1),
            std::max(x0, x1) + std::max(y0, y1) + std::max(z0, z1)};
  }
  const float first = dot(along, edges.along[2]);
  Interval rays{first, first};
  for (std::size_t ray = 3; ray < 6; ++ray) rays.include(dot(along, edges.along[ray]));
  Interval cell_interval{rays.lo * cell.depth0, rays.hi * cell.depth0};
  cell_interval.include(rays.lo * cell.depth1);
  cell_interval.include(rays.hi * cell.depth1);
  return cell_interval;
}

// The cell: 3 roundoffs of a ray's projection, 1 of its product with the depth, 2 of the differences.
bool is_apart_along(const Vec3f& along, const PaddedBox& box, const FrustumCell& cell, const CellEdges& edges) {
  constexpr float k_cell_roundoffs = 6.0f;
  const float largest = std::max({std::fabs(along.x), std::fabs(along.y), std::fabs(along.z)});
  const float slack = largest * (box.padding + k_cell_roundoffs * k_roundoff * edges.farthest) + k_smallest;
  const float reach = extent_along(box.box.axes, along) + slack, middle = dot(along, box.box.center);
  const Interval interval = interval_along(along, cell, edges);
  return interval.lo - middle > reach || middle - interval.hi > reach;
}

}  // namespace

PaddedBox padded(const OrientedBox& box, float padding) {
  PaddedBox out;
  out.box = box;
  out.padding = padding;
  for (int axis = 0; axis < 3; ++axis)
    out.extent[axis] =
        std::fabs(box.axes[0][axis]) + std::fabs(box.axes[1][axis]) + std::fabs(box.axes[2][axis]) + padding;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3f& normal = out.across[i] = unit_normal(box.axes[(i + 1) % 3], box.axes[(i + 2) % 3]);
    double extent = padding;
    for (const Vec3f& axis : box.axes) extent += std::abs(glm::dot(Vec3d(normal), Vec3d(axis)));
    out.across_extent[i] = rounded_up(extent);
  }
  return out;
}

bool bounds_touch(const PaddedBox& box, const Box& cell) {
  const Vec3f lo = box.box.center - box.extent, hi = box.box.center + box.extent;
  return !(lo.x > cell.hi.x || lo.y > cell.hi.y || lo.z > cell.hi.z || hi.x < cell.lo.x || hi.y < cell.lo.y ||
           hi.z < cell.lo.z);
}

bool bounds_touch_in_box_space(const PaddedBox& box, const Box& cell) {
  // The differences 1, products 1, sums 2, relative to the summed terms.
  constexpr float k_cell_roundoffs = 6.0f;
  const Vec3f lo = cell.lo - box.box.center, hi = cell.hi - box.box.center;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3f at_lo = box.across[i] * lo, at_hi = box.across[i] * hi;
    const Vec3f least = glm::min(at_lo, at_hi), most = glm::max(at_lo, at_hi);
    const float size = size_of(glm::max(glm::abs(at_lo), glm::abs(at_hi)));
    const float reach = box.across_extent[i] + k_cell_roundoffs * k_roundoff * size;
    if (least.x + least.y + least.z > reach || most.x + most.y + most.z < -reach) return false;
  }
  return true;
}

bool touches_sides(const PaddedBox& box, const FrustumCell& cell) {
  if (cell.orthographic) return true;  // its sides are those of its bounds
  return !is_beyond(box, -1.0f, 0, cell.x0) && !is_beyond(box, 1.0f, 0, cell.x1) &&
         !is_beyond(box, -1.0f, 1, cell.y0) && !is_beyond(box, 1.0f, 1, cell.y1);
}

bool no_axis_separates(const PaddedBox& box, const FrustumCell& cell) {
  const float depth = -box.box.center.z, reach = box.extent.z;
  if (depth + reach < cell.depth0 || depth - reach > cell.depth1) return false;
  if (!touches_sides(box, cell)) return false;
  const CellEdges edges = edges_of(cell);
  for (const Vec3f& normal : box.across)
    if (is_apart_along(normal, box, cell, edges)) return false;
  for (const Vec3f& axis : box.box.axes)
    for (int edge = 0; edge < edges.count; ++edge)
      if (is_apart_along(glm::cross(axis, edges.along[static_cast<std::size_t>(edge)]), box, cell, edges)) return false;
  // Orthographic sides are orthogonal to two edges each.
  if (!cell.orthographic) return true;
  for (int axis = 0; axis < 2; ++axis) {
    Vec3f along(0.0f);
    along[axis] = 1.0f;
    if (is_apart_along(along, box, cell, edges)) return false;
  }
  return true;
}

}  // namespace clusterbench::geom
