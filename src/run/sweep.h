#pragma once
// A configuration's product of axes, as cases.

#include <regex>
#include <string>
#include <vector>

#include "run/config.h"
#include "run/result.h"

namespace clusterbench::run {

// One case by its places in the configuration's lists. The camera path is a place in the scene's paths.
struct CasePlan {
  std::string name;  // "scene/camera/grid/assigner/storage" (viewport in the grid's part when there are several)
  std::string id;    // short hash of everything that identifies the case: stable over runs and machines
  std::size_t scene, camera, viewport, grid, assigner, storage;
};

// Cases of one scene, camera, viewport and grid: measured together, in interleaved rounds.
struct GroupPlan {
  std::size_t scene, camera, viewport, grid;
  std::vector<CasePlan> cases;
};

struct SceneData {
  scene::Scene scene;
  std::vector<scene::CameraPath> paths;
};

struct Plan {
  std::vector<SceneData> scenes;  // loaded, ranges resolved
  std::vector<GroupPlan> groups;
  std::vector<Skipped> skipped;  // combinations that cannot be, each with its reason
};

// Loads the scenes and expands. `filter` (ECMAScript regex, "" = all) selects cases by name.
Plan make_plan(const Config& config, const std::string& filter);

}  // namespace clusterbench::run
