#pragma once

#include <string>

namespace clusterbench::test {

// Three cameras that stand still: one in a row of lights, one before it, one that looks away.
inline std::string three_cameras(const std::string& lights = R"({"type": "point", "range": 6})") {
  std::string nodes, roots;
  const char* cameras[][2] = {{"inside", "[0, 0, -20]"}, {"before", "[0, 0, 10]"}, {"away", "[0, 0, -500]"}};
  for (int i = 0; i < 40; ++i)
    nodes += R"({"translation": [)" + std::to_string(i % 5 - 2) + ", 0, " + std::to_string(-i) +
             R"(], "extensions": {"KHR_lights_punctual": {"light": 0}}},)";
  for (const auto& [name, at] : cameras)
    nodes += std::string(R"({"camera": 0, "name": ")") + name + R"(", "translation": )" + at + "},";
  for (int i = 0; i < 43; ++i) roots += (i == 0 ? "" : ",") + std::to_string(i);
  nodes.pop_back();
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [)" + roots + R"(]}], "nodes": [)" + nodes +
         R"(], "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 100}}],
         "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": [)" +
         lights + "]}}}";
}

}  // namespace clusterbench::test
