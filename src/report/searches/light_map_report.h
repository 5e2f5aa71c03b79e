#pragma once
// What `light-map` found, as JSON and as a table.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "measure/light_maps/light_map.h"

namespace clusterbench::report {

struct LightMapScene {
  scene::Scene scene;
  std::string geometry_sha256;
  std::vector<std::string> warnings;
  measure::LightMaps found;
};

// Byte-identical for the same input, but for `seconds`.
nlohmann::ordered_json light_maps_to_json(const std::vector<LightMapScene>& scenes,
                                          const measure::LightMapRequest& request);
std::string light_maps_text(const std::vector<LightMapScene>& scenes, const measure::LightMapRequest& request);

}  // namespace clusterbench::report
