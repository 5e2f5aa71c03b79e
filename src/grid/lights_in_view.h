#pragma once
// Which lights of a frame are in its view, and the box around them in the world.

#include <optional>

#include "view/frame.h"

namespace clusterbench::grid {

Vec3d in_view_space(const view::Frame& frame, const scene::WorldLight& light);

// Does a ball (centre in view space) reach into the half-spaces of the camera's near and far planes and of the
// picture's sides? A ball outside of an edge or a corner of the view may seem to.
bool may_be_in_view(const view::Projection& projection, const Vec3d& center, double radius);

// The ball around a light: of a spot, the smallest around its sphere-capped cone.
struct WorldBall {
  Vec3d center{0.0};
  double radius_m = 0.0;
};
WorldBall ball_around(const scene::WorldLight& light);

// Whether a light is in view: the ball around it reaches into the half-spaces of the camera's six planes, as a frustum
// cull of lights asks. One outside of an edge or a corner may. A light of range 0 never is, one without an end always.
// What an engine's limit of lights is held against: counts of lights in view, tiles and boxes that follow these lights,
// and the pre-cull `frustum` (in single precision, padded) all ask this.
bool is_in_view(const view::Frame& frame, const scene::WorldLight& light);

// More than roundoffs of the way to view space and of angles can add up to, in metres.
double slack_of(const Vec3d& center, double range_m);

struct WorldBox {
  Vec3d lo{0.0}, hi{0.0};
};

// Around one light's volume: of a point its ball, of a spot the cylinder around its sphere-capped cone. PlayCanvas
// takes a box around the cone that is turned with the light; the cylinder does not depend on the light's roll and is
// never larger. Only of a light with an end; may be larger by slack_of().
WorldBox box_around(const scene::WorldLight& light);

// Around the lights in view, which holds every point in view that one of them reaches. No light: a box
// without extent at the origin. None if a light in view has no end: then any box leaves some of it out.
std::optional<WorldBox> box_around_lights_in_view(const view::Frame& frame);

}  // namespace clusterbench::grid
