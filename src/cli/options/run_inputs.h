#pragma once
// The input of a command that measures: a configuration or scenes, and the flags that change them.

#include <filesystem>
#include <string>
#include <vector>

#include "cli/command_line/command.h"
#include "config/config.h"
#include "run/cases/plan.h"
#include "run/findings/run_result.h"

namespace clusterbench::cli {

inline constexpr const char* k_cost_from = "--cost-from";

struct RunInputs {
  std::vector<std::string> paths;
  std::vector<std::vector<std::string>> settings{config::config_flags().size()};  // by flag
  bool has_all_presets = false, are_as_shipped = false;
  std::string cost_from;           // a result with readings, whose prices replace those of the cost model; "" without
  config::GridChange preset_grid;  // replaces keys of the presets' grids
};

// Adds an option for each flag of config_flags() and --cost-from, except those in `without`.
void add_config_options(Command& command, RunInputs& inputs, const std::vector<std::string>& without = {});

// The flags that were given, in the order of config_flags().
std::vector<config::FlagValue> flag_values(const RunInputs& inputs);

// Whether the command may load plug-ins: by --plugin, --set, the path variable, or a configuration's key `plugins`. A
// configuration that comes through a pipe is not looked into.
bool names_plugins(const RunInputs& inputs);
// Whether the path variable names folders of plug-ins.
bool has_plugin_path();

bool is_scene(const std::string& path);  // by its extension or its content (scene/gltf_document/exporters.h)

// `first`: flags that apply before those of the command line. `defaults`: replaces the schema's defaults. Throws Error.
config::Config read_inputs(const RunInputs& inputs, const std::vector<config::FlagValue>& first = {},
                           const nlohmann::json& defaults = {});

// A scene's file and the files that it names; a command that reads the scene must not overwrite them.
std::vector<std::string> files_of_scene(const std::filesystem::path& scene);
// All files that a configuration names, its baseline included.
std::vector<std::string> files_of(const RunInputs& inputs, const config::Config& config);

// For commands that use one camera or some cameras of a scene: prints the other cameras, and those that --fov does not
// change.
void print_other_cameras(const config::Config& config, const run::Plan& plan);

// Prints which cases of the plan a device has ended, once for each reason.
void print_ended_cases(const run::Plan& plan, const run::Result& result);

}  // namespace clusterbench::cli
