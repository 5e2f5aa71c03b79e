#pragma once
// One camera pose with its projection and viewport, and the lights as a grid's space sees them.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geom/shapes/ball_and_cone.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/vec.h"
#include "scene/camera_path.h"

namespace clusterbench::view {

// The image rectangle in view space: at depth 1 (perspective: slopes) or anywhere (orthographic: metres).
struct Projection {
  bool orthographic = false;
  double left = -1.0, right = 1.0, bottom = -1.0, top = 1.0;
  double near_m = 0.1, far_m = 0.0;  // far may be +inf

  friend bool operator==(const Projection&, const Projection&) = default;
};

// Pixels are square. The vertical extent is the projection's and the horizontal one follows from the viewport's aspect
// ratio, unless that would cut half a pixel or more off the sides of the camera's rectangle and projection.fit is
// `contain`: then the horizontal extent is the projection's and the vertical one follows. Or the projection has all
// four sides.
Projection make_projection(const scene::CameraProjection& projection, Vec2i viewport);

// What a picture in this viewport shows beyond the camera's own rectangle, or leaves out, because the camera is wider
// than the viewport: one line, "" if the rectangle fits.
std::string fit_warning(const scene::CameraProjection& projection, Vec2i viewport);

// A rigid frame of reference: local = rotation * (world - origin).
struct Space {
  Vec3d origin{0.0};
  Mat3d rotation{1.0};
};

// Lights of one type, which follow one another.
struct LightRange {
  std::uint32_t first = 0, count = 0;

  bool empty() const { return count == 0; }
  std::uint32_t end() const { return first + count; }
};

// How many types of light are assigned, and how many of them, the first ones, are punctual: points and spots.
inline constexpr std::size_t k_light_types = 3, k_punctual_types = 2;

// A frame's lights by type. Indices of lights, in all lists, run through the types in this order.
struct LightRanges {
  LightRange points, spots, boxes;

  LightRanges() = default;
  LightRanges(std::uint32_t point_count, std::uint32_t spot_count, std::uint32_t box_count = 0)
      : points{0, point_count}, spots{point_count, spot_count}, boxes{point_count + spot_count, box_count} {}

  std::uint32_t size() const { return boxes.end(); }
  // Type by type, in the order of indices.
  std::array<LightRange, k_light_types> types() const { return {points, spots, boxes}; }
  bool is_spot(std::uint32_t light) const { return light - spots.first < spots.count; }
  bool is_box(std::uint32_t light) const { return light >= boxes.first; }
  std::size_t type_of(std::uint32_t light) const { return is_box(light) ? 2 : is_spot(light) ? 1 : 0; }  // of types()
};

// Lights in a space, single precision, one array per component (what an engine hands to an assigner).
struct LightArrays : LightRanges {
  std::vector<float> x, y, z;  // centre or apex, each coordinate rounded to nearest
  std::vector<float> radius;   // the range, rounded up; 0 and +inf stay
  std::vector<float> reach;    // |x| + |y| + |z| + radius: what roundoffs are relative to
  // Spots only; index i - spots.first. Axis is unit up to rounding.
  std::vector<float> axis_x, axis_y, axis_z, cos_angle, sin_angle;
  // Boxes only; index i - boxes.first. Each coordinate of the half axes is rounded to nearest. A box's x, y, z is its
  // middle, its radius that of the ball around it, and its reach is what goes with that ball.
  std::vector<geom::HalfAxes> half_axes;

  // What the numbers were rounded from, for methods that go back to it. Belongs to the frame, which must live on.
  std::span<const scene::WorldLight> source;
  Space space;

  bool is_empty(std::uint32_t light) const { return !(radius[light] > 0.0f); }
  // The radius grown by a number of roundoffs: units of 2^-24 of its reach. 0: as it is.
  float padded_radius(std::uint32_t light, float roundoffs) const;
  geom::Ball ball(std::uint32_t light, float roundoffs) const;           // of a spot that of its range
  geom::SphericalCone cone(std::uint32_t light, float roundoffs) const;  // light must be a spot
  geom::OrientedBox box(std::uint32_t light) const;                      // light must be a box
  // A point's ball; of a spot the one around its cone, of a box the one around it.
  geom::Ball bounding_ball(std::uint32_t light, float roundoffs) const;
  geom::LightVolume volume(std::uint32_t light) const;  // exact
};

// A light of the scene by its exact ingredients, as a space sees it.
geom::LightVolume volume_of(const scene::WorldLight& light, const Space& space);

// A frame: everything in double precision.
struct Frame {
  int index = 0;
  double time_s = 0.0;
  Vec2i viewport{0, 0};
  Projection projection;
  Space view_space;                       // eye and view rotation
  std::vector<scene::WorldLight> lights;  // as ranges() has them
  std::uint32_t points = 0, boxes = 0;    // how many of them are points and boxes; the others are spots

  // Sets how many there are of each type, which come one after the other.
  void count_types();
  LightRanges ranges() const { return {points, static_cast<std::uint32_t>(lights.size()) - points - boxes, boxes}; }
};

// The ray through a point of the picture, in view space; its parameter is the depth.
struct PictureRay {
  Vec3d from{0.0}, along{0.0, 0.0, -1.0};

  Vec3d at(double depth) const { return from + depth * along; }
};
// `pixel`: in pixels from the top left.
PictureRay picture_ray(const Frame& frame, const Vec2d& pixel);

// Throws Error for a frame outside of the domain (geom/shapes/domain.h).
Frame make_frame(const scene::Scene& scene, const scene::Shot& shot, int index, Vec2i viewport);

// What a method that uses these numbers has lost before it starts, in roundoffs: one for the centre (each coordinate is
// off by 2^-24 of itself, so the centre by 2^-24 of its length), one for the sum that pads the radius.
inline constexpr float k_given_roundoffs = 2.0f;

// The frame's lights in a space: the difference to the origin is taken in double, then rounded once.
LightArrays lights_in(const Frame& frame, const Space& space);

}  // namespace clusterbench::view
