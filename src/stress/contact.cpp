#include "stress/contact.h"

#include <algorithm>
#include <cmath>

namespace clusterbench::stress {
namespace {

// One axis of a cell: at the low end, at the high end, or between.
enum class Side { low, high, between };

Side random_side(SplitMix64& random) {
  return static_cast<Side>(random.below(3));
}

double coordinate_on(Side side, double lo, double hi, SplitMix64& random) {
  const double t = random.unit();
  if (side == Side::between) return lo + t * (hi - lo);
  return side == Side::low ? lo : hi;
}

// Adds a random share of a face's outward normal if the point lies on that face.
void lean(Vec3d& outward, Side side, const Vec3d& low, const Vec3d& high, SplitMix64& random) {
  const double share = random.unit() + 1e-3;
  if (side == Side::low) outward += share * low;
  if (side == Side::high) outward += share * high;
}

struct ContactOn {
  SplitMix64& random;

  Contact operator()(const geom::Box& box) const {
    Contact contact;
    contact.outward = Vec3d(0.0);
    const std::uint64_t forced = random.below(3);
    for (int axis = 0; axis < 3; ++axis) {
      Side side = random_side(random);
      if (static_cast<int>(forced) == axis && side == Side::between) side = Side::low;
      contact.point[axis] = coordinate_on(side, box.lo[axis], box.hi[axis], random);
      Vec3d unit(0.0);
      unit[axis] = 1.0;
      lean(contact.outward, side, -unit, unit, random);
    }
    contact.outward = glm::normalize(contact.outward);
    return contact;
  }

  Contact operator()(const geom::FrustumCell& cell) const {
    if (cell.orthographic)
      return (*this)(geom::Box{{cell.x0, cell.y0, -cell.depth1}, {cell.x1, cell.y1, -cell.depth0}});
    Side x = random_side(random), y = random_side(random);
    const Side depth = random_side(random);
    if (x == Side::between && y == Side::between && depth == Side::between) x = Side::high;
    Contact contact =
        on_sides(cell.x0, cell.x1, cell.y0, cell.y1, x, y, coordinate_on(depth, cell.depth0, cell.depth1, random));
    lean(contact.outward, depth, {0, 0, 1}, {0, 0, -1}, random);
    contact.outward = glm::normalize(contact.outward);
    return contact;
  }

  Contact operator()(const geom::ShellCell& cell) const {
    Side x = random_side(random), y = random_side(random);
    const bool on_shell = random.below(2) == 0;
    if (x == Side::between && y == Side::between && !on_shell) x = Side::high;
    Contact contact = on_sides(cell.x0, cell.x1, cell.y0, cell.y1, x, y, 1.0);
    const Vec3d ray = glm::normalize(contact.point);
    const double t = random.unit();
    const double distance = on_shell ? cell.distance1 : cell.distance0 + t * (cell.distance1 - cell.distance0);
    contact.point = distance * ray;
    if (on_shell) contact.outward += (random.unit() + 1e-3) * ray;
    contact.outward = glm::normalize(contact.outward);
    return contact;
  }

  // A point between or on the planes through the eye, with the outward direction that these give.
  Contact on_sides(double x0, double x1, double y0, double y1, Side x, Side y, double depth) const {
    const double sx = coordinate_on(x, x0, x1, random), sy = coordinate_on(y, y0, y1, random);
    Contact contact{{sx * depth, sy * depth, -depth}, Vec3d(0.0)};
    lean(contact.outward, x, {-1, 0, -sx}, {1, 0, sx}, random);
    lean(contact.outward, y, {0, -1, -sy}, {0, 1, sy}, random);
    return contact;
  }
};

}  // namespace

std::uint32_t random_cell(const grid::Grid& grid, SplitMix64& random) {
  while (true) {
    const auto cell = static_cast<std::uint32_t>(random.below(grid.cell_count()));
    if (!grid.is_hole(cell)) return cell;
  }
}

Contact random_contact(const geom::Cell& cell, SplitMix64& random) {
  return std::visit(ContactOn{random}, cell);
}

}  // namespace clusterbench::stress
