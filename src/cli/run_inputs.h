#pragma once
// What a command measures: a configuration or scenes, and the flags that change it. `run` and `size` take the same.

#include <string>
#include <vector>

#include "cli/command.h"
#include "config/config.h"

namespace clusterbench::cli {

struct RunInputs {
  std::vector<std::string> paths;
  std::vector<std::vector<std::string>> settings{config::config_flags().size()};  // by flag
};

// An option for each flag of config_flags().
void add_config_options(Command& command, RunInputs& inputs);

// The flags that were given, in the order of config_flags().
std::vector<config::FlagValue> flag_values(const RunInputs& inputs);

bool is_scene(const std::string& path);  // .glb, .gltf

// `first`: flags that apply before those of the command line. Throws Error.
config::Config read_inputs(const RunInputs& inputs, const std::vector<config::FlagValue>& first = {});

}  // namespace clusterbench::cli
