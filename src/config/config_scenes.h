#pragma once
// Scenes of a configuration: files, rigs, their cameras and frames.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/json_text.h"

namespace clusterbench::config {

// Resolves a path of a configuration: relative to its folder, with environment variables (${NAME}). `where`: position
// in the text, for messages.
std::filesystem::path path_in(const JsonText& text, const std::string& given, const std::string& where);

// `scene` has its defaults filled in; its pointer is `pointer`. Adds several scenes for `paths`, and for axes of a rig.
void add_scenes(const nlohmann::json& scene, const std::string& pointer, const JsonText& text,
                std::vector<SceneRequest>& out);

// In pixels, one per frame in turn; empty without jitter.
std::vector<Vec2d> jitter_of(const nlohmann::json& jitter);

}  // namespace clusterbench::config
