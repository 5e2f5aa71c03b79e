#include "cli/run_inputs.h"

#include <algorithm>
#include <filesystem>

#include "cli/output.h"
#include "core/error.h"
#include "core/text.h"
#include "run/scene_facts.h"
#include "scene/exporters.h"

namespace clusterbench::cli {

void add_config_options(Command& command, RunInputs& inputs, const std::vector<std::string>& without) {
  for (std::size_t i = 0; i < inputs.settings.size(); ++i) {
    const config::ConfigFlag& flag = config::config_flags()[i];
    if (std::ranges::find(without, flag.name) != without.end()) continue;
    command.add_option(flag.name, inputs.settings[i], flag.summary).once_a_name();
    if (std::string_view(flag.name) != "--preset") continue;
    command.add_flag("--presets", inputs.has_all_presets, "All presets: --preset '*'");
    command.add_flag(
        "--as-shipped", inputs.are_as_shipped,
        "Presets with the mistakes of the engines whose code was run, which lose lights; else their schemes "
        "without these");
  }
}

std::vector<config::FlagValue> flag_values(const RunInputs& inputs) {
  std::vector<config::FlagValue> all;
  for (std::size_t i = 0; i < inputs.settings.size(); ++i) {
    const config::ConfigFlag& flag = config::config_flags()[i];
    const std::vector<std::string>& values = inputs.settings[i];
    if (inputs.has_all_presets && std::string_view(flag.name) == "--preset") {
      all.push_back({flag.name, "*"});
      continue;
    }
    if (!flag.is_repeatable && !values.empty()) all.push_back({flag.name, joined(values, ",")});
    for (const std::string& value : flag.is_repeatable ? values : std::vector<std::string>{})
      all.push_back({flag.name, value});
  }
  if (inputs.are_as_shipped) all.push_back({"--set", "as_shipped=true"});
  return all;
}

bool is_scene(const std::string& path) {
  return scene::is_scene_file(path);
}

config::Config read_inputs(const RunInputs& inputs, const std::vector<config::FlagValue>& first,
                           const nlohmann::json& standard) {
  std::vector<config::FlagValue> flags = first;
  const std::vector<config::FlagValue> given = flag_values(inputs);
  flags.insert(flags.end(), given.begin(), given.end());
  const auto scenes = static_cast<std::size_t>(std::count_if(inputs.paths.begin(), inputs.paths.end(), is_scene));
  if (scenes == inputs.paths.size())
    return config::default_config({inputs.paths.begin(), inputs.paths.end()}, flags, standard);
  if (scenes == 0 && inputs.paths.size() == 1) return config::load_config(inputs.paths.front(), flags, standard);
  throw Error("", "command line",
              "takes one configuration (.json), or one or more scenes (.glb, .gltf), not " + joined(inputs.paths));
}

void tell_of_cameras(const config::Config& config, const run::Plan& plan) {
  for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
    const scene::Scene& scene = plan.scenes[i].scene;
    for (const std::string& text :
         {run::without_field_of_view(plan.scenes[i], config.scenes[i]), run::fewer_frames(plan.scenes[i])})
      if (!text.empty()) tell("warning: " + scene.name + ": " + text);
    const std::vector<std::string> others = scene::cameras_left_out(scene, config.scenes[i].camera);
    if (others.empty()) continue;
    tell("of " + scene.name + " only camera '" + plan.scenes[i].paths.front().camera + "', and not " +
         number_of(others.size(), "other") + "; --set 'scenes.*.camera=*' takes all");
  }
}

}  // namespace clusterbench::cli
