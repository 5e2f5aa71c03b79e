#include <fstream>
#include <nlohmann/json.hpp>

#include "config/config_grids.h"
#include "core/error.h"
#include "scene/write_gltf.h"
#include "stress/stress.h"

namespace clusterbench::stress {
namespace {

using OrderedJson = nlohmann::ordered_json;
namespace fs = std::filesystem;

OrderedJson slices_json(const grid::Slicing& slices) {
  OrderedJson out{{"scheme", config::scheme_name(slices.scheme)}};
  if (slices.scheme == grid::Scheme::list) {
    out["boundaries"] = slices.boundaries_m;
    return out;
  }
  out["count"] = slices.count;
  if (slices.near_m != 0.0) out["near"] = slices.near_m;
  if (slices.scheme == grid::Scheme::exponential_first) out["first"] = slices.first_m;
  if (slices.scheme == grid::Scheme::power) out["lambda"] = slices.lambda;
  if (slices.far_m != 0.0) out["far"] = slices.far_m;
  return out;
}

OrderedJson grid_json(const grid::GridSpec& spec) {
  OrderedJson out{{"kind", grid::kind_name(spec.kind)}};
  if (spec.kind == grid::Kind::frustum || spec.kind == grid::Kind::distance) {
    const bool by_pixels = spec.tiles.count.x == 0;
    const Vec2i tiles = by_pixels ? spec.tiles.pixels : spec.tiles.count;
    out["tiles"][by_pixels ? "pixels" : "count"] = {tiles.x, tiles.y};
    out["slices"] = slices_json(spec.slices);
    return out;
  }
  out["cells"] = {spec.cells.x, spec.cells.y, spec.cells.z};
  if (spec.kind == grid::Kind::cascades) {
    out["levels"] = spec.levels;
    out["finest"] = spec.finest_m;
  }
  if (spec.has_bounds)
    out["bounds"] = {{"min", {spec.bounds_lo_m.x, spec.bounds_lo_m.y, spec.bounds_lo_m.z}},
                     {"max", {spec.bounds_hi_m.x, spec.bounds_hi_m.y, spec.bounds_hi_m.z}}};
  return out;
}

OrderedJson assigner_json(const StressMethod& method) {
  OrderedJson assigner{{"name", method.assigner->name}};
  for (const auto& [key, value] : method.params.values())
    std::visit([&, &name_of = key](const auto& held) { assigner[name_of] = held; }, value);
  return assigner;
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text << std::flush;
  if (!file) throw Error(path.string(), "", "cannot be written");
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
    if (takes_trial(method, trial)) assigners.push_back(assigner_json(method));
  const OrderedJson config{{"name", name},
                           {"scenes", OrderedJson::array({OrderedJson{{"path", name + ".gltf"}}})},
                           {"viewport", {trial.viewport.x, trial.viewport.y}},
                           {"grids", OrderedJson::array({grid_json(trial.grid)})},
                           {"assigners", assigners},
                           {"timing", {{"measure", false}}}};
  write(folder / (name + ".gltf"), scene::to_gltf(trial.scene, "clusterbench stress"));
  write(folder / (name + ".json"), config.dump(1) + "\n");
}

}  // namespace clusterbench::stress
