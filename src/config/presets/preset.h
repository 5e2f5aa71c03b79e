#pragma once
// A preset: what a file of configs/presets says.

#include <optional>
#include <string>

#include "result/fields.h"

namespace clusterbench::config {

// The changes of a preset for the engine as shipped, with its mistakes.
struct PresetChanges {
  RECORD(PresetChanges);
  FIELD(std::optional<result::Json>, grid, "Members of the grid that differ; the others stay");
  FIELD(std::optional<result::Json>, assigner, "In place of the method");
  FIELD(std::optional<result::Json>, storage, "In place of the storage");
  FIELD(std::optional<result::Json>, pre_cull, "In place of the pre-cull");
  END_RECORD;
};

// The engine's own kind of shader, for a device that a configuration names.
struct PresetOnDevice {
  RECORD(PresetOnDevice);
  FIELD(result::Json, assigner, "Entry of assigners, of a method that runs on a device");
  FIELD(std::string, approximated, "What of its steps is not as there; empty where nothing is known to differ");
  END_RECORD;
};

struct Preset {
  RECORD(Preset);
  FIELD(std::string, name, "Unique, and the name of the file");
  FIELD(std::string, engine, "Of which engine, game, paper or article");
  FIELD(std::string, version, "Of the code or the publication: a release, a commit, a year");
  // ran: the engine's own code, or a transcription of it, was run on the same lights, and its lists were compared cell
  // by cell. read: the engine's code or a publication of its authors was read. memory: neither.
  FIELD(std::string, evidence, result::About("What it rests on").one_of({"ran", "read", "memory"}));
  FIELD(std::string, source, "What was read or run");
  FIELD(std::string, summary, "The scheme in a line");
  FIELD(std::string, approximated, "What is not as there, in one sentence; empty where nothing is known to differ");
  FIELD(std::string, unverified, "What stands on memory alone; empty where nothing does");
  // gpu: lists of a shader or a rasteriser are not uploaded, and the method's time on a CPU is not the engine's.
  FIELD(std::string, assigns_on, result::About("Where the engine makes its lists").one_of({"cpu", "gpu"}));
  FIELD(std::optional<std::string>, remark,
        "What to know before it is taken, where another preset is of the same engine");
  FIELD(std::optional<std::string>, tiles_by,
        "How tiles follow the viewport (preset_tiles.h); the grid has those of 1920 x 1080 pixels");
  // In the format of entries of a configuration's lists.
  FIELD(result::Json, grid, "Entry of grids");
  FIELD(result::Json, assigner, "Entry of assigners");
  FIELD(std::optional<result::Json>, storage, "Entry of storages; without it the method's own structure");
  FIELD(std::optional<result::Json>, pre_cull, "Entry of pre_cull, a list of steps; without it all lights");
  // Of engines that assign on a GPU one of these two, of others neither.
  FIELD(std::optional<PresetOnDevice>, on_device, "In place of assigner where a configuration names a device");
  FIELD(std::optional<std::string>, not_on_device, "Why no method on a device does as the engine");
  FIELD(std::optional<std::string>, mistakes, "Of the engine as it is shipped, in words");
  FIELD(std::optional<PresetChanges>, as_shipped, "What changes with the mistakes");
  END_RECORD;

  bool has_mistakes() const { return as_shipped.has_value(); }
  bool is_from_memory() const { return evidence == "memory"; }
  bool assigns_on_gpu() const { return assigns_on == "gpu"; }
};

}  // namespace clusterbench::config
