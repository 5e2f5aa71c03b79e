#pragma once
// Clusterings as engines, papers and articles have them: a grid, a method and a light structure each.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "geom/shapes/vec.h"

namespace clusterbench::config {

// Where an engine makes its lists. Those of a GPU's shader or rasteriser are not uploaded, and the time that a method
// takes on a CPU is not the engine's.
enum class AssignsOn : std::uint8_t { cpu, gpu };
const char* name_of(AssignsOn place);  // "cpu", "gpu"

struct Preset {
  const char* name;
  const char* engine;
  const char* source;        // what was read, and of which version or year
  const char* summary;       // the scheme in a line
  const char* approximated;  // what is not as there; "" where nothing is known to differ
  const char* unverified;    // what stands on memory alone; "" where all was read
  int most_lights;           // that it takes in a frame; 0: no such limit is known
  // Members of a configuration's entries as JSON: {"grid": {...}, "assigner": {...}, "storage": {...}}; without storage
  // the method's own structure.
  const char* parts;
  // Pixels of a tile where they depend on the viewport, in place of the grid's tiles; or null.
  Vec2i (*tile_pixels)(Vec2i viewport);
  AssignsOn assigns_on;
};

// In the order in which they are shown; names are unique.
std::span<const Preset> presets();
const Preset* find_preset(const std::string& name);  // null where there is none
std::vector<std::string> preset_names();

// Its parts for a viewport.
nlohmann::json preset_parts(const Preset& preset, Vec2i viewport);

// Names written out: each entry is a name or a pattern (* any letters, ? one); each preset once, in the order in which
// they are first named. Throws Error with `file` and `where` for what names none.
std::vector<std::string> named_presets(std::span<const std::string> entries, const std::string& file,
                                       const std::string& where);

}  // namespace clusterbench::config
