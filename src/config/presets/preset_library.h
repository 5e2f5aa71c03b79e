#pragma once
// Clusterings of engines, papers and articles: each has a grid, a method and a light structure, and the engine's own
// culling of lights. Each is a file of configs/presets.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "config/presets/preset.h"
#include "geom/shapes/vec.h"

namespace clusterbench::config {

// In the order in which they are shown; names are unique.
std::span<const Preset> presets();
const Preset* find_preset(const std::string& name);  // null for an unknown name
std::vector<std::string> preset_names();

struct PresetForm {
  bool as_shipped = false;  // with the engine's mistakes
  bool on_device = false;   // with its method for a device, if it has one: methods as shipped have none
};

// The preset's parts for a viewport. A method that leaves a light structure of its own has no storage.
nlohmann::json preset_parts(const Preset& preset, Vec2i viewport, PresetForm form = {});

// The preset's limits on lights and on entries per cell, as text: "255 lights in view, the first; 255 in a cell"; "" if
// no limit is known.
std::string limit_text(const Preset& preset);
// The most lights per frame, per type if the limit is one per type; 0: no limit is known.
std::uint64_t most_lights(const Preset& preset);

// Expands names: each entry is a name or a pattern (* any letters, ? one); each preset once, in the order of its first
// match. Throws Error with `file` and `where` for an entry without a match.
std::vector<std::string> named_presets(std::span<const std::string> entries, const std::string& file,
                                       const std::string& where);

}  // namespace clusterbench::config
