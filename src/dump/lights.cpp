#include <cmath>
#include <glm/geometric.hpp>

#include "core/error.h"
#include "core/memory.h"
#include "dump/dump_frame.h"
#include "geom/shapes/domain.h"

namespace clusterbench::dump {
namespace {

constexpr double k_pi = 3.14159265358979323846;

// Where a light is, for messages.
struct LightPlace {
  std::string file, where, name;  // "lights.bin", "byte 48", "light 3"

  [[noreturn]] void refuse(const std::string& problem) const { throw Error(file, where, name + " " + problem); }
};

double range_of(double given, const std::string& is) {
  if (is == "squared") return std::sqrt(given);
  if (is == "inverse") return 1.0 / given;
  if (is == "inverse-squared") return 1.0 / std::sqrt(given);
  return given;
}

double half_angle_of(double given, const std::string& is) {
  if (is == "degrees") return given * k_pi / 180.0;
  if (is == "cosine") return std::acos(given);
  if (is == "cosine-squared") return std::acos(std::sqrt(given));
  if (is == "sine") return std::asin(given);
  if (is == "tangent") return std::atan(given);
  return given;
}

void set_range(scene::WorldLight& light, double range_m, const LightPlace& place) {
  if (!(range_m >= 0.0)) place.refuse("has a range that is no number, or below 0");
  light.range_m = geom::range_in_domain(range_m);
}

void set_position(scene::WorldLight& light, const Vec3d& position, const LightPlace& place) {
  for (int i = 0; i < 3; ++i)
    if (!geom::is_in_domain(position[i])) place.refuse("has a position that is no number, or beyond 1e15 m");
  light.position = position;
}

void make_spot(scene::WorldLight& light, const Vec3d& direction, double half_angle_rad, const LightPlace& place) {
  constexpr double k_rounding = 1e-6;
  const double length = glm::length(direction);
  if (!(length > 0.0) || !std::isfinite(length)) place.refuse("is a spot without a direction");
  if (!(half_angle_rad >= 0.0) || half_angle_rad > k_pi / 2.0 + k_rounding)
    place.refuse("is a spot whose half-angle is no number from 0 to 90 degrees");
  light.type = scene::LightType::spot;
  light.direction = direction / length;
  light.outer_cone_rad = std::min(half_angle_rad, k_pi / 2.0);
}

// One run of lights in a buffer.
class LightRowsReader {
 public:
  LightRowsReader(const result::DumpLightRows& given, const layout::BufferReader& reader, const std::string& pointer)
      : given_(given) {
    position_ = reader.field(given.position, given.stride, pointer + "/position", 3);
    range_ = reader.field({given.range.at, given.range.type, {}}, given.stride, pointer + "/range");
    if (given.direction.has_value() != given.cone.has_value())
      throw Error("", pointer + (given.cone ? "/direction" : "/cone"), "is missing: spots have a direction and a cone");
    if (given.kind && !given.cone)
      throw Error("", pointer + "/cone", "is missing: by `kind` there are spots, which have a direction and a cone");
    if (given.cone) {
      direction_ = reader.field(*given.direction, given.stride, pointer + "/direction", 3);
      cone_ = reader.field({given.cone->at, given.cone->type, {}}, given.stride, pointer + "/cone",
                           given.cone->is == "scale-offset" ? 2 : 1);
    }
    if (given.kind)
      kind_ = reader.field({given.kind->at, given.kind->type, given.kind->bits}, given.stride, pointer + "/kind");
    rows_ = reader.rows(reader.buffer(given.buffer, pointer + "/buffer"), given.at.value_or(0), given.stride,
                        given.count, given.stride, pointer, "light");
  }

  scene::WorldLight light(std::uint64_t i, const std::string& name) const {
    const std::byte* row = rows_.row(i);
    scene::WorldLight light;
    set_position(light, vector_at(row, position_), place(i, position_, name));
    set_range(light, range_of(layout::real_at(row + range_.at, range_.type), given_.range.is.value_or("range")),
              place(i, range_, name));
    const bool is_spot = given_.kind ? kind_.whole(row) == given_.kind->spot : given_.cone.has_value();
    if (!is_spot) return light;
    Vec3d direction = vector_at(row, direction_);
    if (given_.direction_is.value_or("from-light") == "to-light") direction = -direction;
    const double half_angle = half_angle_at(row);
    make_spot(light, direction, half_angle, place(i, std::isfinite(half_angle) ? direction_ : cone_, name));
    return light;
  }

 private:
  static Vec3d vector_at(const std::byte* row, const layout::Field& field) {
    const std::uint64_t step = layout::size_of(field.type);
    const auto number = [&](std::uint64_t i) { return layout::real_at(row + field.at + i * step, field.type); };
    return {number(0), number(1), number(2)};
  }
  double half_angle_at(const std::byte* row) const {
    const double number = layout::real_at(row + cone_.at, cone_.type);
    if (given_.cone->is != "scale-offset") return half_angle_of(number, given_.cone->is);
    return std::acos(-layout::real_at(row + cone_.at + layout::size_of(cone_.type), cone_.type) / number);
  }
  LightPlace place(std::uint64_t i, const layout::Field& field, const std::string& name) const {
    return {rows_.buffer().file, "byte " + std::to_string(rows_.byte_of(i) + field.at), name};
  }

  const result::DumpLightRows& given_;
  layout::Field position_, range_, direction_, cone_, kind_;
  layout::Rows rows_;
};

std::string light_name(std::size_t index) {
  return "light " + std::to_string(index);
}

scene::WorldLight listed_light(const result::DumpLight& given, const LightPlace& place) {
  scene::WorldLight light;
  set_position(light, {given.position[0], given.position[1], given.position[2]}, place);
  set_range(light, given.range_m, place);
  if (given.direction.has_value() != given.half_angle_deg.has_value())
    place.refuse("has one of direction and half_angle_deg; allowed: both (a spot), or neither (a point)");
  if (given.direction)
    make_spot(light, {(*given.direction)[0], (*given.direction)[1], (*given.direction)[2]},
              *given.half_angle_deg * k_pi / 180.0, place);
  return light;
}

}  // namespace

std::vector<scene::WorldLight> lights_of(const DumpFile& dump) {
  const result::DumpLights& given = dump.record.lights;
  std::vector<scene::WorldLight> lights;
  const layout::BufferReader reader(dump.buffers);
  if (given.rows) {
    for (std::size_t i = 0; i < given.rows->size(); ++i) {
      const result::DumpLightRows& rows = (*given.rows)[i];
      const std::string pointer = "/lights/rows/" + std::to_string(i);
      const LightRowsReader from(rows, reader, pointer);
      check_memory("lights", lights.size() + rows.count, sizeof(scene::WorldLight));
      if (lights.size() + rows.count > 0xfffffffeu)
        throw Error("", pointer + "/count", "is " + std::to_string(rows.count) + "; at most 2^32 - 2 lights are read");
      for (std::uint64_t light = 0; light < rows.count; ++light)
        lights.push_back(from.light(light, light_name(lights.size())));
    }
  } else {
    for (std::size_t i = 0; i < given.listed->size(); ++i)
      lights.push_back(
          listed_light((*given.listed)[i], {dump.path.string(), "/lights/listed/" + std::to_string(i), light_name(i)}));
  }
  return lights;
}

}  // namespace clusterbench::dump
