#pragma once
// A plan without files: lights at given places and a camera that walks past them.

#include <cmath>
#include <string>
#include <vector>

#include "run/runner.h"

namespace clusterbench::run::testing {

// Lights at fixed places before a camera that walks towards them along -z, a metre a frame.
struct Walk {
  config::Config config;
  Plan plan;

  explicit Walk(const std::string& settings, int frames = 3) {
    config = config::parse_config(R"({"scenes": ["walk.glb"], "viewport": [100, 100], )" + settings + "}", "c.json");
    config.timing.measure = false;
    SceneData data;
    data.scene.name = "walk";
    scene::CameraPath path;
    path.camera = "eye";
    for (int i = 0; i < frames; ++i) {
      scene::Shot shot;
      shot.pose.eye = {0.0, 0.0, -static_cast<double>(i)};
      shot.projection.yfov_rad = M_PI / 2;
      shot.projection.near_m = 0.5;
      shot.projection.far_m = 64.0;
      path.shots.push_back(shot);
    }
    data.paths.push_back(path);
    plan.scenes.push_back(std::move(data));
    for (std::size_t grid = 0; grid < config.grids.size(); ++grid) add_group(grid);
  }

  scene::Light& add_light(const Vec3d& place, double range_m) {
    scene::Scene& scene = plan.scenes[0].scene;
    scene::Node node;
    node.translation = place;
    scene.nodes.push_back(node);
    scene::Light light;
    light.name = "lamp " + std::to_string(scene.lights.size());
    light.node = static_cast<int>(scene.nodes.size()) - 1;
    light.range_m = range_m;
    scene.lights.push_back(light);
    return scene.lights.back();
  }

  Result run(const Listener& listener = {}, const std::vector<std::string>& done = {}) const {
    const std::atomic<bool> stop{false};
    return run_plan(config, plan, done, listener, stop);
  }

 private:
  void add_group(std::size_t grid) {
    GroupPlan group{0, 0, 0, grid, {}};
    for (std::size_t assigner = 0; assigner < config.assigners.size(); ++assigner)
      for (std::size_t precision = 0; precision < config.precisions.size(); ++precision)
        for (std::size_t storage = 0; storage < config.storages.size(); ++storage) {
          std::string id = std::to_string(grid) + "-" + std::to_string(assigner) + "-" + std::to_string(storage);
          if (config.precisions.size() > 1) id += "-" + config.precisions[precision].label();
          group.cases.push_back({"walk/eye/grid/" + id, id, 0, 0, 0, grid, assigner, storage, precision});
        }
    plan.groups.push_back(group);
  }
};

// One tile, six slices.
inline constexpr const char* k_shafts = R"("grids": [{"kind": "frustum", "tiles": {"count": [1, 1]},
    "slices": {"scheme": "list", "boundaries": [0.5, 2, 4, 8, 16, 32, 64]}}])";

}  // namespace clusterbench::run::testing
