#include "scene/generators/stage.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scene/scene.h"

namespace clusterbench::scene {
namespace {

using Json = nlohmann::ordered_json;

constexpr double k_pi = 3.14159265358979323846;

double rounded(double value, double steps) {
  const double result = std::round(value * steps) / steps;
  return result == 0.0 ? 0.0 : result;  // no -0
}

// Rounded to a tenth of a millimetre.
Json position_json(const Vec3d& p) {
  return {rounded(p.x, 1e4), rounded(p.y, 1e4), rounded(p.z, 1e4)};
}

Vec4d yaw_rotation(double yaw_rad) {
  return {0.0, std::sin(yaw_rad / 2.0), 0.0, std::cos(yaw_rad / 2.0)};
}

Json rotation_json(const Vec4d& q) {
  return {rounded(q.x, 1e7), rounded(q.y, 1e7), rounded(q.z, 1e7), rounded(q.w, 1e7)};
}

void append_u32(std::string& bytes, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((value >> shift) & 0xff);
}

void append_chunk(std::string& bytes, const char* type, std::string body, char padding) {
  body.resize((body.size() + 3) / 4 * 4, padding);
  append_u32(bytes, body.size());
  bytes += type;
  if (std::strlen(type) == 3) bytes += '\0';
  bytes += body;
}

}  // namespace

Stage::Stage(std::uint64_t seed) : random_(seed) {
  document_["asset"] = {{"version", "2.0"}};
  document_["extensionsUsed"] = Json::array({"KHR_lights_punctual"});
  document_["scene"] = 0;
  document_["scenes"] = Json::array({Json{{"nodes", Json::array()}}});
  document_["nodes"] = Json::array();
}

Vec3d Stage::position_in(const Vec3d& lo, const Vec3d& hi) {
  const double x = random_.between(lo.x, hi.x), y = random_.between(lo.y, hi.y), z = random_.between(lo.z, hi.z);
  return {x, y, z};
}

int Stage::add_node(Json node, int parent) {
  const int index = static_cast<int>(document_["nodes"].size());
  document_["nodes"].push_back(std::move(node));
  Json& siblings =
      parent < 0 ? document_["scenes"][0]["nodes"] : document_["nodes"][static_cast<std::size_t>(parent)]["children"];
  siblings.push_back(index);
  return index;
}

// Equal lights share one definition.
int Stage::light_definition(const Json& light) {
  const auto [found, is_new] = definitions_.try_emplace(light.dump(), static_cast<int>(definitions_.size()));
  if (is_new) document_["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
  return found->second;
}

// Warm, white or cold; bright enough for 0.05 lux at its range.
Json Stage::definition(const char* type, double range_m) {
  constexpr double k_colours[3][3] = {{1.0, 0.78, 0.55}, {1.0, 1.0, 1.0}, {0.7, 0.85, 1.0}};
  const auto& colour = k_colours[random_.below(3)];
  Json light{{"type", type}, {"color", {colour[0], colour[1], colour[2]}}};
  const double range = rounded(range_m, 1e2);
  light["intensity"] = rounded(range_m == 0.0 ? 40.0 : 0.05 * range * range, 1e3);
  if (range_m != 0.0) light["range"] = range;
  return light;
}

void Stage::point(const std::string& name, const Vec3d& position, double range_m, int parent) {
  const int light = light_definition(definition("point", range_m));
  ++light_count_;
  add_node({{"name", name},
            {"translation", position_json(position)},
            {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}},
           parent);
}

void Stage::spot(const std::string& name, const Vec3d& position, const Vec3d& direction, double range_m,
                 double half_angle_deg, int parent) {
  Json light = definition("spot", range_m);
  const double outer = std::min(rounded(half_angle_deg * k_pi / 180.0, 1e6), 1.570796);
  light["spot"] = {{"innerConeAngle", rounded(outer * 0.8, 1e6)}, {"outerConeAngle", outer}};
  const int index = light_definition(light);
  ++light_count_;
  add_node({{"name", name},
            {"translation", position_json(position)},
            {"rotation", rotation_json(rotation_towards(direction))},
            {"extensions", {{"KHR_lights_punctual", {{"light", index}}}}}},
           parent);
}

void Stage::box(const std::string& name, const Vec3d& position, const Vec4d& rotation, const Vec3d& half_extents_m,
                int parent) {
  add_node({{"name", name},
            {"translation", position_json(position)},
            {"rotation", rotation_json(rotation)},
            {"extras", {{"clusterbench_box", {{"half_extents", position_json(half_extents_m)}}}}}},
           parent);
}

int Stage::mover(const std::string& name, const std::vector<PathKey>& keys) {
  const int node = add_node({{"name", name},
                             {"translation", position_json(keys.front().position)},
                             {"rotation", rotation_json(yaw_rotation(keys.front().yaw_rad))}},
                            -1);
  animate(node, keys);
  return node;
}

void Stage::camera(const std::string& name, const std::vector<PathKey>& keys, double far_m) {
  const int node = mover(name, keys);
  const Json projection{{"yfov", 1.047198}, {"aspectRatio", 1.777778}, {"znear", 0.1}, {"zfar", far_m}};
  document_["cameras"] = Json::array({Json{{"type", "perspective"}, {"perspective", projection}}});
  document_["nodes"][static_cast<std::size_t>(node)]["camera"] = 0;
}

int Stage::float_accessor(const std::vector<float>& values, const char* type, std::size_t components,
                          bool with_bounds) {
  const int view = document_.contains("bufferViews") ? static_cast<int>(document_["bufferViews"].size()) : 0;
  const std::size_t size = values.size() * sizeof(float);
  document_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}});
  buffer_.append(reinterpret_cast<const char*>(values.data()), size);
  Json accessor{{"bufferView", view}, {"componentType", 5126}, {"count", values.size() / components}, {"type", type}};
  if (with_bounds) {
    std::vector<float> least(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(components)), most = least;
    for (std::size_t i = 0; i < values.size(); ++i) {
      least[i % components] = std::min(least[i % components], values[i]);
      most[i % components] = std::max(most[i % components], values[i]);
    }
    accessor["min"] = least;
    accessor["max"] = most;
  }
  document_["accessors"].push_back(accessor);
  return view;  // one accessor per view
}

void Stage::mesh(const std::string& name, const std::vector<Vec3d>& corners) {
  std::vector<float> positions;
  for (const Vec3d& corner : corners)
    for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(rounded(corner[axis], 1e4)));
  const int accessor = float_accessor(positions, "VEC3", 3, true);
  const std::size_t mesh = document_.contains("meshes") ? document_["meshes"].size() : 0;
  document_["meshes"].push_back(
      {{"name", name}, {"primitives", Json::array({Json{{"attributes", {{"POSITION", accessor}}}}})}});
  add_node({{"name", name}, {"mesh", mesh}}, -1);
}

void Stage::animate(int node, const std::vector<PathKey>& keys) {
  std::vector<float> times, positions, rotations;
  Vec4d before{0.0, 0.0, 0.0, 1.0};
  for (const PathKey& key : keys) {
    times.push_back(static_cast<float>(rounded(key.time_s, 1e3)));
    for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(rounded(key.position[axis], 1e4)));
    Vec4d q = yaw_rotation(key.yaw_rad);
    if (glm::dot(q, before) < 0.0) q = -q;
    before = q;
    for (int i = 0; i < 4; ++i) rotations.push_back(static_cast<float>(rounded(q[i], 1e7)));
  }
  const int input = float_accessor(times, "SCALAR", 1, true);
  const int translation = float_accessor(positions, "VEC3", 3, false),
            rotation = float_accessor(rotations, "VEC4", 4, false);
  if (!document_.contains("animations"))
    document_["animations"] =
        Json::array({Json{{"name", "all"}, {"channels", Json::array()}, {"samplers", Json::array()}}});
  Json& animation = document_["animations"][0];
  for (const auto& [path, output] : {std::pair{"translation", translation}, std::pair{"rotation", rotation}}) {
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
  }
}

std::string Stage::glb(const std::string& generator) const {
  Json document = document_;
  document["asset"]["generator"] = generator;
  document["buffers"] = Json::array({Json{{"byteLength", buffer_.size()}}});
  std::string chunks;
  append_chunk(chunks, "JSON", document.dump(), ' ');
  append_chunk(chunks, "BIN", buffer_, '\0');
  std::string bytes = "glTF";
  append_u32(bytes, 2);
  append_u32(bytes, 12 + chunks.size());
  return bytes + chunks;
}

void add_quad(std::vector<Vec3d>& corners, const Vec3d& from, const Vec3d& along, const Vec3d& up) {
  corners.insert(corners.end(), {from, from + along, from + along + up, from, from + along + up, from + up});
}

void add_box(std::vector<Vec3d>& corners, const Vec3d& lo, const Vec3d& hi) {
  const Vec3d size = hi - lo, x{size.x, 0.0, 0.0}, y{0.0, size.y, 0.0}, z{0.0, 0.0, size.z};
  add_quad(corners, lo, z, y);      // to -x
  add_quad(corners, lo + x, y, z);  // to +x
  add_quad(corners, lo, x, z);      // to -y
  add_quad(corners, lo + y, z, x);  // to +y
  add_quad(corners, lo, y, x);      // to -z
  add_quad(corners, lo + z, x, y);  // to +z
}

std::vector<PathKey> walk(const std::vector<Vec3d>& corners, double seconds) {
  double whole = 0.0;
  for (std::size_t i = 1; i < corners.size(); ++i) whole += glm::length(corners[i] - corners[i - 1]);
  std::vector<PathKey> keys;
  double gone = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i > 0) gone += glm::length(corners[i] - corners[i - 1]);
    const Vec3d ahead = i + 1 < corners.size() ? corners[i + 1] - corners[i] : corners[i] - corners[i - 1];
    keys.push_back({seconds * gone / whole, corners[i], std::atan2(-ahead.x, -ahead.z)});
  }
  return keys;
}

}  // namespace clusterbench::scene
