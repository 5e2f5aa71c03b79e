#include "view/frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/error.h"
#include "geom/numbers/round_to_float.h"
#include "geom/shapes/domain.h"
#include "geom/shapes/light_volume.h"
#include "geom/single_precision/bounding_volumes.h"

namespace clusterbench::view {
namespace {

void add_axis(LightArrays& out, const Mat3d& rotation, const scene::WorldLight& light) {
  const Vec3d axis = rotation * light.direction;
  const double length = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  out.axis_x.push_back(static_cast<float>(axis.x / length));
  out.axis_y.push_back(static_cast<float>(axis.y / length));
  out.axis_z.push_back(static_cast<float>(axis.z / length));
  out.cos_angle.push_back(static_cast<float>(std::cos(light.outer_cone_rad)));
  out.sin_angle.push_back(static_cast<float>(std::sin(light.outer_cone_rad)));
}

void add_half_axes(LightArrays& out, const Mat3d& rotation, const scene::WorldLight& box) {
  geom::HalfAxes axes;
  for (std::size_t i = 0; i < axes.size(); ++i) axes[i] = Vec3f(rotation * box.half_axes_m[i]);
  out.half_axes.push_back(axes);
}

double aspect_of(Vec2i viewport) {
  return static_cast<double>(viewport.x) / viewport.y;
}

double half_height(const scene::CameraProjection& projection) {
  return projection.orthographic ? projection.ymag_m : std::tan(projection.yfov_rad / 2.0);
}

// Half the width of the camera's rectangle if the viewport would crop it, else 0. Aspect ratios are written with a few
// digits: less than half a pixel at each side counts as no difference.
double cropped_width(const scene::CameraProjection& projection, Vec2i viewport) {
  if (projection.sides) return 0.0;
  const double height = half_height(projection);
  const double width = projection.orthographic ? projection.xmag_m : projection.aspect_ratio.value_or(0.0) * height;
  const double shown = aspect_of(viewport) * height;
  return width - shown > shown / viewport.x ? width : 0.0;
}

}  // namespace

void check_projection(const Projection& projection) {
  const double widest = std::max(
      {std::abs(projection.left), std::abs(projection.right), std::abs(projection.bottom), std::abs(projection.top)});
  const double most = projection.orthographic ? geom::k_farthest_m : geom::k_steepest_slope;
  if (widest <= most) return;
  throw Error("", "camera",
              projection.orthographic
                  ? "shows a picture of more than 1e15 m, half its width or height"
                  : "shows more than 89.9994 degrees to one side (a slope of 1e5): its field of view is too wide");
}

std::string fit_warning(const scene::CameraProjection& projection, Vec2i viewport) {
  const double width = cropped_width(projection, viewport);
  if (width == 0.0) return "";
  char text[200];
  const double height = half_height(projection), shown = aspect_of(viewport) * height;
  if (projection.fit == scene::CameraFit::contain) {
    std::snprintf(text, sizeof text,
                  "the camera is %.4g times as wide as high, wider than %dx%d: its view is enlarged to %.4g times its "
                  "height (camera_fit: contain)",
                  width / height, viewport.x, viewport.y, width / shown);
  } else {
    std::snprintf(text, sizeof text,
                  "the camera is %.4g times as wide as high, wider than %dx%d: %.3g %% of its width are cropped "
                  "(camera_fit: vertical)",
                  width / height, viewport.x, viewport.y, 100.0 * (1.0 - shown / width));
  }
  return text;
}

Projection make_projection(const scene::CameraProjection& projection, Vec2i viewport) {
  if (projection.sides)
    return {false,
            projection.sides->left,
            projection.sides->right,
            projection.sides->bottom,
            projection.sides->top,
            projection.near_m,
            projection.far_m};
  const double aspect = aspect_of(viewport);
  double top = half_height(projection);
  const double cropped = cropped_width(projection, viewport);
  if (cropped > 0.0 && projection.fit == scene::CameraFit::contain) top = cropped / aspect;
  return {projection.orthographic, -top * aspect, top * aspect, -top, top, projection.near_m, projection.far_m};
}

constexpr float k_roundoff = 0x1p-24f;

float LightArrays::padded_radius(std::uint32_t light, float roundoffs) const {
  if (roundoffs == 0.0f || is_empty(light)) return radius[light];
  return radius[light] + roundoffs * (k_roundoff * reach[light]);
}

geom::Ball LightArrays::ball(std::uint32_t light, float roundoffs) const {
  return {{x[light], y[light], z[light]}, padded_radius(light, roundoffs)};
}

geom::SphericalCone LightArrays::cone(std::uint32_t light, float roundoffs) const {
  assert(is_spot(light));
  const std::uint32_t spot = light - spots.first;
  return {{x[light], y[light], z[light]},
          padded_radius(light, roundoffs),
          {axis_x[spot], axis_y[spot], axis_z[spot]},
          cos_angle[spot],
          sin_angle[spot]};
}

geom::OrientedBox LightArrays::box(std::uint32_t light) const {
  assert(is_box(light));
  return {{x[light], y[light], z[light]}, half_axes[light - boxes.first]};
}

// A spot's sphere is padded itself: a longer range would move it forward as much as it grows, and pad nothing behind
// the apex. The sphere's |x| + |y| + |z| + radius is at most the spot's reach and 0.94 of its range: its middle is 0.71
// of the range from the apex, which is at most 1.23 in that sum, and the radius is at most 0.71.
geom::Ball LightArrays::bounding_ball(std::uint32_t light, float roundoffs) const {
  if (!is_spot(light)) return ball(light, roundoffs);
  const bool is_padded = roundoffs != 0.0f && !is_empty(light);
  const float padding = is_padded ? roundoffs * (k_roundoff * (reach[light] + radius[light])) : 0.0f;
  return geom::bounding_ball(cone(light, 0.0f), padding);
}

geom::LightVolume LightArrays::volume(std::uint32_t light) const {
  return volume_of(source[light], space);
}

geom::LightVolume volume_of(const scene::WorldLight& light, const Space& space) {
  const geom::Placement source{light.position, space.origin, space.rotation};
  if (light.type == scene::LightType::spot)
    return geom::SpotVolume{source, light.range_m, light.direction, light.outer_cone_rad};
  if (light.type == scene::LightType::box) return geom::BoxVolume{source, light.range_m, light.half_axes_m};
  return geom::BallVolume{source, light.range_m};
}

void LightArrays::forget() {
  for (std::vector<float>* numbers : {&x, &y, &z, &radius, &reach, &axis_x, &axis_y, &axis_z, &cos_angle, &sin_angle})
    numbers->clear();
  half_axes.clear();
}

void Frame::count_types() {
  const auto count = [this](scene::LightType type) {
    return static_cast<std::uint32_t>(std::ranges::count(lights, type, &scene::WorldLight::type));
  };
  points = count(scene::LightType::point);
  boxes = count(scene::LightType::box);
}

PictureRay picture_ray(const Frame& frame, const Vec2d& pixel) {
  const Projection& projection = frame.projection;
  const double across = projection.left + (projection.right - projection.left) * pixel.x / frame.viewport.x;
  const double up = projection.top - (projection.top - projection.bottom) * pixel.y / frame.viewport.y;
  if (projection.orthographic) return {{across, up, 0.0}, {0.0, 0.0, -1.0}};
  return {{0.0, 0.0, 0.0}, {across, up, -1.0}};
}

LightArrays lights_in(const Frame& frame, const Space& space) {
  LightArrays out;
  fill_lights_in(frame, space, out);
  return out;
}

void fill_lights_in(const Frame& frame, const Space& space, LightArrays& out) {
  out.forget();
  static_cast<LightRanges&>(out) = frame.ranges();
  out.source = frame.lights;
  out.space = space;
  for (const scene::WorldLight& light : frame.lights) {
    const Vec3d center = space.rotation * (light.position - space.origin);
    out.x.push_back(static_cast<float>(center.x));
    out.y.push_back(static_cast<float>(center.y));
    out.z.push_back(static_cast<float>(center.z));
    out.radius.push_back(geom::rounded_up(light.range_m));
    out.reach.push_back(
        geom::rounded_up(std::abs(center.x) + std::abs(center.y) + std::abs(center.z) + out.radius.back()));
    if (light.type == scene::LightType::spot) add_axis(out, space.rotation, light);
    if (light.type == scene::LightType::box) add_half_axes(out, space.rotation, light);
  }
}

}  // namespace clusterbench::view
