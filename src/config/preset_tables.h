#pragma once
// The rows of presets(): those known from papers, talks and articles, and those of engines with code to read.

#include <span>

#include "config/presets.h"

namespace clusterbench::config {

std::span<const Preset> published_presets();
std::span<const Preset> engine_presets();

// Tiles by the engines' own arithmetic, for Preset::tiles.
nlohmann::json filament_tiles(Vec2i viewport);
nlohmann::json bevy_tiles(Vec2i viewport);
nlohmann::json eevee_tiles(Vec2i viewport);

}  // namespace clusterbench::config
