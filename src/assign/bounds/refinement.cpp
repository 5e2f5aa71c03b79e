#include "assign/bounds/refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assign/contract/light_test.h"

namespace clusterbench::assign {
namespace {

constexpr float k_inf = std::numeric_limits<float>::infinity();

// The error of support(), as a length, in roundoffs: of the apex 4 for n·apex; of the range 5 for the cosine to the
// axis (n and the axis are rounded, products, sums), 7 for the sine, 2 for either's product with a rounded cos a or sin
// a, so at most sqrt(7² + 9²) < 12 for their sum; 4 for the sums and the product with the range.
float padding_of(const geom::SphericalCone& cone) {
  constexpr float k_support_roundoffs = 16.0f;
  const float size = std::fabs(cone.apex.x) + std::fabs(cone.apex.y) + std::fabs(cone.apex.z) + cone.range;
  return k_support_roundoffs * 0x1p-24f * size;
}

// Largest value of n·p over the cone, n of unit length. The cone's farthest point along n is the ball's if n lies
// within the half-angle of the axis, else the rim's, or the apex if the whole cone leans back.
float support(const geom::SphericalCone& cone, const Vec3f& n) {
  if (!std::isfinite(cone.range)) return k_inf;
  const float along_axis = std::clamp(glm::dot(n, cone.axis), -1.0f, 1.0f);
  // Not from the cosine: close to the axis and its opposite that loses half of the sine's digits, and a half-angle of
  // nearly 90 degrees needs them.
  const float beside_axis = glm::length(glm::cross(n, cone.axis));
  const float steepest =
      along_axis >= cone.cos_angle ? 1.0f : along_axis * cone.cos_angle + beside_axis * cone.sin_angle;
  return glm::dot(n, cone.apex) + cone.range * std::max(0.0f, steepest) + padding_of(cone);
}

// Narrows a range of cells, first..last, from both sides by their boundaries: removes an end cell while the cone lies
// wholly on the other side of its boundary. side(i) is the unit normal of boundary i towards higher indices, and the
// boundary's offset.
struct Side {
  Vec3f normal;
  float offset;
};

template <class SideAt>
void narrow(int& first, int& last, const geom::SphericalCone& cone, SideAt&& side) {
  const auto wholly_beyond = [&](const Side& s) { return s.offset - support(cone, -s.normal) > 0.0f; };
  const auto wholly_before = [&](const Side& s) { return s.offset + support(cone, s.normal) < 0.0f; };
  while (first <= last && wholly_beyond(side(first + 1))) ++first;
  while (first <= last && wholly_before(side(last))) --last;
}

}  // namespace

std::vector<ParamSpec> refinement_params() {
  ParamSpec spot = spot_param();
  spot.summary =
      "how spots are tested. sphere, range, cone-sphere, both: as for other methods; narrowing: both, after the box of "
      "cells is narrowed by planes from six sides";
  spot.default_value = std::string("narrowing");
  spot.choices.emplace_back("narrowing");
  return {spot, inflation_param()};
}

bool narrows(const Params& params) {
  return params.text("spot") == "narrowing";
}

void narrow_from_six_sides(CellBox& box, const geom::SphericalCone& cone, const std::vector<float>& depths,
                           const std::vector<TilePlane>& columns, const std::vector<TilePlane>& rows) {
  narrow(box.first.z, box.last.z, cone, [&](int i) {
    return Side{{0.0f, 0.0f, -1.0f}, -depths[static_cast<std::size_t>(i)]};
  });
  narrow(box.first.x, box.last.x, cone, [&](int i) {
    const TilePlane& plane = columns[static_cast<std::size_t>(i)];
    return Side{{plane.across, 0.0f, -plane.along}, plane.offset};
  });
  narrow(box.first.y, box.last.y, cone, [&](int i) {
    const TilePlane& plane = rows[static_cast<std::size_t>(i)];
    return Side{{0.0f, -plane.across, plane.along}, -plane.offset};
  });
}

}  // namespace clusterbench::assign
