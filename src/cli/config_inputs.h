#pragma once
// What a command measures, from its command line: a configuration or scenes, and the flags that change it.

#include <string>
#include <vector>

#include "cli/command.h"
#include "config/config.h"
#include "run/sweep.h"

namespace clusterbench::cli {

struct ConfigInputs {
  std::vector<std::string> inputs;                                                // one configuration, or scenes
  std::vector<std::vector<std::string>> settings{config::config_flags().size()};  // by flag
};

// Adds the flags that change a configuration, but for those that are named in `without`.
void add_config_flags(Command& command, ConfigInputs& inputs, const std::vector<std::string>& without = {});
// What they say, in the order of config::config_flags().
std::vector<config::FlagValue> settings_of(const ConfigInputs& inputs);
// Throws Error for inputs that are neither one configuration nor scenes alone.
config::Config read_config_inputs(const ConfigInputs& inputs);
// For what searches along one camera or some of a scene: which others there are.
void tell_of_cameras_left_out(const config::Config& config, const run::Plan& plan);

}  // namespace clusterbench::cli
