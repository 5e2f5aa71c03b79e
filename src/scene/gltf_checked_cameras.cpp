#include <cmath>
#include <numbers>

#include "scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

double positive(const JsonLocation& location) {
  const double number = location.number();
  if (number <= 0.0) location.refuse("found " + kind_of(location.value()) + ", more than 0 is needed");
  return number;
}

// The far plane if there is one.
void copy_far(const JsonLocation& projection, json& out) {
  if (!projection.has("zfar")) return;
  const JsonLocation zfar = projection.at("zfar");
  const double far = positive(zfar);
  if (far <= out["znear"].get<double>()) projection.refuse("zfar must be greater than znear");
  if (is_float_max(far)) zfar.warn("the largest number of single precision; read as infinitely far");
  out["zfar"] = far;
}

// null for a projection that glTF allows and that shows nothing.
json checked_perspective(const JsonLocation& projection) {
  projection.expect_object();
  json out = {{"yfov", positive(projection.at("yfov"))}, {"znear", positive(projection.at("znear"))}};
  copy_far(projection, out);
  if (projection.has("aspectRatio")) out["aspectRatio"] = positive(projection.at("aspectRatio"));
  if (out["yfov"].get<double>() >= std::numbers::pi) {
    projection.at("yfov").warn("pi radians or more show nothing (degrees?); the camera is ignored");
    return json(nullptr);
  }
  return out;
}

// An off-centre picture, an invention of this tool: see ProjectionSides.
void copy_sides(const JsonLocation& camera, json& out) {
  if (!camera.has("extras")) return;
  warn_of_unknown_extras(camera, {k_sides});
  if (!camera.at("extras").has(k_sides)) return;
  const JsonLocation location = camera.at("extras").at(k_sides);
  const std::vector<double> sides = location.numbers(4);
  if (!(sides[0] < sides[1]) || !(sides[2] < sides[3]))
    location.refuse("left must be less than right and bottom less than top: [left, right, bottom, top]");
  if (out.contains("orthographic")) location.refuse("only a perspective camera can have it");
  out["extras"][k_sides] = sides;
}

// A negative magnification mirrors the picture; which lights it holds is the same.
double magnification(const JsonLocation& location) {
  const double number = location.number();
  if (number == 0.0) location.refuse("found 0, another number is needed");
  if (number < 0.0) location.warn("negative, its sign is ignored");
  return std::abs(number);
}

json checked_orthographic(const JsonLocation& projection) {
  projection.expect_object();
  json out = {{"xmag", magnification(projection.at("xmag"))},
              {"ymag", magnification(projection.at("ymag"))},
              {"znear", projection.at("znear").number()}};
  if (out["znear"].get<double>() < 0.0)
    projection.at("znear").refuse("found " + kind_of(projection.at("znear").value()) + ", 0 or more is needed");
  projection.at("zfar");  // must be there
  copy_far(projection, out);
  return out;
}

json checked_camera(const JsonLocation& camera) {
  json out = json::object();
  const std::string& type = camera.at("type").text();
  copy_name(camera, out);
  if (camera.has("perspective") && camera.has("orthographic")) {
    camera.refuse("a camera is either perspective or orthographic, not both");
  }
  if (type == "perspective") {
    out["perspective"] = checked_perspective(camera.at("perspective"));
    if (out["perspective"].is_null()) return json(nullptr);
  } else if (type == "orthographic") {
    out["orthographic"] = checked_orthographic(camera.at("orthographic"));
  } else {
    camera.at("type").warn("the camera type is not known; the camera is ignored");
    return json(nullptr);
  }
  out["type"] = type;
  copy_sides(camera, out);
  return out;
}

}  // namespace

json checked_cameras(const JsonLocation& root) {
  json out = json::array();
  const std::size_t count = root.has("cameras") ? root.at("cameras").elements() : 0;
  for (std::size_t i = 0; i < count; ++i) out.push_back(checked_camera(root.at("cameras").at(i)));
  return out;
}

}  // namespace clusterbench::scene
