#pragma once
// Lights that reach into a known cell by a hair: made from a point of the cell's surface and a direction out of the
// cell.

#include <vector>

#include "assign/dense_check.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::assign::testing {

struct TouchingLight {
  scene::WorldLight light;
  std::uint32_t cell;  // must list it
};

namespace touching {

// A point of a cell's surface, a point of the cell beside it, and a direction that leads out of the cell there.
struct Contact {
  Vec3d point, inside, outward;
};

// On each axis: inside (0), at the lower side (-1) or at the upper side (1), at least one of them at a side.
inline Vec3i random_sides(Random& random) {
  Vec3i sides{0};
  while (sides == Vec3i{0})
    for (int axis = 0; axis < 3; ++axis) sides[axis] = static_cast<int>(random.between(0, 3)) - 1;
  return sides;
}

// A place between the lower and upper sides, on those sides that are asked for.
inline Vec3d place_on(const Vec3i& sides, const Vec3d& lo, const Vec3d& hi, Random& random) {
  Vec3d place{0};
  for (int axis = 0; axis < 3; ++axis)
    place[axis] = sides[axis] == 0 ? random.between(lo[axis], hi[axis]) : sides[axis] < 0 ? lo[axis] : hi[axis];
  return place;
}

inline Vec3d beside(const Vec3d& place, const Vec3d& lo, const Vec3d& hi) {
  return glm::mix(place, 0.5 * (lo + hi), 1e-8);
}

// The sum of the outward normals of the sides that the point is on, with random weights: a direction of the normal
// cone.
inline Vec3d blend(const Vec3i& sides, const Vec3d (&lower)[3], const Vec3d (&upper)[3], Random& random) {
  Vec3d sum{0};
  for (int axis = 0; axis < 3; ++axis)
    if (sides[axis] != 0) sum += random.between(0.05, 1) * glm::normalize(sides[axis] < 0 ? lower[axis] : upper[axis]);
  return glm::normalize(sum);
}

inline Contact contact_of(const geom::FrustumCell& cell, Random& random) {
  const Vec3i sides = random_sides(random);
  const Vec3d lo{cell.x0, cell.y0, cell.depth0}, hi{cell.x1, cell.y1, cell.depth1};
  const auto point = [&](const Vec3d& q) {
    const double scale = cell.orthographic ? 1.0 : q.z;
    return Vec3d{q.x * scale, q.y * scale, -q.z};
  };
  const double tilt = cell.orthographic ? 0.0 : 1.0;
  const Vec3d lower[3] = {{-1, 0, -tilt * cell.x0}, {0, -1, -tilt * cell.y0}, {0, 0, 1}};
  const Vec3d upper[3] = {{1, 0, tilt * cell.x1}, {0, 1, tilt * cell.y1}, {0, 0, -1}};
  const Vec3d q = place_on(sides, lo, hi, random);
  return {point(q), point(beside(q, lo, hi)), blend(sides, lower, upper, random)};
}

inline Contact contact_of(const geom::ShellCell& cell, Random& random) {
  const Vec3i sides = random_sides(random);
  const Vec3d lo{cell.x0, cell.y0, cell.distance0}, hi{cell.x1, cell.y1, cell.distance1};
  const auto ray = [](const Vec3d& q) { return glm::normalize(Vec3d{q.x, q.y, -1}); };
  const Vec3d q = place_on(sides, lo, hi, random), inside = beside(q, lo, hi);
  const Vec3d lower[3] = {{-1, 0, -cell.x0}, {0, -1, -cell.y0}, -ray(q)};
  const Vec3d upper[3] = {{1, 0, cell.x1}, {0, 1, cell.y1}, ray(q)};
  return {q.z * ray(q), inside.z * ray(inside), blend(sides, lower, upper, random)};
}

inline Contact contact_of(const geom::Box& cell, Random& random) {
  const Vec3i sides = random_sides(random);
  const Vec3d lo(cell.lo), hi(cell.hi), q = place_on(sides, lo, hi, random);
  const Vec3d lower[3] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, upper[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return {q, beside(q, lo, hi), blend(sides, lower, upper, random)};
}

inline std::uint32_t random_cell(const grid::Grid& grid, Random& random) {
  while (true) {
    const auto cell = static_cast<std::uint32_t>(random.unit() * grid.cell_count());
    if (!grid.is_hole(cell)) return cell;
  }
}

// Beyond what double precision loses of the numbers on the way.
inline double hair(double size, Random& random) {
  return size * random.log_between(1e-13, 1e-6);
}

inline Vec3d turned(const Vec3d& direction, double angle, Random& random) {
  const Vec3d side = glm::normalize(glm::cross(direction, random.direction()));
  return std::cos(angle) * direction + std::sin(angle) * side;
}

struct Place {
  Contact contact;
  std::uint32_t cell;
  double size;   // of the numbers that lead to the light's world position
  double range;  // of the light
};

// `longer`: times that the light's usual range.
inline Place random_place(const grid::Grid& grid, const view::Space& space, Random& random, double longer = 1.0) {
  const std::uint32_t cell = random_cell(grid, random);
  const Contact contact = std::visit([&](const auto& shape) { return contact_of(shape, random); }, grid.cell(cell));
  const double range = longer * random.log_between(0.05, 80);
  return {contact, cell, glm::length(contact.point) + glm::length(space.origin) + range, range};
}

inline Vec3d in_world(const Vec3d& local, const view::Space& space) {
  return glm::transpose(space.rotation) * local + space.origin;
}

}  // namespace touching

// How far the lights reach in goes from what double precision can tell to 1e-6 of their size.
inline std::vector<TouchingLight> touching_points(const grid::Grid& grid, const view::Space& space, int count,
                                                  std::uint64_t seed) {
  Random random(seed);
  std::vector<TouchingLight> lights;
  for (int i = 0; i < count; ++i) {
    const touching::Place place = touching::random_place(grid, space, random);
    const Vec3d center = place.contact.point + place.range * place.contact.outward;
    lights.push_back(
        {point_light(touching::in_world(center, space), place.range + touching::hair(place.size, random)), place.cell});
  }
  return lights;
}

// Spots touch by their apex, their cap or their side.
inline std::vector<TouchingLight> touching_spots(const grid::Grid& grid, const view::Space& space, int count,
                                                 std::uint64_t seed, double longer = 1.0) {
  Random random(seed);
  std::vector<TouchingLight> lights;
  constexpr double k_half_angles[] = {1e-3, 0.1, 0.5, M_PI / 4, 1.0, 1.5};
  for (int i = 0; i < count; ++i) {
    const touching::Place place = touching::random_place(grid, space, random, longer);
    const Vec3d& out = place.contact.outward;
    const double angle = k_half_angles[i % 6];
    const double slack = touching::hair(place.size, random);
    Vec3d apex = place.contact.inside, axis = touching::turned(out, random.between(0, 0.4), random);
    if (i % 3 == 1) {  // by the cap: the point is at the end of the range, within the angle
      apex = place.contact.point + place.range * out;
      axis = touching::turned(-out, angle * random.between(0, 0.999), random);
    } else if (i % 3 == 2) {  // by the side: the point is on a generator, within the range
      const double along = place.range * random.between(0.1, 0.9);
      apex = place.contact.point + along * touching::turned(out, random.between(0, 1), random);
      const Vec3d towards = glm::normalize(place.contact.point - apex);
      axis = touching::turned(towards, std::max(0.0, angle - 2 * slack / along), random);
    }
    lights.push_back(
        {spot_light(touching::in_world(apex, space), place.range + slack, glm::transpose(space.rotation) * axis, angle),
         place.cell});
  }
  return lights;
}

// Boxes touch by a corner or, where their half axes are orthogonal to the way out, by an edge or a face.
inline std::vector<TouchingLight> touching_boxes(const grid::Grid& grid, const view::Space& space, int count,
                                                 std::uint64_t seed) {
  Random random(seed);
  std::vector<TouchingLight> lights;
  for (int i = 0; i < count; ++i) {
    const touching::Place place = touching::random_place(grid, space, random);
    const Vec3d& out = place.contact.outward;
    const Vec3d x = i % 3 == 0 ? random.direction() : out;
    const Vec3d y = glm::normalize(glm::cross(x, random.direction())), z = glm::cross(x, y);
    std::array<Vec3d, 3> axes{place.range * x, random.log_between(1e-3, 1) * place.range * y,
                              i % 7 == 0 ? Vec3d(0) : random.log_between(1e-3, 1) * place.range * z};
    if (i % 5 == 0) axes[1] += 0.5 * axes[0];  // sheared
    // The corner that is the least far out stands at the place, a hair further in.
    Vec3d corner{0};
    for (const Vec3d& axis : axes) corner -= glm::dot(axis, out) < 0.0 ? -axis : axis;
    const Vec3d beside = place.contact.inside - place.contact.point;
    const double hair = std::min(10.0 * touching::hair(place.size, random), 1e7 * glm::length(beside));
    const Vec3d middle = place.contact.point + hair * glm::normalize(beside) - corner;
    for (Vec3d& axis : axes) axis = glm::transpose(space.rotation) * axis;
    lights.push_back({box_light(touching::in_world(middle, space), axes), place.cell});
  }
  return lights;
}

}  // namespace clusterbench::assign::testing
