#pragma once
// One camera pose with its projection and viewport, and the lights in the coordinates of a grid's space.

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

// Throws Error (where: "camera") for a picture that shows more than the domain allows (geom/shapes/domain.h).
void check_projection(const Projection& projection);

// Pixels are square. The vertical extent is the projection's and the horizontal one follows from the viewport's aspect
// ratio, unless that would cut half a pixel or more off the sides of the camera's rectangle and projection.fit is
// `contain`: then the horizontal extent is the projection's and the vertical one follows. Or the projection has all
// four sides.
Projection make_projection(const scene::CameraProjection& projection, Vec2i viewport);

// The difference between a picture in this viewport and the camera's own rectangle, if the camera is wider than the
// viewport: one line, "" if the rectangle fits.
std::string fit_warning(const scene::CameraProjection& projection, Vec2i viewport);

// A rigid frame of reference: local = rotation * (world - origin).
struct Space {
  Vec3d origin{0.0};
  Mat3d rotation{1.0};
};

// Lights of one type, with consecutive indices.
struct LightRange {
  std::uint32_t first = 0, count = 0;

  bool empty() const { return count == 0; }
  std::uint32_t end() const { return first + count; }
};

// Number of assigned types of light, and of the punctual ones among them, which come first: points and spots.
inline constexpr std::size_t k_light_types = 3, k_punctual_types = 2;

// A frame's lights by type. Indices of lights, in all lists, are in the order of these types.
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

// Lights in a space, single precision, one array per component (an engine's input of an assigner).
struct LightArrays : LightRanges {
  std::vector<float> x, y, z;  // centre or apex, each coordinate rounded to nearest
  std::vector<float> radius;   // the range, rounded up; 0 and +inf stay
  std::vector<float> reach;    // |x| + |y| + |z| + radius: the size to which roundoffs are relative
  // Spots only; index i - spots.first. Axis is unit up to rounding.
  std::vector<float> axis_x, axis_y, axis_z, cos_angle, sin_angle;
  // Boxes only; index i - boxes.first. Each coordinate of the half axes is rounded to nearest. A box's x, y, z is its
  // middle, its radius that of the ball around it, and its reach belongs to that ball.
  std::vector<geom::HalfAxes> half_axes;

  // The numbers before rounding, for methods that need them. Belongs to the frame, which must stay alive.
  std::span<const scene::WorldLight> source;
  Space space;

  // Removes all lights; the arrays keep their memory.
  void forget();
  bool is_empty(std::uint32_t light) const { return !(radius[light] > 0.0f); }
  // The radius increased by a number of roundoffs: units of 2^-24 of its reach. 0: unchanged.
  float padded_radius(std::uint32_t light, float roundoffs) const;
  geom::Ball ball(std::uint32_t light, float roundoffs) const;           // for a spot that of its range
  geom::SphericalCone cone(std::uint32_t light, float roundoffs) const;  // light must be a spot
  geom::OrientedBox box(std::uint32_t light) const;                      // light must be a box
  // A point's ball; for a spot the one around its cone, for a box the one around it.
  geom::Ball bounding_ball(std::uint32_t light, float roundoffs) const;
  geom::LightVolume volume(std::uint32_t light) const;  // exact
};

// A light of the scene from its exact numbers, in a space.
geom::LightVolume volume_of(const scene::WorldLight& light, const Space& space);

// A frame: everything in double precision.
struct Frame {
  int index = 0;
  double time_s = 0.0;
  Vec2i viewport{0, 0};
  Projection projection;
  Space view_space;                       // eye and view rotation
  std::vector<scene::WorldLight> lights;  // in the order of ranges()
  std::uint32_t points = 0, boxes = 0;    // numbers of points and boxes; the others are spots

  // Sets the numbers of each type; the lights are sorted by type.
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
// With the lights that the scene has then, inside of the domain.
Frame make_frame(const scene::Scene& scene, const scene::Shot& shot, int index, Vec2i viewport,
                 std::vector<scene::WorldLight> lights);

// The error of these numbers before a method starts, in roundoffs: one for the centre (each coordinate has an error of
// 2^-24 of itself, so the centre of 2^-24 of its length), one for the sum that pads the radius.
inline constexpr float k_given_roundoffs = 2.0f;

// The frame's lights in a space: the difference to the origin is computed in double, then rounded once.
LightArrays lights_in(const Frame& frame, const Space& space);
// The same into arrays whose memory is reused.
void fill_lights_in(const Frame& frame, const Space& space, LightArrays& out);

}  // namespace clusterbench::view
