#include "config/config_scenes.h"

#include <cstdlib>

#include "config/config_grids.h"
#include "core/error.h"
#include "core/file_text.h"
#include "scene/rig.h"

namespace clusterbench::config {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Replaces "${NAME}" by the value of the environment variable.
std::string expanded(std::string path, const std::string& file, const std::string& where) {
  for (std::size_t begin = path.find("${"); begin != std::string::npos; begin = path.find("${", begin)) {
    const std::size_t end = path.find('}', begin);
    if (end == std::string::npos) throw Error(file, where, "found '${' without '}' in '" + path + "'");
    const std::string name = path.substr(begin + 2, end - begin - 2);
    const char* value = std::getenv(name.c_str());
    if (value == nullptr)
      throw Error(file, where, "the environment variable '" + name + "' is not set; set it to use '" + path + "'");
    path.replace(begin, end + 1 - begin, value);
    begin += std::string(value).size();
  }
  return path;
}

scene::PathRequest path_request(const Json& scene, const std::string& pointer, const JsonText& text) {
  scene::PathRequest request;
  if (scene.contains("fov")) {
    const auto angle = scene["fov"].get<std::string>();
    request.field_of_view = scene::field_of_view(angle);
    if (!request.field_of_view)
      throw Error(text.file, text.where(pointer + "/fov"),
                  "'" + angle +
                      "' is no field of view; takes degrees above 0 and below 180 with h (across the picture) or "
                      "v (up and down), as in 90h or 60v");
  }
  if (scene.contains("far")) request.far_m = scene["far"].get<double>();
  request.camera = scene["camera"].get<std::string>();
  if (scene["camera_fit"] == "vertical") request.fit = scene::CameraFit::vertical;
  const Json& frames = scene["frames"];
  if (frames.is_object() &&
      (frames.contains("rate") == frames.contains("most") || (frames.contains("lights") && !frames.contains("most"))))
    throw Error(text.file, text.where(pointer + "/frames"),
                "takes either rate, or most and with it lights; found " + frames.dump());
  if (frames.is_number()) {
    request.count = frames.get<int>();
  } else if (frames.is_string()) {
    request.choice = scene::FrameChoice::keys;
  } else if (frames.contains("most")) {
    request.count = frames["most"].get<int>();
    request.most_lights = frames.value("lights", 0.0);
  } else {
    request.choice = scene::FrameChoice::rate;
    request.rate_hz = frames["rate"].get<double>();
  }
  return request;
}

// The name, or the index as text.
std::string chosen(const Json& scene, const char* key) {
  if (!scene.contains(key)) return "";
  return scene[key].is_string() ? scene[key].get<std::string>() : std::to_string(scene[key].get<std::uint64_t>());
}

// The folder of relative paths: that of the configuration, or the working directory if it comes through a pipe.
fs::path folder_of(const std::string& file) {
  return is_stream_name(file) ? fs::path() : fs::path(file).parent_path();
}

// Expands a rig's axes into their product. `rig` has its defaults filled in.
std::vector<scene::RigSpec> rig_specs(const nlohmann::json& rig) {
  std::vector<scene::RigSpec> specs;
  for (const nlohmann::json& sized : expand_all_axes(rig, {"size"})) {
    scene::RigSpec spec;
    spec.lights = sized["lights"].get<int>();
    spec.spots = sized["spots"].get<double>();
    spec.range_m = sized["range"].get<double>();
    spec.size_m = {sized["size"][0].get<double>(), sized["size"][1].get<double>(), sized["size"][2].get<double>()};
    spec.seed = sized["seed"].get<std::uint64_t>();
    specs.push_back(spec);
  }
  return specs;
}

}  // namespace

fs::path path_in(const JsonText& text, const std::string& given, const std::string& where) {
  return (folder_of(text.file) / expanded(given, text.file, where)).lexically_normal();
}

std::vector<Vec2d> jitter_of(const Json& jitter) {
  constexpr int k_usual = 8;
  std::vector<Vec2d> offsets;
  if (jitter.is_string()) return scene::halton_jitter(k_usual);
  if (jitter.is_object()) return scene::halton_jitter(jitter["halton"].get<int>());
  if (jitter.is_array())
    for (const Json& offset : jitter) offsets.emplace_back(offset[0].get<double>(), offset[1].get<double>());
  return offsets;
}

void add_scenes(const Json& scene, const std::string& pointer, const JsonText& text, std::vector<SceneRequest>& out) {
  const bool single = scene.contains("path"), has_rig = scene.contains("rig");
  if (single + scene.contains("paths") + has_rig != 1)
    throw Error(text.file, text.where(pointer), "a scene takes exactly one of path, paths, rig");
  SceneRequest request;
  request.camera = path_request(scene, pointer, text);
  request.range_rule = {scene["range_rule"]["cutoff_lux"].get<double>(),
                        scene["range_rule"]["max_range"].get<double>()};
  request.boxes = scene.value("boxes", false);
  request.choice = {chosen(scene, "scene"), chosen(scene, "animation")};
  for (const char* key : {"scene", "animation"})
    if (has_rig && scene.contains(key))
      throw Error(text.file, text.where(pointer + "/" + key), std::string("a rig has no ") + key + "; a file has some");
  if (request.boxes && has_rig)
    throw Error(text.file, text.where(pointer + "/boxes"), "a rig has no boxes; a scene from a file may have some");
  if (has_rig) {
    for (const scene::RigSpec& rig : rig_specs(scene["rig"])) {
      request.rig = rig;
      out.push_back(request);
    }
    return;
  }
  const Json paths = single ? Json::array({scene["path"]}) : scene["paths"];
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string location = single ? pointer + "/path" : child_pointer(pointer + "/paths", i);
    const auto given = paths[i].get<std::string>();
    if (given.find("://") != std::string::npos)
      throw Error(text.file, text.where(location), "'" + given + "' is a web address; a scene is a file here");
    request.path = path_in(text, given, text.where(location));
    if (!text.file.empty()) {
      request.named_by = text.file;
      request.named_at = text.where(location);
    }
    out.push_back(request);
  }
}

}  // namespace clusterbench::config
