#pragma once
// One camera pose with its projection and viewport, and the lights as a grid's space sees them.

#include <cstdint>
#include <vector>

#include "geom/shapes.h"
#include "geom/vec.h"
#include "scene/camera_path.h"

namespace clusterbench::view {

// The image rectangle in view space: at depth 1 (perspective: slopes) or anywhere (orthographic: metres).
struct Projection {
  bool orthographic = false;
  double left = -1.0, right = 1.0, bottom = -1.0, top = 1.0;
  double near_m = 0.1, far_m = 0.0;  // far may be +inf

  friend bool operator==(const Projection&, const Projection&) = default;
};

// The vertical extent is the lens's, the horizontal one follows from the viewport's aspect ratio (square pixels).
Projection make_projection(const scene::Lens& lens, Vec2i viewport);

// A rigid frame of reference: local = rotation * (world - origin).
struct Space {
  Vec3d origin{0.0};
  Mat3d rotation{1.0};
};

// Lights in a space, single precision, one array per component (what an engine hands to an assigner). Index i is the
// light index of all lists: points first, then spots.
struct LightArrays {
  std::uint32_t points = 0, spots = 0;
  std::vector<float> x, y, z;  // centre or apex
  std::vector<float> radius;   // the range, rounded up
  // The range padded for everything that single precision can lose: rounding of the position and of the usual
  // predicates. Conservative assigners use this one; +inf and 0 stay.
  std::vector<float> padded_radius;
  // Spots only; place i - points. Axis is unit up to rounding.
  std::vector<float> axis_x, axis_y, axis_z, cos_angle, sin_angle;

  std::uint32_t size() const { return points + spots; }
  bool is_spot(std::uint32_t light) const { return light >= points; }
  geom::Ball ball(std::uint32_t light) const;           // padded
  geom::SphericalCone cone(std::uint32_t light) const;  // padded; light must be a spot
};

// A frame: everything in double precision.
struct Frame {
  int index = 0;
  double time_s = 0.0;
  Vec2i viewport{0, 0};
  Projection projection;
  Space view_space;                       // eye and view rotation
  std::vector<scene::WorldLight> lights;  // points first, then spots: the light indices of all lists
  std::uint32_t points = 0;               // how many of them are points
};

Frame make_frame(const scene::Scene& scene, const scene::Shot& shot, int index, Vec2i viewport);

// The frame's lights in a space: the difference to the origin is taken in double, then rounded once.
LightArrays lights_in(const Frame& frame, const Space& space);

}  // namespace clusterbench::view
