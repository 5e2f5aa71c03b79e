#pragma once
// Clusterings as engines, papers and articles have them: a grid, a method and a light structure each, and what the
// engine does to lights before.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "geom/shapes/vec.h"

namespace clusterbench::config {

// What a preset rests on. ran: the engine's own code, or a transcription of it, was run on the same lights, and its
// lists were compared cell by cell. read: its code or what its authors have published was read. memory: neither.
enum class Evidence : std::uint8_t { ran, read, memory };
const char* name_of(Evidence evidence);  // "ran", "read", "memory"

// Where an engine makes its lists. Those of a GPU's shader or rasteriser are not uploaded, and the time that a method
// takes on a CPU is not the engine's.
enum class AssignsOn : std::uint8_t { cpu, gpu };
const char* name_of(AssignsOn place);  // "cpu", "gpu"

struct Preset {
  const char* name;
  const char* engine;
  const char* version;  // of the code or the publication: a release, a commit, a year
  Evidence evidence;
  const char* source;        // what was read or run
  const char* summary;       // the scheme in a line
  const char* approximated;  // what is not as there, in one sentence; "" where nothing is known to differ
  const char* unverified;    // what stands on memory alone; "" where nothing does
  AssignsOn assigns_on;
  // Members of a configuration's entries as JSON: {"grid": {...}, "assigner": {...}, "storage": {...}, "pre_cull":
  // [...]}; without storage the method's own structure, without pre_cull all lights.
  const char* parts;
  // What to know before it is taken, where another preset is of the same engine; "" where nothing.
  const char* remark = "";
  // The mistakes of the engine as it is shipped, in words, and what changes in the parts with them: members of the grid
  // one by one, of the others as a whole. "" where none is modelled.
  const char* mistakes = "";
  const char* as_shipped = "";
  // The grid's tiles where they depend on the viewport, as a configuration has them; or null.
  nlohmann::json (*tiles)(Vec2i viewport) = nullptr;

  bool has_mistakes() const { return *mistakes != '\0'; }
};

// In the order in which they are shown; names are unique.
std::span<const Preset> presets();
const Preset* find_preset(const std::string& name);  // null where there is none
std::vector<std::string> preset_names();

// Its parts for a viewport: the scheme without the engine's mistakes, or as it is shipped.
nlohmann::json preset_parts(const Preset& preset, Vec2i viewport, bool as_shipped = false);

// What it has room for, of lights and per cell, in words: "255 lights in view, the first; 255 in a cell"; "" where no
// limit is known.
std::string limit_text(const Preset& preset);
// The most lights that it takes in a frame, of each type where the limit is one of types; 0: no limit is known.
std::uint64_t most_lights(const Preset& preset);

// Names written out: each entry is a name or a pattern (* any letters, ? one); each preset once, in the order in which
// they are first named. Throws Error with `file` and `where` for what names none.
std::vector<std::string> named_presets(std::span<const std::string> entries, const std::string& file,
                                       const std::string& where);

}  // namespace clusterbench::config
