#include <cmath>
#include <limits>
#include <numbers>

#include "scene/gltf_scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

double positive(const JsonLocation& location) {
  const double number = location.number();
  if (number <= 0.0) location.refuse("found " + kind_of(location.value()) + ", more than 0 is needed");
  return number;
}

// The far plane if there is one.
void read_far(const JsonLocation& from, CameraProjection& out) {
  out.far_m = std::numeric_limits<double>::infinity();
  if (!from.has("zfar")) return;
  const JsonLocation zfar = from.at("zfar");
  const double far = positive(zfar);
  if (far <= out.near_m) from.refuse("zfar must be greater than znear");
  if (is_float_max(far))
    zfar.warn("the largest number of single precision; read as infinitely far");
  else
    out.far_m = far;
}

// False for a projection that is valid glTF but shows nothing.
bool read_perspective(const JsonLocation& from, CameraProjection& out) {
  from.expect_object();
  out.yfov_rad = positive(from.at("yfov"));
  out.near_m = positive(from.at("znear"));
  read_far(from, out);
  if (from.has("aspectRatio")) out.aspect_ratio = positive(from.at("aspectRatio"));
  if (out.yfov_rad < std::numbers::pi) return true;
  from.at("yfov").warn("pi radians or more show nothing (degrees?); the camera is ignored");
  return false;
}

// An off-centre picture, an extension of this tool: see ProjectionSides.
void read_sides(const JsonLocation& camera, CameraProjection& out) {
  if (!camera.has("extras")) return;
  warn_of_unknown_extras(camera, {k_sides});
  if (!camera.at("extras").has(k_sides)) return;
  const JsonLocation location = camera.at("extras").at(k_sides);
  const std::vector<double> sides = location.numbers(4);
  if (!(sides[0] < sides[1]) || !(sides[2] < sides[3]))
    location.refuse("left must be less than right and bottom less than top: [left, right, bottom, top]");
  if (out.orthographic) location.refuse("only a perspective camera can have it");
  out.sides = ProjectionSides{sides[0], sides[1], sides[2], sides[3]};
}

// A negative magnification mirrors the picture; it contains the same lights.
double magnification(const JsonLocation& location) {
  const double number = location.number();
  if (number == 0.0) location.refuse("found 0, another number is needed");
  if (number < 0.0) location.warn("negative, its sign is ignored");
  return std::abs(number);
}

void read_orthographic(const JsonLocation& from, CameraProjection& out) {
  from.expect_object();
  out.orthographic = true;
  out.xmag_m = magnification(from.at("xmag"));
  out.ymag_m = magnification(from.at("ymag"));
  out.near_m = from.at("znear").number();
  if (out.near_m < 0.0) from.at("znear").refuse("found " + kind_of(from.at("znear").value()) + ", 0 or more is needed");
  from.at("zfar");  // must exist
  read_far(from, out);
}

std::optional<Camera> checked_camera(const JsonLocation& from) {
  Camera out;
  const std::string& type = from.at("type").text();
  out.name = name_of(from);
  if (from.has("perspective") && from.has("orthographic")) {
    from.refuse("a camera is either perspective or orthographic, not both");
  }
  if (type == "perspective") {
    if (!read_perspective(from.at("perspective"), out.projection)) return std::nullopt;
  } else if (type == "orthographic") {
    read_orthographic(from.at("orthographic"), out.projection);
  } else {
    from.at("type").warn("the camera type is not known; the camera is ignored");
    return std::nullopt;
  }
  read_sides(from, out.projection);
  return out;
}

}  // namespace

std::vector<std::optional<Camera>> checked_cameras(const JsonLocation& root) {
  std::vector<std::optional<Camera>> out;
  const std::size_t count = root.has("cameras") ? root.at("cameras").elements() : 0;
  for (std::size_t i = 0; i < count; ++i) out.push_back(checked_camera(root.at("cameras").at(i)));
  return out;
}

}  // namespace clusterbench::scene
