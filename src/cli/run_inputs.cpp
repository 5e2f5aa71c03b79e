#include "cli/run_inputs.h"

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/text.h"

namespace clusterbench::cli {

void add_config_options(Command& command, RunInputs& inputs) {
  for (std::size_t i = 0; i < inputs.settings.size(); ++i)
    command.add_option(config::config_flags()[i].name, inputs.settings[i], config::config_flags()[i].summary)
        .once_a_name();
}

std::vector<config::FlagValue> flag_values(const RunInputs& inputs) {
  std::vector<config::FlagValue> all;
  for (std::size_t i = 0; i < inputs.settings.size(); ++i) {
    const config::ConfigFlag& flag = config::config_flags()[i];
    const std::vector<std::string>& values = inputs.settings[i];
    if (!flag.is_repeatable && !values.empty()) all.push_back({flag.name, joined(values, ",")});
    for (const std::string& value : flag.is_repeatable ? values : std::vector<std::string>{})
      all.push_back({flag.name, value});
  }
  return all;
}

bool is_scene(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".glb" || extension == ".gltf";
}

config::Config read_inputs(const RunInputs& inputs, const std::vector<config::FlagValue>& first) {
  std::vector<config::FlagValue> flags = first;
  const std::vector<config::FlagValue> given = flag_values(inputs);
  flags.insert(flags.end(), given.begin(), given.end());
  const auto scenes = static_cast<std::size_t>(std::count_if(inputs.paths.begin(), inputs.paths.end(), is_scene));
  if (scenes == inputs.paths.size()) return config::default_config({inputs.paths.begin(), inputs.paths.end()}, flags);
  if (scenes == 0 && inputs.paths.size() == 1) return config::load_config(inputs.paths.front(), flags);
  throw Error("", "command line",
              "takes one configuration (.json), or one or more scenes (.glb, .gltf), not " + joined(inputs.paths));
}

}  // namespace clusterbench::cli
