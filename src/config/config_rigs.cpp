#include "config/config_rigs.h"

#include "config/config_grids.h"

namespace clusterbench::config {

std::vector<scene::RigSpec> rig_specs(const nlohmann::json& rig) {
  std::vector<scene::RigSpec> specs;
  for (const nlohmann::json& one : expand_all_axes(rig, {"size"})) {
    scene::RigSpec spec;
    spec.lights = one["lights"].get<int>();
    spec.spots = one["spots"].get<double>();
    spec.range_m = one["range"].get<double>();
    spec.size_m = {one["size"][0].get<double>(), one["size"][1].get<double>(), one["size"][2].get<double>()};
    spec.seed = one["seed"].get<std::uint64_t>();
    specs.push_back(spec);
  }
  return specs;
}

}  // namespace clusterbench::config
