#pragma once
// What the command line changes of a configuration: a flag for each thing that people change, and --set for every key.

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "config/json_text.h"

namespace clusterbench::config {

struct ConfigFlag {
  const char* name;  // "--tiles"
  const char* summary;
  bool is_repeatable = false;  // each time another setting; of the others repetition makes a longer list
};
std::span<const ConfigFlag> config_flags();

struct FlagValue {
  std::string name, value;

  std::string text() const { return name + "=" + value; }
  std::string shown() const;  // the same, cut where it is too long for a message
};

// Whether --set sets something of a key at the top (a regular expression).
bool names_key(std::span<const FlagValue> values, const std::string& key);
// Whether one of them says something of grids, assigners or storages.
bool name_clusterings(std::span<const FlagValue> values);

// The flag by which a key of the configuration's grids is set where neither it nor another flag names any: those of the
// defaults, which nobody asks for beside presets. nullptr: none.
const FlagValue* flag_of_unnamed_grids(std::span<const FlagValue> values);

// Members of a grid, and the flag of each that is set: "/tiles/pixels", "/slices/count", "/kind".
struct GridChange {
  nlohmann::json grid = nlohmann::json::object();
  std::map<std::string, FlagValue> flags;
};
// Whether a flag says something of grids: their kind, tiles, slices, scheme, or --set of one of their keys.
bool changes_grid(const FlagValue& flag);
// What such flags say of one grid, whichever entry a key of --set names. Throws Error that names the flag.
GridChange grid_change(std::span<const FlagValue> values);

enum class GridsFrom : std::uint8_t { file, defaults };

// `document` is a configuration with all its defaults. Applied in the order of config_flags(), whatever that of
// `values`. The result is to be read by the schema again: its `flags` say which flag has set what. Throws Error that
// names the flag.
JsonText changed_by_flags(const nlohmann::json& document, GridsFrom grids, const std::string& file,
                          std::span<const FlagValue> values);

}  // namespace clusterbench::config
