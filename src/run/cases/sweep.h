#pragma once
// Expands a configuration's product of axes into cases.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assign/contract/assigner_run.h"
#include "config/config.h"
#include "run/cases/frame_depths.h"
#include "run/cases/scene_visible_sets.h"
#include "scene/geometry.h"

namespace clusterbench::run {

// The choices within a group that change the answers: indices in the configuration's lists, and the form of the answer.
struct Method {
  std::size_t assigner = 0, precision = 0;
  assign::Answer answer = assign::Answer::lists;
  std::size_t pre_cull = 0;

  friend bool operator==(const Method&, const Method&) = default;
};

// One case by its indices in the configuration's lists. The camera path is an index in the scene's paths.
struct CasePlan {
  // "scene/camera/grid/assigner/storage" (the grid's part includes the viewport if there are several, and the preset),
  // then the pre-cull if there is one, and the precision if it is not float32.
  std::string name;
  std::string id;  // short hash of the identity of the case: stable over runs and machines
  std::size_t scene, camera, viewport, grid, assigner;
  std::optional<std::size_t> storage;  // none: the assigner's own structure
  std::size_t precision = 0;
  // The same hash without the scene's contents: stable while a level changes.
  std::string settings = {};
  std::string preset = {};  // "" for the configuration's own clusterings
  std::size_t pre_cull = 0;
  // The number of cells of its grid if it is too large for a comparison with the truth (Config::most_pairs): then
  // samples decide. 0: the cells are compared. The same for all cases of a group.
  std::uint64_t cells_not_compared = 0;

  Method method() const {
    return {assigner, precision, storage ? assign::Answer::lists : assign::Answer::structure, pre_cull};
  }
};

// The name in place of a storage's if an assigner has a structure of its own.
inline constexpr const char* k_own_structure = "own";
// Its forms in names of cases.
inline constexpr const char *k_no_lists = "no lists", *k_own_lists = "own lists";
// Display name of an assigner's own structure: "own lists" (of tiles, for example) or "no lists".
const char* own_structure_name(const std::string& assigner);

// Cases of one scene, camera, viewport and grid: measured together, in interleaved rounds.
struct GroupPlan {
  std::size_t scene, camera, viewport, grid;
  std::vector<CasePlan> cases;
};

// Whether the cases' lists are compared with the truth, cell by cell.
bool compares_cells(const config::Config& config, const GroupPlan& group);
// The distinct methods of a group's cases, in order of first use.
std::vector<Method> methods_of(const GroupPlan& group);
// The assigner's label, with the precision's if it is not float32, and the pre-cull's if there is one.
std::string method_label(const config::Config& config, const Method& method);
// The display name of a case's storage.
std::string storage_label(const config::Config& config, const CasePlan& case_plan);
// A case's method, ready to be built.
assign::AssignerRun start_method(const config::Config& config, const Method& method);

struct SceneData {
  scene::Scene scene;
  std::vector<scene::CameraPath> paths;
  std::vector<double> lights_at_points = {};     // run/cases/frame_work.h, of each path; empty if nothing depends on it
  int requested_frames = 0, equal_steps = 0;     // set if the path has fewer equal steps than requested
  std::optional<scene::Geometry> geometry = {};  // read only if something needs triangles
  // Depths of these triangles, for all cameras, viewports and grids; null without triangles. Refers to this plan's
  // scene: a plan is moved, never copied.
  std::shared_ptr<FrameDepths> depths = {};
  std::shared_ptr<SceneVisibleSets> visible_sets = {};  // like depths
  // The lowest height of the lights, and of points 1.7 m below the eyes, over the paths' frames; set if a floor is
  // requested.
  std::optional<double> lowest_m = {};

  bool has_triangles() const { return geometry && !geometry->empty(); }

  // Hash of all contents read from its file.
  std::string contents_sha256() const;
};

// Why a scene cannot have a set of samples; "" if it can.
std::string set_obstacle(const config::SampleSetRequest& request, const SceneData& data);

// The height of the floor on which a scene's opaque samples lie; none if it has triangles or no floor is requested.
std::optional<double> ground_height(const config::SampleSetRequest& request, const SceneData& data);

// Why a scene's lights cast no shadows; "" if they do.
std::string shadow_obstacle(const SceneData& data);

struct Skipped {
  std::string name, reason;
  bool is_other_kind = false;  // the method does not support this kind of grid
  std::string preset = {};     // "" for the configuration's own clusterings
};

struct Plan {
  std::vector<SceneData> scenes;  // loaded, ranges resolved
  std::vector<GroupPlan> groups;
  std::vector<Skipped> skipped;  // impossible combinations, each with its reason

  Plan() = default;
  Plan(Plan&&) = default;
  Plan& operator=(Plan&&) = default;
};

// Loads the scenes and expands the cases. `filter` (a regular expression in RE2 syntax, "" = all) selects cases by
// name.
Plan make_plan(const config::Config& config, const std::string& filter);

}  // namespace clusterbench::run
