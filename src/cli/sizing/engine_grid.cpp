#include "cli/sizing/engine_grid.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "config/presets/preset_library.h"
#include "core/error.h"
#include "core/text.h"
#include "report/size_report/engine_limits.h"

namespace clusterbench::cli {
namespace {

std::string engine_name(const std::string& engine) {
  const std::string& name = config::find_preset(engine)->engine;
  return name.substr(0, name.find(','));
}

// Throws Error that names the engine's grid settings.
[[noreturn]] void refuse_for_engine(const config::FlagValue& flag, const std::string& engine, const std::string& why) {
  const std::string settable = report::settable_grid_text(*report::row_of_engine(engine));
  throw Error("", flag.shown(),
              why + "; of the grid of " + engine_name(engine) +
                  (settable.empty() ? " nothing can be set" : " can be set: " + settable));
}

bool names_method_or_lists(const config::FlagValue& flag) {
  return flag.name == "--assigner" || config::names_key(std::span(&flag, 1), "(assigners|storages)");
}

bool is_far_of_slices(const std::string& pointer) {
  return pointer == "/slices/far" || pointer == "/slices/far_at_most" || pointer == "/slices/far_default";
}

void check_square_tiles(const config::FlagValue& flag, const std::string& engine, const nlohmann::json& sizes) {
  for (const nlohmann::json& size : sizes)
    if (size.is_array() && size.size() == 2 && size[0] != size[1])
      refuse_for_engine(flag, engine, "its tiles are square, and " + size.dump() + " is not");
}

void check_grid_change(const config::GridChange& change, const std::string& engine) {
  const report::EngineRow& row = *report::row_of_engine(engine);
  for (const auto& [pointer, flag] : change.flags) {
    if (pointer == "/kind" && change.grid["kind"] == config::find_preset(engine)->grid.at("kind").get<std::string>())
      continue;
    if (is_far_of_slices(pointer))
      refuse_for_engine(
          flag, engine,
          "is no setting of it: where its slices follow the camera's far plane, --set 'scenes.*.far=METRES' sets that");
    if (std::ranges::find(row.grid_keys, pointer) == row.grid_keys.end())
      refuse_for_engine(flag, engine, "is no setting of it");
    if (pointer == "/tiles/pixels") check_square_tiles(flag, engine, change.grid["tiles"]["pixels"]);
  }
}

// Removes and returns the flags of the grid: --grid, --tiles, --slices, --scheme and --set of its keys.
std::vector<config::FlagValue> removed_grid_flags(RunInputs& inputs) {
  std::vector<config::FlagValue> removed;
  for (const config::FlagValue& flag : flag_values(inputs))
    if (config::changes_grid(flag)) removed.push_back(flag);
  for (std::size_t i = 0; i < inputs.settings.size(); ++i) {
    const std::string name = config::config_flags()[i].name;
    std::erase_if(inputs.settings[i], [&](const std::string& value) { return config::changes_grid({name, value}); });
  }
  return removed;
}

}  // namespace

bool choose_engine_clustering(const std::string& engine, RunInputs& inputs) {
  for (const config::FlagValue& flag : flag_values(inputs))
    if (names_method_or_lists(flag))
      refuse_for_engine(flag, engine, "names another method or other lists, and --engine sizes those of the engine");
  const config::GridChange change = config::grid_change(removed_grid_flags(inputs));
  check_grid_change(change, engine);
  inputs.preset_grid = change;
  inputs.preset_grid.grid.erase("kind");
  inputs.preset_grid.flags.erase("/kind");
  inputs.has_all_presets = false;
  for (std::size_t i = 0; i < inputs.settings.size(); ++i)
    if (std::string_view(config::config_flags()[i].name) == "--preset") inputs.settings[i] = {engine};
  return !inputs.preset_grid.grid.empty();
}

}  // namespace clusterbench::cli
