#include "config/config_rigs.h"

#include "config/config_grids.h"

namespace clusterbench::config {

std::vector<scene::RigSpec> rig_specs(const nlohmann::json& rig) {
  std::vector<scene::RigSpec> specs;
  for (const nlohmann::json& sized : expand_all_axes(rig, {"size"})) {
    scene::RigSpec spec;
    spec.lights = sized["lights"].get<int>();
    spec.spots = sized["spots"].get<double>();
    spec.range_m = sized["range"].get<double>();
    spec.size_m = {sized["size"][0].get<double>(), sized["size"][1].get<double>(), sized["size"][2].get<double>()};
    spec.seed = sized["seed"].get<std::uint64_t>();
    specs.push_back(spec);
  }
  return specs;
}

}  // namespace clusterbench::config
