#include <algorithm>
#include <nlohmann/json.hpp>

#include "config/grid_json.h"
#include "core/error.h"
#include "os/output_file.h"
#include "plugin/plugins.h"
#include "scene/writers/write_gltf.h"
#include "stress/stress_run.h"

namespace clusterbench::stress {
namespace {

using OrderedJson = nlohmann::ordered_json;
namespace fs = std::filesystem;

OrderedJson assigner_json(const StressMethod& method) {
  OrderedJson assigner{{"name", method.assigner->name}};
  for (const auto& [key, value] : method.params.values())
    std::visit([&, &name_of = key](const auto& number) { assigner[name_of] = number; }, value);
  return assigner;
}

}  // namespace

void write_replay(const fs::path& folder, const std::string& name, const Loss& loss, const StressMethod& method) {
  write_replay(folder, name, loss.scene, {&method, 1});
}

void write_replay(const fs::path& folder, const std::string& name, const Trial& trial,
                  std::span<const StressMethod> methods) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw Error(folder.string(), "", "cannot be made: " + failure.message());
  OrderedJson assigners = OrderedJson::array();
  for (const StressMethod& method : methods)
    if (supports_trial(method, trial)) assigners.push_back(assigner_json(method));
  OrderedJson plugins = OrderedJson::array();
  for (const StressMethod& method : methods)
    if (const plugin::LoadedPlugin* loaded = plugin::find_plugin(method.assigner->plugin))
      if (const OrderedJson file = loaded->text(); std::ranges::find(plugins, file) == plugins.end())
        plugins.push_back(file);
  OrderedJson scene{{"path", name + ".gltf"}};
  if (has_boxes(trial)) scene["boxes"] = true;
  OrderedJson config{{"name", name},
                     {"scenes", OrderedJson::array({scene})},
                     {"viewport", {trial.viewport.x, trial.viewport.y}},
                     {"grids", OrderedJson::array({config::grid_request(trial.grid)})},
                     {"assigners", assigners},
                     {"timing", {{"measure", false}}}};
  if (!plugins.empty()) config["plugins"] = plugins;
  os::write_file(folder / (name + ".gltf"), scene::to_gltf(trial.scene, "clusterbench stress"));
  os::write_file(folder / (name + ".json"), config.dump(1) + "\n");
}

}  // namespace clusterbench::stress
