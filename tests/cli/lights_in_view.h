#pragma once
// A scene of one camera and points, as glTF.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::test {

// So many points around the view's axis, a pixel apart or so, and others behind the camera; all reach each other.
inline std::string lights_in_view_and_behind(int in_view, int behind) {
  nlohmann::json lights = nlohmann::json::array(), nodes = nlohmann::json::array();
  for (int i = 0; i < in_view + behind; ++i) {
    lights.push_back({{"type", "point"}, {"intensity", 100.0}, {"range", 0.5}});
    nodes.push_back({{"translation", {0.0, 0.001 * i, i < in_view ? -10.0 : 10.0}},
                     {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  nodes.push_back({{"name", "eye"}, {"camera", 0}});
  nlohmann::json scene{
      {"asset", {{"version", "2.0"}}},
      {"extensionsUsed", {"KHR_lights_punctual"}},
      {"extensions", {{"KHR_lights_punctual", {{"lights", lights}}}}},
      {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}, {"zfar", 100.0}}}}}},
      {"nodes", nodes},
      {"scene", 0},
      {"scenes", nlohmann::json::array({{{"nodes", nlohmann::json::array()}}})}};
  for (std::size_t i = 0; i < nodes.size(); ++i) scene["scenes"][0]["nodes"].push_back(i);
  return scene.dump();
}

}  // namespace clusterbench::test
