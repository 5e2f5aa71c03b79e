#include <algorithm>
#include <numbers>

#include "scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

// pi/2 rounded up to single precision, as exporters write it, is still pi/2.
constexpr double k_angle_slack_rad = 1e-6;

json checked_spot(const Place& spot) {
  spot.expect_object();
  const double inner = spot.has("innerConeAngle") ? spot.at("innerConeAngle").number() : 0.0;
  const double outer = spot.has("outerConeAngle") ? spot.at("outerConeAngle").number() : std::numbers::pi / 4.0;
  if (inner < 0.0) spot.at("innerConeAngle").refuse("found " + std::to_string(inner) + ", 0 or more is needed");
  if (outer > std::numbers::pi / 2.0 + k_angle_slack_rad || outer <= 0.0) {
    spot.at("outerConeAngle").refuse("found " + std::to_string(outer) + ", more than 0 and at most pi/2 is needed");
  }
  if (inner >= outer) {
    const Place blamed = spot.has("outerConeAngle") ? spot.at("outerConeAngle") : spot.at("innerConeAngle");
    blamed.refuse("innerConeAngle " + std::to_string(inner) + " must be less than outerConeAngle " +
                  std::to_string(outer));
  }
  return {{"innerConeAngle", inner}, {"outerConeAngle", std::min(outer, std::numbers::pi / 2.0)}};
}

void copy_range(const Place& light, json& out, std::vector<std::string>& warnings) {
  if (!light.has("range")) return;
  const Place range = light.at("range");
  const double range_m = range.number();
  if (range_m < 0.0) range.refuse("found " + kind_of(range.value()) + ", a range of 0 or more is needed");
  if (range_m == 0.0) warnings.push_back(warning_at(range, "a range of 0 lights nothing (glTF asks for more than 0)"));
  out["range"] = range_m;
}

void copy_colour(const Place& light, json& out, std::vector<std::string>& warnings) {
  if (!light.has("color")) return;
  const Place color = light.at("color");
  const std::vector<double> rgb = color.numbers(3);
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    if (rgb[i] < 0.0) color.at(i).refuse("found " + kind_of(color.at(i).value()) + ", 0 to 1 is allowed");
    if (rgb[i] > 1.0) warnings.push_back(warning_at(color.at(i), "a colour above 1; taken as it is"));
  }
  out["color"] = rgb;
}

json checked_light(const Place& light, std::vector<std::string>& warnings) {
  json out = json::object();
  const std::string& type = light.at("type").text();
  if (type != "point" && type != "spot" && type != "directional") {
    warnings.push_back(warning_at(light.at("type"), "the light type is not known; the light is ignored"));
    return json(nullptr);
  }
  out["type"] = type;
  copy_name(light, out);
  copy_colour(light, out, warnings);
  if (light.has("intensity")) {
    out["intensity"] = light.at("intensity").number();
    if (out["intensity"].get<double>() < 0.0) {
      light.at("intensity").refuse("found " + kind_of(light.at("intensity").value()) + ", 0 or more is needed");
    }
  }
  if (type != "directional") copy_range(light, out, warnings);
  if (type == "spot") {
    if (!light.has("spot"))
      warnings.push_back(warning_at(light, "a spot light without 'spot'; angles 0 and pi/4 taken"));
    out["spot"] = light.has("spot") ? checked_spot(light.at("spot"))
                                    : json({{"innerConeAngle", 0.0}, {"outerConeAngle", std::numbers::pi / 4.0}});
  }
  return out;
}

}  // namespace

json checked_lights(const Place& root, std::vector<std::string>& warnings) {
  json out = json::array();
  if (!root.has("extensions")) return out;
  const Place extensions = root.at("extensions");
  extensions.expect_object();
  if (!extensions.has("KHR_lights_punctual")) return out;
  const Place lights = extensions.at("KHR_lights_punctual").at("lights");
  lights.expect_array();
  for (std::size_t i = 0; i < lights.size(); ++i) out.push_back(checked_light(lights.at(i), warnings));
  return out;
}

}  // namespace clusterbench::scene
