#pragma once
// Levels of a camera and some point lights, lit or dark, in view or not, as glTF.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace clusterbench::test {

// Point lights of 3 m along the way that the camera looks (z < 0), or behind it; dark ones have intensity 0.
struct Lamp {
  double z_m = 0.0;
  bool is_lit = true;
};

inline std::string level_of(const std::vector<Lamp>& lamps, bool is_endless = false) {
  nlohmann::json nodes = nlohmann::json::array({nlohmann::json{{"name", "camera"}, {"camera", 0}}});
  nlohmann::json all = nlohmann::json::array({0});
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const double x_m = 0.5 * (static_cast<double>(i % 3) - 1.0);
    nodes.push_back({{"translation", {x_m, 0.0, lamps[i].z_m}},
                     {"extensions", {{"KHR_lights_punctual", {{"light", lamps[i].is_lit ? 0 : 1}}}}}});
    all.push_back(i + 1);
  }
  nlohmann::json gltf{
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", all}}}},
      {"nodes", nodes},
      {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}, {"zfar", 100.0}}}}}}};
  if (is_endless) gltf["cameras"][0]["perspective"].erase("zfar");
  if (!lamps.empty()) {
    gltf["extensionsUsed"] = {"KHR_lights_punctual"};
    for (const double intensity : {10.0, 0.0})
      gltf["extensions"]["KHR_lights_punctual"]["lights"].push_back(
          {{"type", "point"}, {"range", 3.0}, {"intensity", intensity}});
  }
  return gltf.dump();
}

// So many lights in a row, in front of the camera or behind it; the first `dark` of them are switched off.
inline std::vector<Lamp> row_of(int lights, double towards = -1.0, int dark = 0) {
  std::vector<Lamp> lamps;
  for (int i = 0; i < lights; ++i) lamps.push_back({towards * (2.0 + i), i >= dark});
  return lamps;
}

}  // namespace clusterbench::test
