#pragma once
// Engines with adjustable limits, the quantity that each limit must have room for, and the value to set.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "report/sizing/allocation.h"

namespace clusterbench::report {

// The quantity that a setting must have room for.
enum class Needed : std::uint8_t {
  lights_in_view,
  lights_of_type,
  lights_in_scene,
  longest_list,
  entries,
  entries_per_cell  // all entries / cells, rounded up: for a pool sized by the number of cells
};

// Whether the limit is on entries of lists, not on lights.
bool is_of_lists(Needed needed);

struct LimitSetting {
  const char* name;  // in the engine
  Needed needed;
  std::uint64_t default_value, least, most;  // the engine's default, and its range
  std::uint64_t multiple = 1;
  bool is_constant = false;  // compiled in: cannot be set, and frames can still need more
};

struct EngineRow {
  const char* preset;    // of the engine version, for all other properties
  const char* settings;  // where they are set
  const char* grid;      // the call or member that sets the grid: X, Y, Z stand for the cells, P for a tile's pixels
  // Its replacement for an unchanged grid: how to set the grid's settings; "": they are the engine's own.
  const char* own_grid;
  // Settings of the grid, as pointers into a configuration's grid: "/tiles/pixels" (of square tiles), "/tiles/count",
  // "/slices/count", "/cells".
  std::vector<const char*> grid_keys;
  std::vector<LimitSetting> limits;
  const char* beyond;  // the effect beyond the limit
};

inline constexpr std::uint64_t k_any = 0xffffffff;  // `most` of a setting without an upper bound

const std::vector<EngineRow>& engine_rows();
// "Bevy (0.20-dev of August 2026), GlobalClusterGpuSettings": the engine and the version that the preset models.
std::string version_text(const EngineRow& row);
// The measure that a search should maximise for it, a name of `worst-case --measure`; "": a search cannot change it.
std::string measure_of(Needed needed);
// The flags that change its grid: "--tiles N (pixels of a square tile), --slices N"; "" if there are none.
std::string settable_grid_text(const EngineRow& row);
// nullptr: no such row.
const EngineRow* row_of_engine(const std::string& name);

// Why an engine with compiled-in limits has no settings: "its lists grow"; "" for others.
std::string why_nothing_is_set(const std::string& name);

struct SettingValue {
  const LimitSetting* setting;
  std::optional<std::uint64_t> seen, found;
  std::uint64_t value = 0;   // to set
  std::uint64_t wanted = 0;  // before the clamp to the engine's largest value
  bool is_all = false;       // as many as the level has

  std::uint64_t needed() const { return std::max(seen.value_or(0), found.value_or(0)); }
  bool is_too_much() const { return needed() > setting->most; }
};

SettingValue value_of(const LimitSetting& setting, const SizedStructure& structure, const AllocationRules& rules);

}  // namespace clusterbench::report
