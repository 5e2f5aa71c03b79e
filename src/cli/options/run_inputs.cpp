#include "cli/options/run_inputs.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <span>

#include "cli/output/output.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/text.h"
#include "gpu/user_shaders/shader_file.h"
#include "plugin/plugins.h"
#include "report/documents/result_file.h"
#include "report/results/measured_prices.h"
#include "run/scene_facts.h"
#include "scene/gltf_document/exporters.h"
#include "scene/gltf_document/gltf_files.h"

namespace clusterbench::cli {

void add_config_options(Command& command, RunInputs& inputs, const std::vector<std::string>& without) {
  for (std::size_t i = 0; i < inputs.settings.size(); ++i) {
    const config::ConfigFlag& flag = config::config_flags()[i];
    if (std::ranges::find(without, flag.name) != without.end()) continue;
    command.add_option(flag.name, inputs.settings[i], flag.summary).once_a_name();
    if (std::string_view(flag.name) != "--preset") continue;
    command.add_flag("--presets", inputs.has_all_presets, "All presets: --preset '*'");
    command.add_flag("--as-shipped", inputs.are_as_shipped,
                     "Presets with the known bugs of Filament, Bevy, three.js and Babylon.js, which lose lights");
  }
  if (std::ranges::find(without, k_cost_from) != without.end()) return;
  command.add_option(
      k_cost_from, inputs.cost_from,
      "RESULT of a run with `reading` on a GPU: its prices of a light, a read and a byte for the key cost");
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

namespace {

bool is_of_plugins(const config::FlagValue& flag) {
  return flag.name == "--plugin" || (flag.name == "--set" && flag.value.starts_with("plugins"));
}

bool has_plugins(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none) || is_stream_name(path) || is_scene(path)) return false;
  const auto config = json_or_discarded<nlohmann::json>(file_text(path), JsonComments::allowed);
  return config.is_object() && config.contains("plugins") && !config["plugins"].empty();
}

}  // namespace

bool has_plugin_path() {
  const char* folders = std::getenv(plugin::k_path_variable);
  return folders != nullptr && *folders != '\0';
}

bool names_plugins(const RunInputs& inputs) {
  return std::ranges::any_of(flag_values(inputs), is_of_plugins) || has_plugin_path() ||
         std::ranges::any_of(inputs.paths, has_plugins);
}

bool is_scene(const std::string& path) {
  return scene::is_scene_file(path);
}

namespace {

// The prices that a result's readings tell, as flags, and a note that says them.
std::vector<config::FlagValue> measured_prices(const std::string& path) {
  if (path.empty()) return {};
  const report::MeasuredPrices prices = report::measured_prices(report::read_result(path), path);
  print_message(prices.text());
  const auto set = [](const char* key, double value) {
    char text[64];
    std::snprintf(text, sizeof text, "cost.%s=%.6g", key, value);
    return config::FlagValue{"--set", text};
  };
  return {set("ns_per_light", prices.ns_per_light), set("ns_per_read", prices.ns_per_read),
          set("read_gb_per_s", prices.read_gb_per_s)};
}

}  // namespace

config::Config read_inputs(const RunInputs& inputs, const std::vector<config::FlagValue>& first,
                           const nlohmann::json& defaults) {
  std::vector<config::FlagValue> flags = first;
  std::ranges::move(measured_prices(inputs.cost_from), std::back_inserter(flags));
  const std::vector<config::FlagValue> given = flag_values(inputs);
  flags.insert(flags.end(), given.begin(), given.end());
  const auto scenes = static_cast<std::size_t>(std::count_if(inputs.paths.begin(), inputs.paths.end(), is_scene));
  if (scenes == inputs.paths.size())
    return config::default_config({inputs.paths.begin(), inputs.paths.end()}, flags, defaults, inputs.preset_grid);
  if (scenes == 0 && inputs.paths.size() == 1)
    return config::load_config(inputs.paths.front(), flags, defaults, inputs.preset_grid);
  throw Error("", "command line",
              "takes one configuration (.json), or one or more scenes (.glb, .gltf), not " + joined(inputs.paths));
}

std::vector<std::string> files_of_scene(const std::filesystem::path& scene) {
  std::vector<std::string> files{scene.string()};
  for (const std::filesystem::path& file : scene::files_named_in(scene)) files.push_back(file.string());
  return files;
}

std::vector<std::string> files_of(const RunInputs& inputs, const config::Config& config) {
  std::vector<std::string> files = inputs.paths;
  for (const config::SceneRequest& scene : config.scenes)
    if (!scene.path.empty()) std::ranges::move(files_of_scene(scene.path), std::back_inserter(files));
  for (const config::MethodRequest& method : config.assigners)
    if (const auto& origin = assign::find_assigner(method.name)->origin)
      std::ranges::move(gpu::files_of_shader(origin->file), std::back_inserter(files));
  files.push_back(config.limits.baseline.string());
  return files;
}

void print_other_cameras(const config::Config& config, const run::Plan& plan) {
  for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
    const scene::Scene& scene = plan.scenes[i].scene;
    for (const std::string& text : {run::without_field_of_view(plan.scenes[i], config.scenes[i]),
                                    run::fewer_frames(plan.scenes[i]), run::dark_lights(plan.scenes[i])})
      if (!text.empty()) print_message("warning: " + scene.name + ": " + text);
    const std::vector<std::string> others = scene::cameras_left_out(scene, config.scenes[i].camera);
    if (others.empty()) continue;
    print_message("of " + scene.name + " only camera '" + plan.scenes[i].paths.front().camera + "', and not " +
                  number_of(others.size(), "other") + "; --set 'scenes.*.camera=*' takes all");
  }
}

void print_ended_cases(const run::Plan& plan, const run::Result& result) {
  // Those of the plan come first.
  const std::span ended(result.skipped.begin() + static_cast<std::ptrdiff_t>(plan.skipped.size()),
                        result.skipped.end());
  std::vector<std::string> told;
  for (const run::Skipped& one : ended) {
    if (std::ranges::find(told, one.reason) != told.end()) continue;
    told.push_back(one.reason);
    const auto others = std::ranges::count(ended, one.reason, &run::Skipped::reason) - 1;
    print_message("warning: " + one.name +
                  (others > 0 ? " and " + number_of(static_cast<std::uint64_t>(others), "more case") : std::string()) +
                  (others > 0 ? " were" : " was") + " not measured to the end: " + one.reason);
  }
}

}  // namespace clusterbench::cli
