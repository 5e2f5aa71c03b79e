#pragma once
// Changes of a configuration by the command line: a flag for each common setting, and --set for every key.

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "config/schema/json_text.h"

namespace clusterbench::config {

struct ConfigFlag {
  const char* name;  // "--tiles"
  const char* summary;
  bool is_repeatable = false;  // each use adds a setting; repetitions of other flags extend one list
};
std::span<const ConfigFlag> config_flags();

struct FlagValue {
  std::string name, value;

  std::string text() const { return name + "=" + value; }
  std::string shown() const;  // the same, truncated for messages
};

// Whether --set changes something in a top-level key (a regular expression).
bool names_key(std::span<const FlagValue> values, const std::string& key);
// Whether one of them sets grids, assigners or storages.
bool name_clusterings(std::span<const FlagValue> values);

// The flag that changes a key of the default grids while no flag names a grid. Those grids are not used beside presets.
// nullptr: no such flag.
const FlagValue* flag_of_unnamed_grids(std::span<const FlagValue> values);

// Members of a grid, and the flag that set each of them: "/tiles/pixels", "/slices/count", "/kind".
struct GridChange {
  nlohmann::json grid = nlohmann::json::object();
  std::map<std::string, FlagValue> flags;
};
// Whether a flag changes grids: their kind, tiles, slices, scheme, or --set of one of their keys.
bool changes_grid(const FlagValue& flag);
// The changes by such flags of one grid; the entry in a key of --set is ignored. Throws Error that names the flag.
GridChange grid_change(std::span<const FlagValue> values);

enum class GridsFrom : std::uint8_t { file, defaults };

// `document`: a configuration with all its defaults. Applies flags in the order of config_flags(), not in that of
// `values`. The result must be read by the schema again; its `flags` name the flag behind each changed key. Throws
// Error that names the flag.
JsonText changed_by_flags(const nlohmann::json& document, GridsFrom grids, const std::string& file,
                          std::span<const FlagValue> values);

}  // namespace clusterbench::config
