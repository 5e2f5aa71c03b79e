#include "config/config_scenes.h"

#include <optional>

#include "config/config_grids.h"
#include "core/error.h"
#include "core/file_text.h"
#include "os/environment.h"
#include "scene/camera_jitter.h"
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
    const std::optional<std::string> value = os::variable(name);
    if (!value)
      throw Error(file, where, "the environment variable '" + name + "' is not set; set it to use '" + path + "'");
    path.replace(begin, end + 1 - begin, *value);
    begin += value->size();
  }
  return path;
}

void set_frames(const Json& frames, const std::string& pointer, const JsonText& text, scene::PathRequest& request) {
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
}

scene::PathRequest path_request(const SceneKeys& scene, const std::string& pointer, const JsonText& text) {
  scene::PathRequest request;
  if (scene.fov) {
    request.field_of_view = scene::field_of_view(*scene.fov);
    if (!request.field_of_view)
      throw Error(text.file, text.where(pointer + "/fov"),
                  "'" + *scene.fov +
                      "' is no field of view; takes degrees above 0 and below 180 with h (across the picture) or "
                      "v (up and down), as in 90h or 60v");
  }
  request.far_m = scene.far;
  request.camera = scene.camera;
  request.fit = scene.camera_fit;
  set_frames(scene.frames, pointer, text, request);
  return request;
}

// The name, or the index as text.
std::string chosen(const std::optional<result::Json>& choice) {
  if (!choice) return "";
  return choice->is_string() ? choice->get<std::string>() : std::to_string(choice->get<std::uint64_t>());
}

// The folder of relative paths: that of the configuration, or the working directory if it comes through a pipe.
fs::path folder_of(const std::string& file) {
  return is_stream_name(file) ? fs::path() : fs::path(file).parent_path();
}

// Expands a rig's axes into their product. `rig` has its defaults filled in.
std::vector<scene::RigSpec> rig_specs(const Json& rig, const JsonText& text, const std::string& pointer) {
  std::vector<scene::RigSpec> specs;
  for (const Json& sized : expand_all_axes(rig, text, pointer, {"size"}))
    specs.push_back(read_keys<scene::RigSpec>(sized));
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
  const auto keys = read_keys<SceneKeys>(scene);
  if (keys.path.has_value() + keys.paths.has_value() + keys.rig.has_value() != 1)
    throw Error(text.file, text.where(pointer), "a scene takes exactly one of path, paths, rig");
  SceneRequest request;
  request.camera = path_request(keys, pointer, text);
  request.range_rule = keys.range_rule;
  request.boxes = keys.boxes.value_or(false);
  request.choice = {chosen(keys.chosen_scene), chosen(keys.chosen_animation)};
  for (const char* key : {"scene", "animation"})
    if (keys.rig && scene.contains(key))
      throw Error(text.file, text.where(pointer + "/" + key), std::string("a rig has no ") + key + "; a file has some");
  if (request.boxes && keys.rig)
    throw Error(text.file, text.where(pointer + "/boxes"), "a rig has no boxes; a scene from a file may have some");
  if (keys.rig) {
    for (const scene::RigSpec& rig : rig_specs(*keys.rig, text, pointer + "/rig")) {
      request.rig = rig;
      out.push_back(request);
    }
    return;
  }
  const std::vector<std::string> paths = keys.paths ? *keys.paths : std::vector{*keys.path};
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string location = keys.path ? pointer + "/path" : child_pointer(pointer + "/paths", i);
    if (paths[i].find("://") != std::string::npos)
      throw Error(text.file, text.where(location), "'" + paths[i] + "' is a web address; a scene is a file here");
    request.path = path_in(text, paths[i], text.where(location));
    if (!text.file.empty()) {
      request.named_by = text.file;
      request.named_at = text.where(location);
    }
    out.push_back(request);
  }
}

}  // namespace clusterbench::config
