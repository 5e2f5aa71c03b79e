#pragma once
// What a command measures: a configuration or scenes, and the flags that change it.

#include <filesystem>
#include <string>
#include <vector>

#include "cli/command.h"
#include "config/config.h"
#include "run/sweep.h"

namespace clusterbench::cli {

struct RunInputs {
  std::vector<std::string> paths;
  std::vector<std::vector<std::string>> settings{config::config_flags().size()};  // by flag
  bool has_all_presets = false, are_as_shipped = false;
  config::GridChange preset_grid;  // in place of what presets have
};

// An option for each flag of config_flags() but those named in `without`.
void add_config_options(Command& command, RunInputs& inputs, const std::vector<std::string>& without = {});

// The flags that were given, in the order of config_flags().
std::vector<config::FlagValue> flag_values(const RunInputs& inputs);

bool is_scene(const std::string& path);  // by its ending or its content (scene/exporters.h)

// `first`: flags that apply before those of the command line. `defaults`: what stands in place of the schema's
// defaults. Throws Error.
config::Config read_inputs(const RunInputs& inputs, const std::vector<config::FlagValue>& first = {},
                           const nlohmann::json& defaults = {});

// A scene's file and those that it names, which a command that reads the scene must not write.
std::vector<std::string> files_of_scene(const std::filesystem::path& scene);
// All that a configuration names, its baseline included.
std::vector<std::string> files_of(const RunInputs& inputs, const config::Config& config);

// For what searches along one camera or some of a scene: which others there are, and which a field of view that is
// asked for does not change.
void tell_of_cameras(const config::Config& config, const run::Plan& plan);

}  // namespace clusterbench::cli
