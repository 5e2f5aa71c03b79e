#pragma once
// A configuration's product of axes, as cases.

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

// What answers depend on within a group: indices in the configuration's lists, and the form of the answer.
struct Method {
  std::size_t assigner = 0, precision = 0;
  assign::Answer answer = assign::Answer::lists;
  std::size_t pre_cull = 0;

  friend bool operator==(const Method&, const Method&) = default;
};

// One case by its indices in the configuration's lists. The camera path is an index in the scene's paths.
struct CasePlan {
  // "scene/camera/grid/assigner/storage" (viewport in the grid's part when there are several, and the preset), then the
  // pre-cull where there is one, and the precision where it is not float32.
  std::string name;
  std::string id;  // short hash of everything that identifies the case: stable over runs and machines
  std::size_t scene, camera, viewport, grid, assigner;
  std::optional<std::size_t> storage;  // none: the assigner's own structure
  std::size_t precision = 0;
  // A hash as id is, but for the scene's contents: stable while a level changes.
  std::string settings = {};
  std::string preset = {};  // that the case is of; "" for the configuration's own clusterings
  std::size_t pre_cull = 0;
  // Cells of its grid, which are too many to be compared with the truth (Config::most_pairs): samples decide. 0: they
  // are compared. The same for all cases of a group.
  std::uint64_t cells_not_compared = 0;

  Method method() const {
    return {assigner, precision, storage ? assign::Answer::lists : assign::Answer::structure, pre_cull};
  }
};

// What stands for a storage's name where an assigner leaves its own structure.
inline constexpr const char* k_own_structure = "own";
// In its place in names of cases.
inline constexpr const char *k_no_lists = "no lists", *k_own_lists = "own lists";
// Of an assigner's own structure, for people: "own lists", as of tiles, or "no lists".
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
// The assigner's label, the precision's where it is not float32, and the pre-cull's where there is one.
std::string method_label(const config::Config& config, const Method& method);
// A case's storage as it is shown.
std::string storage_label(const config::Config& config, const CasePlan& case_plan);
// A case's method, ready to be built.
assign::AssignerRun start_method(const config::Config& config, const Method& method);

struct SceneData {
  scene::Scene scene;
  std::vector<scene::CameraPath> paths;
  std::vector<double> lights_at_points = {};  // run/cases/frame_work.h, of each path; empty where nothing depends on it
  int frames_asked = 0, equal_steps = 0;      // where its paths have fewer equal steps than asked for: these two
  std::optional<scene::Geometry> geometry = {};  // read only where something needs triangles
  // Of these triangles, for all cameras, viewports and grids; null without. Refers to this plan's scene: a plan is
  // moved, never copied.
  std::shared_ptr<FrameDepths> depths = {};
  std::shared_ptr<SceneVisibleSets> visible_sets = {};  // likewise
  // The lowest of the lights, and of what is 1.7 m below an eye, over the paths' frames; where a ground asks for it.
  std::optional<double> lowest_m = {};

  bool has_triangles() const { return geometry && !geometry->empty(); }

  // Of all that was read of its file.
  std::string contents_sha256() const;
};

// Why a scene cannot have a set of samples; "" if it can.
std::string set_obstacle(const config::SampleSetRequest& request, const SceneData& data);

// The height of the floor on which a scene's opaque samples lie; none where it has triangles or no floor is asked for.
std::optional<double> ground_height(const config::SampleSetRequest& request, const SceneData& data);

// Why a scene's lights cast no shadows; "" if they do.
std::string shadow_obstacle(const SceneData& data);

struct Skipped {
  std::string name, reason;
  bool is_other_kind = false;  // a method on a kind of grid that it does not take
  std::string preset = {};     // that it is of; "" for the configuration's own clusterings
};

struct Plan {
  std::vector<SceneData> scenes;  // loaded, ranges resolved
  std::vector<GroupPlan> groups;
  std::vector<Skipped> skipped;  // combinations that cannot be, each with its reason

  Plan() = default;
  Plan(Plan&&) = default;
  Plan& operator=(Plan&&) = default;
};

// Loads the scenes and expands. `filter` (a regular expression as RE2 has them, "" = all) selects cases by name.
Plan make_plan(const config::Config& config, const std::string& filter);

}  // namespace clusterbench::run
