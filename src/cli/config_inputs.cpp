#include "cli/config_inputs.h"

#include <algorithm>
#include <filesystem>

#include "cli/output.h"
#include "core/error.h"
#include "core/text.h"

namespace clusterbench::cli {
namespace {

bool names_scene(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".glb" || extension == ".gltf";
}

}  // namespace

void add_config_flags(Command& command, ConfigInputs& inputs, const std::vector<std::string>& without) {
  for (std::size_t i = 0; i < inputs.settings.size(); ++i) {
    const config::ConfigFlag& flag = config::config_flags()[i];
    if (std::ranges::find(without, flag.name) != without.end()) continue;
    command.add_option(flag.name, inputs.settings[i], flag.summary).once_a_name();
  }
}

std::vector<config::FlagValue> settings_of(const ConfigInputs& inputs) {
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

config::Config read_config_inputs(const ConfigInputs& inputs) {
  const auto scenes = static_cast<std::size_t>(std::ranges::count_if(inputs.inputs, names_scene));
  if (scenes == inputs.inputs.size())
    return config::default_config({inputs.inputs.begin(), inputs.inputs.end()}, settings_of(inputs));
  if (scenes == 0 && inputs.inputs.size() == 1) return config::load_config(inputs.inputs.front(), settings_of(inputs));
  throw Error("", "command line",
              "takes one configuration (.json), or one or more scenes (.glb, .gltf), not " + joined(inputs.inputs));
}

void tell_of_cameras_left_out(const config::Config& config, const run::Plan& plan) {
  for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
    const scene::Scene& scene = plan.scenes[i].scene;
    const std::vector<std::string> others = scene::cameras_left_out(scene, config.scenes[i].camera);
    if (others.empty()) continue;
    tell("of " + scene.name + " only camera '" + plan.scenes[i].paths.front().camera + "', and not " +
         number_of(others.size(), "other") + "; --set 'scenes.*.camera=*' takes all");
  }
}

}  // namespace clusterbench::cli
