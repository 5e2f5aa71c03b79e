#pragma once
// Scenes of a configuration: files, rigs, their cameras and frames.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/config_keys.h"
#include "config/schema/json_text.h"

namespace clusterbench::config {

// Resolves a path of a configuration: relative to its folder, with environment variables (${NAME}). `where`: position
// in the text, for messages.
std::filesystem::path path_in(const JsonText& text, const std::string& given, const std::string& where);

// The keys of an entry of `scenes`, as they stand there.
struct SceneKeys {
  RECORD(SceneKeys);
  KEY(std::optional<std::string>, path, {});
  KEY(std::optional<std::vector<std::string>>, paths, {});
  KEY(std::optional<result::Json>, rig, {});  // of a scene::RigSpec, each value or a list of them
  KEY(std::string, camera, {});
  KEY(result::Json, frames, 60);
  KEY(scene::CameraFit, camera_fit, scene::CameraFit::contain);
  KEY(std::optional<std::string>, fov, {});
  KEY(std::optional<double>, far, {});
  KEY_AS("scene", std::optional<result::Json>, chosen_scene, {});          // a name or a number
  KEY_AS("animation", std::optional<result::Json>, chosen_animation, {});  // a name or a number
  KEY(std::optional<bool>, boxes, {});
  KEY(scene::RangeRule, range_rule, {});
  END_RECORD;
};

// `scene` has its defaults filled in; its pointer is `pointer`. Adds several scenes for `paths`, and for axes of a rig.
void add_scenes(const nlohmann::json& scene, const std::string& pointer, const JsonText& text,
                std::vector<SceneRequest>& out);

// In pixels, one per frame in turn; empty without jitter.
std::vector<Vec2d> jitter_of(const nlohmann::json& jitter);

}  // namespace clusterbench::config
