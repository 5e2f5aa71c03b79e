#pragma once
// Scenes of a configuration: files, rigs, their cameras and frames.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/json_text.h"

namespace clusterbench::config {

// A path that a configuration has: from its folder on, with environment variables (${NAME}). `where`: in the text, for
// messages.
std::filesystem::path path_in(const JsonText& text, const std::string& given, const std::string& where);

// `scene` has its defaults filled in, and stands at `pointer`. Several: of `paths`, and of a rig's axes.
void add_scenes(const nlohmann::json& scene, const std::string& pointer, const JsonText& text,
                std::vector<SceneRequest>& out);

// In pixels, one for each frame in turn; none without.
std::vector<Vec2d> jitter_of(const nlohmann::json& jitter);

}  // namespace clusterbench::config
