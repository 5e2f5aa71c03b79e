#include <cmath>
#include <numbers>

#include "scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

double positive(const Place& place) {
  const double number = place.number();
  if (number <= 0.0) place.refuse("found " + kind_of(place.value()) + ", more than 0 is needed");
  return number;
}

void check_far(const Place& lens, double near) {
  if (lens.has("zfar") && lens.at("zfar").number() <= near) {
    lens.refuse("zfar must be greater than znear");
  }
}

// null for a lens that glTF allows and that shows nothing.
json checked_perspective(const Place& lens, std::vector<std::string>& warnings) {
  lens.expect_object();
  json out = {{"yfov", positive(lens.at("yfov"))}, {"znear", positive(lens.at("znear"))}};
  check_far(lens, out["znear"].get<double>());
  if (lens.has("zfar")) out["zfar"] = positive(lens.at("zfar"));
  if (lens.has("aspectRatio")) positive(lens.at("aspectRatio"));
  if (out["yfov"].get<double>() >= std::numbers::pi) {
    warnings.push_back(
        warning_at(lens.at("yfov"), "pi radians or more show nothing (degrees?); the camera is ignored"));
    return json(nullptr);
  }
  return out;
}

// An off-centre picture, an invention of this tool: see LensSides.
void copy_sides(const Place& camera, json& out) {
  if (!camera.has("extras") || !camera.at("extras").has("clusterbench_sides")) return;
  const Place place = camera.at("extras").at("clusterbench_sides");
  const std::vector<double> sides = place.numbers(4);
  if (!(sides[0] < sides[1]) || !(sides[2] < sides[3]))
    place.refuse("left must be less than right and bottom less than top: [left, right, bottom, top]");
  if (out.contains("orthographic")) place.refuse("only a perspective camera can have it");
  out["extras"]["clusterbench_sides"] = sides;
}

// A negative magnification mirrors the picture; which lights it holds is the same.
double magnification(const Place& place, std::vector<std::string>& warnings) {
  const double number = place.number();
  if (number == 0.0) place.refuse("found 0, another number is needed");
  if (number < 0.0) warnings.push_back(warning_at(place, "negative, its sign is ignored"));
  return std::abs(number);
}

json checked_orthographic(const Place& lens, std::vector<std::string>& warnings) {
  lens.expect_object();
  json out = {{"xmag", magnification(lens.at("xmag"), warnings)},
              {"ymag", magnification(lens.at("ymag"), warnings)},
              {"znear", lens.at("znear").number()},
              {"zfar", positive(lens.at("zfar"))}};
  if (out["znear"].get<double>() < 0.0)
    lens.at("znear").refuse("found " + kind_of(lens.at("znear").value()) + ", 0 or more is needed");
  check_far(lens, out["znear"].get<double>());
  return out;
}

json checked_camera(const Place& camera, std::vector<std::string>& warnings) {
  json out = json::object();
  const std::string& type = camera.at("type").text();
  copy_name(camera, out);
  if (camera.has("perspective") && camera.has("orthographic")) {
    camera.refuse("a camera is either perspective or orthographic, not both");
  }
  if (type == "perspective") {
    out["perspective"] = checked_perspective(camera.at("perspective"), warnings);
    if (out["perspective"].is_null()) return json(nullptr);
  } else if (type == "orthographic") {
    out["orthographic"] = checked_orthographic(camera.at("orthographic"), warnings);
  } else {
    warnings.push_back(warning_at(camera.at("type"), "the camera type is not known; the camera is ignored"));
    return json(nullptr);
  }
  out["type"] = type;
  copy_sides(camera, out);
  return out;
}

}  // namespace

json checked_cameras(const Place& root, std::vector<std::string>& warnings) {
  json out = json::array();
  const std::size_t count = count_of(root, "cameras");
  for (std::size_t i = 0; i < count; ++i) out.push_back(checked_camera(root.at("cameras").at(i), warnings));
  return out;
}

}  // namespace clusterbench::scene
