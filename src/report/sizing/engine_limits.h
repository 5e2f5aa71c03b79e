#pragma once
// Engines whose limits can be set, what each limit has to have room for, and the value that it is to be set to.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "report/sizing/allocation.h"

namespace clusterbench::report {

// What a setting has to have room for.
enum class Needed : std::uint8_t {
  lights_in_view,
  lights_of_type,
  lights_in_scene,
  longest_list,
  entries,
  entries_per_cell  // all entries / cells, rounded up: a pool that is so many times as large as there are cells
};

// What a limit on lights changes.
bool is_of_lists(Needed needed);

struct LimitSetting {
  const char* name;  // as it stands in the engine
  Needed needed;
  std::uint64_t default_value, least, most;  // as the engine comes, and what it takes
  std::uint64_t multiple = 1;
  bool is_constant = false;  // compiled in: nothing to set, and frames can still have more
};

struct EngineRow {
  const char* preset;    // of which it is in all else: engine, version
  const char* settings;  // where they are set
  const char* grid;  // the call or member that the grid is set with: X, Y, Z stand for the cells, P for a tile's pixels
  // In its place where nothing of the grid is changed: what to do with its settings; "": they are the engine's own.
  const char* own_grid;
  // What of the grid can be set, as pointers into a configuration's grid: "/tiles/pixels" (of square tiles),
  // "/tiles/count", "/slices/count", "/cells".
  std::vector<const char*> grid_keys;
  std::vector<LimitSetting> limits;
  const char* beyond;  // what happens beyond the limit
};

inline constexpr std::uint64_t k_any = 0xffffffff;  // `most` of a setting that takes as much as is asked for

const std::vector<EngineRow>& engine_rows();
// "Bevy (0.20-dev of August 2026), GlobalClusterGpuSettings": the engine and the version that the preset is of.
std::string version_text(const EngineRow& row);
// What a search has to make large for it, by its name in `worst-case --measure`; "": nothing that a search changes.
std::string measure_of(Needed needed);
// How flags set what of its grid can be set: "--tiles N (pixels of a square tile), --slices N"; "" where nothing can
// be.
std::string settable_grid_text(const EngineRow& row);
// nullptr: no such row.
const EngineRow* row_of_engine(const std::string& name);

// Why there is nothing to set of an engine whose limits are compiled in: "its lists grow"; "" of others.
std::string why_nothing_is_set(const std::string& name);

struct SettingValue {
  const LimitSetting* setting;
  std::optional<std::uint64_t> seen, found;
  std::uint64_t value = 0;   // to set
  std::uint64_t wanted = 0;  // before the engine's largest value
  bool is_all = false;       // as many as the level has

  std::uint64_t needed() const { return std::max(seen.value_or(0), found.value_or(0)); }
  bool is_too_much() const { return needed() > setting->most; }
};

SettingValue value_of(const LimitSetting& setting, const SizedStructure& structure, const AllocationRules& rules);

}  // namespace clusterbench::report
