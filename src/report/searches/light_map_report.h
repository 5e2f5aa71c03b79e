#pragma once
// The findings of `light-map`, as a document and as a table.

#include <string>
#include <vector>

#include "measure/light_maps/light_map.h"
#include "result/documents/light_map.h"

namespace clusterbench::report {

struct LightMapScene {
  scene::Scene scene;
  std::string geometry_sha256;
  std::vector<std::string> warnings;
  measure::LightMaps found;
};

// Equal for the same input, except for `seconds`.
result::LightMaps light_maps_document(const std::vector<LightMapScene>& scenes,
                                      const measure::LightMapRequest& request);
std::string light_maps_text(const std::vector<LightMapScene>& scenes, const measure::LightMapRequest& request);

}  // namespace clusterbench::report
