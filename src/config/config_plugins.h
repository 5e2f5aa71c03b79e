#pragma once
// The plug-ins of a configuration. They are loaded before it is read: its methods and their parameters may be theirs.

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "config/config_flags.h"
#include "config/schema/json_text.h"
#include "plugin/plugins.h"

namespace clusterbench::config {

// Loads those of --plugin. Throws Error.
void load_plugins(std::span<const FlagValue> flags);
// Loads those of the key `plugins` and of --plugin. Of a method that has a plug-in's name ("acme.tiles") and is not
// known then, it looks for acme.so in the folders of CLUSTERBENCH_PLUGIN_PATH, and adds what it finds to the key.
// Throws Error.
void load_plugins(JsonText& text, std::span<const FlagValue> flags);

struct Config;
// Those that a configuration's methods come from, each once.
std::vector<const plugin::LoadedPlugin*> plugins_of(const Config& config);

// Sets the key `plugins` of a configuration that is written for another folder, if methods of `config` need it.
void name_plugins(const Config& config, nlohmann::ordered_json& written);

// A file of --plugin as it is written into this configuration: relative to its folder.
std::string plugin_path_for(const std::string& configuration, const std::string& given);

}  // namespace clusterbench::config
