#include <algorithm>
#include <limits>
#include <numbers>

#include "scene/gltf_scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

constexpr const char* k_angles[] = {"innerConeAngle", "outerConeAngle"};

bool has_angles(const JsonLocation& object) {
  return object.has(k_angles[0]) || object.has(k_angles[1]);
}

// The location of a spot light's cone angles. Some exporters put them beside `spot`.
JsonLocation spot_of(const JsonLocation& light) {
  if (light.has("spot")) light.at("spot").expect_object();
  if (light.has("spot") && (has_angles(light.at("spot")) || !has_angles(light))) {
    if (has_angles(light)) light.warn("cone angles both in 'spot' and beside it; read are those in 'spot'");
    return light.at("spot");
  }
  if (has_angles(light))
    light.warn("cone angles beside 'spot', where glTF has them in it; read as if they stood there");
  else
    light.warn("a spot light without 'spot'; angles 0 and pi/4 taken");
  return light;
}

// As written in the file.
std::string angle_text(const JsonLocation& spot, const char* key, const char* otherwise) {
  return spot.has(key) ? spot.at(key).value().dump() : otherwise;
}

void read_cone(const JsonLocation& spot, Light& out) {
  const double inner = spot.has("innerConeAngle") ? spot.at("innerConeAngle").number() : 0.0;
  const double outer = spot.has("outerConeAngle") ? spot.at("outerConeAngle").number() : std::numbers::pi / 4.0;
  const std::string inner_text = angle_text(spot, "innerConeAngle", "0");
  const std::string outer_text = angle_text(spot, "outerConeAngle", "pi/4, as none is given");
  if (inner < 0.0) spot.at("innerConeAngle").refuse("found " + inner_text + ", 0 or more is needed");
  if (outer > std::numbers::pi / 2.0 + k_angle_slack_rad || outer <= 0.0) {
    spot.at("outerConeAngle").refuse("found " + outer_text + ", more than 0 and at most pi/2 is needed");
  }
  const JsonLocation blamed = spot.has("outerConeAngle")   ? spot.at("outerConeAngle")
                              : spot.has("innerConeAngle") ? spot.at("innerConeAngle")
                                                           : spot;
  if (inner > outer + k_angle_slack_rad) {
    blamed.refuse("innerConeAngle " + inner_text + " must not be more than outerConeAngle " + outer_text);
  }
  // Exporters write it for a spot with a hard edge; it changes no cluster.
  if (inner >= outer)
    blamed.warn("innerConeAngle is outerConeAngle, where glTF asks for less; read as a spot with a hard edge");
  const double widest = std::min(outer, std::numbers::pi / 2.0);
  out.inner_cone_rad = std::min(inner, widest);
  out.outer_cone_rad = widest;
}

void read_range(const JsonLocation& light, Light& out) {
  if (!light.has("range")) return;
  const JsonLocation range = light.at("range");
  const double range_m = range.number();
  if (range_m < 0.0) range.refuse("found " + kind_of(range.value()) + ", a range of 0 or more is needed");
  if (is_float_max(range_m)) {
    range.warn("the largest number of single precision; read as no range, which is what glTF has for an endless one");
    return;
  }
  if (range_m == 0.0) {
    range.warn("a range of 0, where glTF asks for more; read as no range, so that the range rule gives one");
    return;
  }
  out.range_given_m = out.range_m = range_m;
}

void read_colour(const JsonLocation& light, Light& out) {
  if (!light.has("color")) return;
  const JsonLocation color = light.at("color");
  const bool has_alpha = color.value().is_array() && color.size() == 4;
  if (has_alpha) color.warn("found 4 numbers, 3 are needed; the fourth is ignored");
  std::vector<double> rgb = color.numbers(has_alpha ? 4 : 3);
  rgb.resize(3);
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    if (rgb[i] < 0.0) color.at(i).refuse("found " + kind_of(color.at(i).value()) + ", 0 to 1 is allowed");
    if (rgb[i] > 1.0) color.at(i).warn("a colour above 1; taken as it is");
  }
  out.color = {rgb[0], rgb[1], rgb[2]};
}

std::optional<LightType> type_of(const std::string& name) {
  if (name == "point") return LightType::point;
  if (name == "spot") return LightType::spot;
  if (name == "directional") return LightType::directional;
  return std::nullopt;
}

}  // namespace

std::optional<Light> read_light(const JsonLocation& light) {
  Light out;
  const std::optional<LightType> type = type_of(light.at("type").text());
  if (!type) {
    light.at("type").warn("the light type is not known; the light is ignored");
    return std::nullopt;
  }
  out.type = *type;
  out.name = name_of(light);
  warn_of_unknown_extras(light, {});
  read_colour(light, out);
  if (light.has("intensity")) {
    out.intensity = light.at("intensity").number();
    if (out.intensity < 0.0)
      light.at("intensity").refuse("found " + kind_of(light.at("intensity").value()) + ", 0 or more is needed");
  }
  if (out.type == LightType::directional)
    out.range_m = std::numeric_limits<double>::infinity();
  else
    read_range(light, out);
  if (out.type == LightType::spot) read_cone(spot_of(light), out);
  return out;
}

std::optional<JsonLocation> light_definitions(const JsonLocation& root) {
  if (!root.has("extensions")) return std::nullopt;
  const JsonLocation extensions = root.at("extensions");
  extensions.expect_object();
  if (!extensions.has(k_punctual)) return std::nullopt;
  return extensions.at(k_punctual).at("lights");
}

std::vector<std::optional<LightType>> checked_lights(const JsonLocation& root) {
  std::vector<std::optional<LightType>> out;
  const std::optional<JsonLocation> lights = light_definitions(root);
  if (!lights) return out;
  const std::size_t count = lights->elements();
  out.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<Light> light = read_light(lights->at(i));
    out.push_back(light ? std::optional(light->type) : std::nullopt);
  }
  return out;
}

}  // namespace clusterbench::scene
