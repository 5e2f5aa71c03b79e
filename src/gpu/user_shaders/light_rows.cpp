#include "gpu/user_shaders/light_rows.h"

#include <cmath>

#include "gpu/user_shaders/known_values.h"

namespace clusterbench::gpu {
namespace {

constexpr double k_pi = 3.14159265358979323846;

// A light in the space of the shader.
struct GivenLight {
  Vec3d position{0.0}, direction{0.0};
  double range = 0.0, cone_rad = k_pi, type = 0.0, index = 0.0;
};

// Those of view space are the single-precision numbers that all methods get.
GivenLight light_in_view(const view::LightArrays& lights, std::uint32_t light, double sign) {
  const auto number = [](float value) { return static_cast<double>(value); };
  GivenLight out;
  out.position = {number(lights.x[light]), number(lights.y[light]), sign * number(lights.z[light])};
  if (!lights.is_spot(light)) return out;
  const std::uint32_t spot = light - lights.spots.first;
  out.direction = {number(lights.axis_x[spot]), number(lights.axis_y[spot]), sign * number(lights.axis_z[spot])};
  return out;
}

GivenLight light_in_world(const view::LightArrays& lights, std::uint32_t light) {
  GivenLight out;
  out.position = lights.source[light].position;
  if (lights.is_spot(light)) out.direction = lights.source[light].direction;
  return out;
}

GivenLight given_light(const result::ShaderMethod& method, const view::LightArrays& lights, std::uint32_t light) {
  const bool is_in_world = method.lights.space.value_or("view") == "world";
  GivenLight out = is_in_world ? light_in_world(lights, light) : light_in_view(lights, light, depth_sign(method));
  out.range = static_cast<double>(lights.radius[light]);
  out.index = light;
  if (!lights.is_spot(light)) return out;
  out.type = 1.0;
  const std::uint32_t spot = light - lights.spots.first;
  out.cone_rad = std::atan2(static_cast<double>(lights.sin_angle[spot]), static_cast<double>(lights.cos_angle[spot]));
  return out;
}

double number_in(const GivenLight& light, const std::string& is) {
  if (is == "x") return light.position.x;
  if (is == "y") return light.position.y;
  if (is == "z") return light.position.z;
  if (is == "range") return light.range;
  if (is == "range-squared") return light.range * light.range;
  if (is == "range-inverse") return 1.0 / light.range;
  if (is == "range-inverse-squared") return 1.0 / (light.range * light.range);
  if (is == "cone-radians") return light.cone_rad;
  if (is == "cone-degrees") return light.cone_rad * 180.0 / k_pi;
  if (is == "cone-cosine") return std::cos(light.cone_rad);
  if (is == "cone-sine") return std::sin(light.cone_rad);
  return is == "type" ? light.type : light.index;
}

std::vector<double> numbers_in(const GivenLight& light, const std::string& is) {
  const Vec3d& p = light.position;
  const Vec3d& d = light.direction;
  if (is == "position") return {p.x, p.y, p.z};
  if (is == "direction") return {d.x, d.y, d.z};
  if (is == "direction-to-light") return {-d.x, -d.y, -d.z};
  return {number_in(light, is)};
}

}  // namespace

void write_lights(const result::ShaderMethod& method, const result::ShaderLightRows& rows,
                  const view::LightArrays& lights, ByteImage& out, const std::string& where) {
  const std::uint32_t count = lights.boxes.first;
  out.grow(bytes_of_lights(rows, count));
  for (std::uint32_t light = 0; light < count; ++light) {
    const GivenLight given = given_light(method, lights, light);
    const std::uint64_t row = rows.at.value_or(0) + std::uint64_t{light} * rows.stride;
    for (std::size_t i = 0; i < rows.fields.size(); ++i)
      out.write(row + rows.fields[i].at, rows.fields[i].type, 0, numbers_in(given, rows.fields[i].is),
                where + "/fields/" + std::to_string(i));
  }
}

std::uint64_t bytes_of_lights(const result::ShaderLightRows& rows, std::uint64_t lights) {
  return lights == 0 ? 0 : rows.at.value_or(0) + lights * rows.stride;
}

std::size_t numbers_of(const result::ShaderLightField& field) {
  return field.is == "position" || field.is.starts_with("direction") ? 3 : 1;
}

}  // namespace clusterbench::gpu
