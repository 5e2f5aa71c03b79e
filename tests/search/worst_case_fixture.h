#pragma once
// Small scenes and their configurations, in a folder of the test's own.

#include <nlohmann/json.hpp>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "search/worst_case.h"

namespace clusterbench::search::test {

using Json = nlohmann::ordered_json;

class SearchFolder {
 public:
  SearchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "clusterbench-search-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    path_ = pattern;
  }
  ~SearchFolder() { std::filesystem::remove_all(path_); }
  SearchFolder(const SearchFolder&) = delete;
  SearchFolder& operator=(const SearchFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

struct TestLight {
  Vec3d position{0.0};
  double range_m = 1.0;
  bool is_spot = false;
};

inline Json perspective(double far_m) {
  Json projection{{"yfov", 1.0}, {"znear", 0.1}};
  if (far_m > 0.0) projection["zfar"] = far_m;
  return {{"type", "perspective"}, {"perspective", projection}};
}

inline Json orthographic() {
  return {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"znear", 0.1}, {"zfar", 30}}}};
}

// Lights, and a camera at each of the eyes that looks along -z.
inline Json scene_json(const std::vector<TestLight>& lights, const std::vector<Vec3d>& eyes,
                       const Json& camera = perspective(20.0)) {
  Json scene{{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", Json::array({Json{{"nodes", Json::array()}}})}};
  const auto add_node = [&](Json node, const Vec3d& at) {
    node["translation"] = {at.x, at.y, at.z};
    scene["scenes"][0]["nodes"].push_back(scene.contains("nodes") ? scene["nodes"].size() : 0);
    scene["nodes"].push_back(node);
  };
  for (const TestLight& light : lights) {
    Json& definitions = scene["extensions"]["KHR_lights_punctual"]["lights"];
    Json definition{{"type", light.is_spot ? "spot" : "point"}, {"range", light.range_m}};
    if (light.is_spot) definition["spot"] = {{"outerConeAngle", 0.5}};
    definitions.push_back(definition);
    Json node{{"extensions", {{"KHR_lights_punctual", {{"light", definitions.size() - 1}}}}}};
    if (light.is_spot) node["rotation"] = {0.6, 0.0, 0.0, 0.8};
    add_node(node, light.position);
  }
  if (!lights.empty()) scene["extensionsUsed"] = {"KHR_lights_punctual"};
  for (const Vec3d& eye : eyes) add_node({{"camera", 0}}, eye);
  if (!eyes.empty()) scene["cameras"] = Json::array({camera});
  return scene;
}

// One case of the scene, `aabb` or another assigner in a frustum grid or another.
struct Searched {
  config::Config config;
  run::Plan plan;

  const run::CasePlan& case_plan() const { return case_to_search(config, plan); }
  WorstCase search(const WorstCaseRequest& request) const {
    const std::atomic<bool> stop{false};
    return find_worst_case(config, plan, case_plan(), request, {}, stop);
  }
};

inline Json frustum() {
  return {{"kind", "frustum"}, {"tiles", {{"count", {4, 3}}}}, {"slices", {{"scheme", "exponential"}, {"count", 6}}}};
}

inline Searched searched(const SearchFolder& folder, const Json& scene, const Json& grid = frustum(),
                         const std::string& assigner = "aabb", const Json& more = Json::object()) {
  Json document{{"scenes", Json::array({Json{{"path", "scene.gltf"}, {"frames", 5}}})},
                {"viewport", {400, 300}},
                {"grids", Json::array({grid})},
                {"assigners", {assigner}},
                {"timing", {{"measure", false}}}};
  document.update(more);
  folder.write("scene.gltf", scene.dump());
  Searched out{config::load_config(folder.write("config.json", document.dump())), {}};
  out.plan = run::make_plan(out.config, "");
  fix_grid(out.config, out.plan, out.case_plan());
  return out;
}

inline WorstCaseRequest few(int evaluations) {
  WorstCaseRequest request;
  request.evaluations = evaluations;
  request.random = 50;
  return request;
}

}  // namespace clusterbench::search::test
