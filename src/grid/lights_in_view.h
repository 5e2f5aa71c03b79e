#pragma once
// Which lights of a frame are in its view, and the box around them in the world.

#include <array>
#include <optional>
#include <vector>

#include "view/frame.h"

namespace clusterbench::grid {

Vec3d in_view_space(const view::Frame& frame, const scene::WorldLight& light);

// The half-spaces of a camera's near and far planes and of the picture's sides.
class ViewPlanes {
 public:
  // `projection` must outlive this object.
  explicit ViewPlanes(const view::Projection& projection);

  // Whether a ball (centre in view space) reaches into all of them. A ball outside of an edge or a corner of the view
  // can be accepted wrongly.
  bool may_see(const Vec3d& center, double radius) const;

 private:
  const view::Projection& projection_;
  std::array<double, 4> length_;  // of normals: left, right, bottom, top
};

// The ball around a light: for a spot, the smallest one around its sphere-capped cone.
struct WorldBall {
  Vec3d center{0.0};
  double radius_m = 0.0;
};
WorldBall ball_around(const scene::WorldLight& light);

// Whether a light is in view: the ball around it reaches into the half-spaces of the camera's six planes, as in a
// frustum cull of lights. A ball outside of an edge or a corner can be accepted wrongly. A light of range 0 is never in
// view, one without an end always. All limits use this definition: counts of lights in view, tiles and boxes that
// follow these lights, and the pre-cull `frustum` (in single precision, padded).
bool is_in_view(const view::Frame& frame, const scene::WorldLight& light);
// The same of each light of the frame.
std::vector<bool> lights_in_view(const view::Frame& frame);

// An upper bound of the roundoffs of view transform and angles, in metres.
double slack_of(const Vec3d& center, double range_m);

struct WorldBox {
  Vec3d lo{0.0}, hi{0.0};
};

// The box around one light's volume: for a point its ball, for a spot the cylinder around its sphere-capped cone.
// PlayCanvas uses a box around the cone that is turned with the light; the cylinder does not depend on the light's roll
// and is never larger. Only for a light with an end; may be larger by slack_of().
WorldBox box_around(const scene::WorldLight& light);

// The box around the lights in view, which contains every point in view that one of them reaches. No light: a box
// without extent at the origin. nullopt if a light in view has no end: then no box contains it.
std::optional<WorldBox> box_around_lights_in_view(const view::Frame& frame);

}  // namespace clusterbench::grid
