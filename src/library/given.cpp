#include "library/given.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "geom/shapes/domain.h"
#include "library/engine_words.h"

namespace clusterbench::library {
namespace {

// --- Parameters ---

assign::ParamValue value_of(const char* where, const Parameter& parameter) {
  switch (parameter.type) {
    case Parameter::Type::flag:
      return parameter.flag;
    case Parameter::Type::text:
      return std::string(parameter.text);
    case Parameter::Type::number:
      return parameter.number;
  }
  refuse(where, "have '" + std::string(parameter.name) + "' of no type; allowed: number, text, flag");
}

std::string allowed_names(std::span<const assign::ParamSpec> specs) {
  std::vector<std::string> names;
  for (const assign::ParamSpec& spec : specs) names.push_back(spec.name);
  return names.empty() ? "; allowed: none" : "; allowed: " + joined(names);
}

// --- Camera ---

// As View::set_matrices() does.
void check_axes(const Mat3d& rotation) {
  constexpr double k_most_off = 1e-3;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      double sum = 0.0;
      for (int i = 0; i < 3; ++i) sum += rotation[i][a] * rotation[i][b];
      if (!(std::abs(sum - (a == b ? 1.0 : 0.0)) <= k_most_off))
        refuse("view.to_right, view.to_top, view.forward",
               "are not unit and orthogonal; allowed: products within 1e-3 of 1 and 0");
    }
}

// The first below the second.
void check_order(const char* where, double first, double second, const char* allowed) {
  if (!(first < second))
    refuse(where, "are " + short_number(first) + " and " + short_number(second) + "; allowed: " + allowed);
}

void check_side(const char* where, double side, bool is_orthographic) {
  if (std::abs(side) <= (is_orthographic ? geom::k_farthest_m : geom::k_steepest_slope)) return;
  refuse(where, "is " + short_number(side) + "; allowed: " +
                    (is_orthographic ? "-1e15 to 1e15 m" : "slopes from -1e5 to 1e5, which is 89.9994 degrees"));
}

// As view::check_projection(), which names no side.
void check_sides(const View& view) {
  check_side("view.left", view.left, view.is_orthographic);
  check_side("view.right", view.right, view.is_orthographic);
  check_side("view.bottom", view.bottom, view.is_orthographic);
  check_side("view.top", view.top, view.is_orthographic);
  check_order("view.left, view.right", view.left, view.right, "left < right");
  check_order("view.bottom, view.top", view.bottom, view.top, "bottom < top");
}

void check_range_of_depths(const View& view) {
  const bool has_near = geom::is_in_domain(view.near_m) && (view.is_orthographic || view.near_m > 0.0);
  const bool has_far = view.near_m < view.far_m && (!view.is_orthographic || std::isfinite(view.far_m));
  if (has_near && has_far) return;
  refuse("view.near_m, view.far_m",
         "are " + short_number(view.near_m) + " and " + short_number(view.far_m) +
             "; allowed: 0 < near < far, near up to 1e15 m, far may be infinite; of an orthographic camera near < "
             "far, both finite");
}

void check_depth(std::size_t index, float depth, bool is_orthographic) {
  const float least = is_orthographic ? std::numeric_limits<float>::lowest() : 0.0f;
  if (depth >= least) return;
  refuse("view.depths[" + std::to_string(index) + "]",
         "is " + short_number(static_cast<double>(depth)) +
             "; allowed: " + (is_orthographic ? "metres" : "0 m or more") + ", and +inf without a surface");
}

// --- Lights ---

std::string name_of(const char* kind, std::size_t index, const char* member) {
  return std::string("lights.") + kind + "[" + std::to_string(index) + "]." + member;
}

template <class Number>
std::string text_of(const Number (&numbers)[3]) {
  return "(" + short_number(static_cast<double>(numbers[0])) + ", " + short_number(static_cast<double>(numbers[1])) +
         ", " + short_number(static_cast<double>(numbers[2])) + ")";
}

Vec3d vector_of(const float (&numbers)[3]) {
  return {static_cast<double>(numbers[0]), static_cast<double>(numbers[1]), static_cast<double>(numbers[2])};
}

bool is_position(const Vec3d& p) {
  return geom::is_in_domain(p.x) && geom::is_in_domain(p.y) && geom::is_in_domain(p.z);
}

void set_ball(const char* kind, std::size_t index, const float (&position)[3], float range, scene::WorldLight& out) {
  out.position = vector_of(position);
  out.range_m = geom::range_in_domain(static_cast<double>(range));
  if (!is_position(out.position))
    refuse(name_of(kind, index, "position"), "is " + text_of(position) +
                                                 "; allowed: up to 1e15 m from the origin along "
                                                 "each axis");
  if (!(range >= 0.0f))
    refuse(name_of(kind, index, "range"), "is " + short_number(static_cast<double>(range)) + "; allowed: 0 or more");
}

void set_spot(std::size_t index, const SpotLight& spot, scene::WorldLight& out) {
  set_ball("spots", index, spot.position, spot.range, out);
  const Vec3d direction = vector_of(spot.direction);
  const double length = std::sqrt(direction.x * direction.x + direction.y * direction.y + direction.z * direction.z);
  if (!(length > 0.0) || !std::isfinite(length))
    refuse(name_of("spots", index, "direction"), "is " + text_of(spot.direction) + "; allowed: any direction but 0");
  out.direction = direction / length;
  // pi/2 in single precision is above pi/2.
  out.outer_cone_rad = std::min(static_cast<double>(spot.outer_angle), std::numbers::pi / 2.0);
  if (!(spot.outer_angle >= 0.0f && spot.outer_angle <= static_cast<float>(std::numbers::pi / 2.0)))
    refuse(name_of("spots", index, "outer_angle"),
           "is " + short_number(static_cast<double>(spot.outer_angle)) + "; allowed: 0 to pi/2");
}

void set_box(std::size_t index, const Box& box, scene::WorldLight& out) {
  set_ball("boxes", index, box.center, 0.0f, out);
  for (std::size_t i = 0; i < out.half_axes_m.size(); ++i) {
    out.half_axes_m[i] = vector_of(box.half_axes[i]);
    if (!is_position(out.half_axes_m[i]))
      refuse(name_of("boxes", index, "half_axes"), "have " + text_of(box.half_axes[i]) + "; allowed: up to 1e15 m");
  }
  out.range_m = geom::range_in_domain(scene::corner_distance_m(out.half_axes_m));
  if (!std::isfinite(out.range_m))
    refuse(name_of("boxes", index, "half_axes"), "are " + text_of(box.half_axes[0]) + ", " + text_of(box.half_axes[1]) +
                                                     " and " + text_of(box.half_axes[2]) +
                                                     "; allowed: corners up to 1e15 m from the center");
}

void check_light_count(std::size_t count) {
  if (count > std::numeric_limits<std::uint32_t>::max() / 2)
    refuse("lights", "are " + std::to_string(count) + "; allowed: at most 2^31 - 1");
  check_memory("lights", count, sizeof(scene::WorldLight));
}

// Types of the lights that are there, without their numbers.
void set_types(const Lights& lights, view::Frame& frame) {
  const std::size_t points = lights.points.size(), spots = lights.spots.size(), boxes = lights.boxes.size();
  const view::LightRanges before = frame.ranges();
  if (before.points.count == points && before.spots.count == spots && before.boxes.count == boxes) return;
  check_light_count(points + spots + boxes);
  frame.lights.resize(points + spots + boxes);
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    frame.lights[i].type = i < points           ? scene::LightType::point
                           : i < points + spots ? scene::LightType::spot
                                                : scene::LightType::box;
  frame.points = static_cast<std::uint32_t>(points);
  frame.boxes = static_cast<std::uint32_t>(boxes);
}

}  // namespace

assign::Params params_of(const char* where, std::span<const assign::ParamSpec> specs,
                         std::span<const Parameter> given) {
  std::map<std::string, assign::ParamValue> values;
  for (const Parameter& parameter : given) {
    if (parameter.name.empty()) refuse(where, "have one without a name" + allowed_names(specs));
    if (!values.emplace(parameter.name, value_of(where, parameter)).second)
      refuse(where, "have '" + std::string(parameter.name) + "' twice; allowed: each once");
  }
  try {
    return {specs, values};
  } catch (const Error& error) {
    refuse(where + std::string(": ") + error.where(), error.message());
  }
}

void set_camera(const View& view, view::Frame& frame) {
  constexpr int k_widest = 1 << 20;
  if (view.width < 1 || view.height < 1 || view.width > k_widest || view.height > k_widest)
    refuse("view.width, view.height", "are " + std::to_string(view.width) + " and " + std::to_string(view.height) +
                                          "; allowed: 1 to 1048576 pixels");
  check_sides(view);
  check_range_of_depths(view);
  frame.viewport = {view.width, view.height};
  frame.projection = {view.is_orthographic, view.left, view.right, view.bottom, view.top, view.near_m, view.far_m};
  view::Space& space = frame.view_space;
  space.origin = Vec3d(view.eye[0], view.eye[1], view.eye[2]);
  if (!is_position(space.origin))
    refuse("view.eye", "is " + text_of(view.eye) + "; allowed: up to 1e15 m from the origin along each axis");
  for (int i = 0; i < 3; ++i) space.rotation[i] = Vec3d(view.to_right[i], view.to_top[i], -view.forward[i]);
  check_axes(space.rotation);
}

void set_lights(const Lights& lights, view::Frame& frame) {
  set_types(lights, frame);
  scene::WorldLight* out = frame.lights.data();
  for (std::size_t i = 0; i < lights.points.size(); ++i)
    set_ball("points", i, lights.points[i].position, lights.points[i].range, *out++);
  for (std::size_t i = 0; i < lights.spots.size(); ++i) set_spot(i, lights.spots[i], *out++);
  for (std::size_t i = 0; i < lights.boxes.size(); ++i) set_box(i, lights.boxes[i], *out++);
}

void set_depths(const View& view, depth::DepthImage& image) {
  if (image.pixels.viewport != Vec2i(view.width, view.height))
    image.pixels = depth::PixelGrid(Vec2i(view.width, view.height), 1);
  if (view.depths.size() != image.pixels.count())
    refuse("view.depths", "are " + std::to_string(view.depths.size()) + ", and this method needs one for each of " +
                              std::to_string(image.pixels.count()) + " pixels");
  image.nearest.assign(view.depths.begin(), view.depths.end());
  for (std::size_t i = 0; i < image.nearest.size(); ++i) check_depth(i, image.nearest[i], view.is_orthographic);
}

}  // namespace clusterbench::library
