#include "run/cases/sweep.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "assign/contract/storage.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/pattern.h"
#include "core/text.h"
#include "geom/shapes/domain.h"
#include "run/cases/case_identity.h"
#include "run/cases/case_names.h"
#include "run/cases/frame_work.h"
#include "run/cases/light_reach.h"
#include "scene/domain_check.h"
#include "view/frame.h"

namespace clusterbench::run {
namespace {

using Json = nlohmann::json;

// The name, or the name with the smallest unused suffix "-2", "-3" ...
std::string unique_name(const std::string& name, std::set<std::string>& used) {
  std::string candidate = name;
  for (int number = 2; !used.insert(candidate).second; ++number) candidate = name + "-" + std::to_string(number);
  return candidate;
}

// Replaces slashes, which separate the parts of a case's name, and control characters of a terminal.
std::string name_part(std::string text) {
  for (char& c : text)
    if (c == '/' || std::iscntrl(static_cast<unsigned char>(c)) != 0) c = '_';
  return printable(text);
}

bool follows_surfaces(const grid::GridSpec& grid) {
  return grid.has_tiles() && grid.slices.fit && grid.slices.fit->needs_surfaces();
}

bool needs_triangles(const config::Config& config) {
  return std::ranges::any_of(config.sample_sets, &config::SampleSetRequest::needs_triangles) ||
         !config.shadow_culls.empty() ||
         std::ranges::any_of(
             config.assigners,
             [](const config::MethodRequest& method) { return assign::find_assigner(method.name)->needs.depth; }) ||
         std::ranges::any_of(config.grids, follows_surfaces) ||
         std::ranges::any_of(config.pre_culls, &cull::PreCullSpec::needs_triangles);
}

// Sets the numbers that depend on how many lights reach a point: fewer frames, and grids that are not compared cell by
// cell.
void weigh_frames(const config::Config& config, const config::SceneRequest& request, SceneData& data) {
  if (request.camera.most_lights == 0.0 && !config.accuracy.most_pairs) return;
  for (const scene::CameraPath& path : data.paths)
    data.lights_at_points.push_back(lights_at_a_point(data.scene, path, config.viewports.front(), config.seed));
  if (request.camera.most_lights == 0.0) return;
  scene::PathRequest fewer = request.camera;
  fewer.count = frames_within(fewer.count, fewer.most_lights, data.paths, data.lights_at_points);
  if (fewer.count == request.camera.count) return;
  data.requested_frames = request.camera.count;
  data.equal_steps = fewer.count;
  data.paths = scene::camera_paths(data.scene, fewer);
}

scene::Scene loaded(const config::SceneRequest& request) {
  std::error_code unknown;
  if (!request.named_by.empty() && !std::filesystem::exists(request.path, unknown) && !unknown)
    throw Error(request.named_by, request.named_at, "names '" + request.path.string() + "', and there is no such file");
  return scene::load_gltf(request.path, request.choice);
}

double lowest_height(const SceneData& data) {
  constexpr double k_eye_height_m = 1.7;
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const scene::CameraPath& path : data.paths)
    for (const scene::Shot& shot : path.shots) {
      lowest_m = std::min(lowest_m, shot.pose.eye.y - k_eye_height_m);
      for (const scene::WorldLight& light : scene::world_lights(data.scene, shot.time_s))
        if (light.range_m > 0.0) lowest_m = std::min(lowest_m, light.position.y);
    }
  return lowest_m;
}

// Finds the floor for a set of samples, and adds a note with its height.
void lay_ground(const config::Config& config, SceneData& data) {
  for (const config::SampleSetRequest& request : config.sample_sets) {
    if (!request.ground || data.has_triangles()) continue;
    if (request.ground->is_lowest) data.lowest_m = lowest_height(data);
    char height[32];
    std::snprintf(height, sizeof height, "%.4g", *ground_height(request, data));
    data.scene.warnings.push_back("no triangles: its opaque samples lie on a floor at y = " + std::string(height) +
                                  " m (samples.opaque.ground), and none above the horizon");
  }
}

std::vector<SceneData> load_scenes(const config::Config& config) {
  std::vector<SceneData> scenes;
  std::set<std::string> names;
  for (const config::SceneRequest& request : config.scenes) {
    SceneData data;
    data.scene = request.rig ? scene::make_rig(*request.rig) : loaded(request);
    scene::resolve_ranges(data.scene, request.range_rule);
    if (request.boxes)
      scene::assign_boxes(data.scene);
    else if (!data.scene.boxes.empty())
      data.scene.warnings.push_back("its oriented boxes (" + std::to_string(data.scene.boxes.size()) +
                                    ") are counted and not assigned; --set 'scenes.*.boxes=true' assigns them");
    data.scene.name = unique_name(name_part(data.scene.name), names);
    data.paths = scene::camera_paths(data.scene, request.camera);
    weigh_frames(config, request, data);
    std::set<std::string> cameras;
    for (scene::CameraPath& path : data.paths) {
      scene::check_domain(data.scene, path);
      path.camera = unique_name(name_part(path.camera), cameras);
    }
    if (needs_triangles(config) && !request.rig) {
      data.geometry = scene::load_geometry(data.scene);
      const std::vector<std::string>& warnings = data.geometry->warnings;
      data.scene.warnings.insert(data.scene.warnings.end(), warnings.begin(), warnings.end());
    }
    lay_ground(config, data);
    scenes.push_back(std::move(data));
  }
  for (SceneData& data : scenes)  // their final address
    if (data.geometry && !data.geometry->empty()) {
      data.depths = std::make_shared<FrameDepths>(data.scene, *data.geometry);
      data.visible_sets = std::make_shared<SceneVisibleSets>(data.scene, *data.geometry);
    }
  return scenes;
}

std::string listed(const std::vector<grid::Kind>& kinds) {
  std::vector<std::string> names;
  for (const grid::Kind kind : kinds) names.emplace_back(grid::kind_name(kind));
  return joined(names);
}

bool has_lights(const scene::Scene& scene, scene::LightType type) {
  return std::any_of(scene.lights.begin(), scene.lights.end(), [&](const auto& light) { return light.type == type; });
}

// Why this assigner cannot use this grid in this scene; "" if it can.
std::string obstacle(const config::MethodRequest& request, grid::Kind kind, const SceneData& data, bool orthographic) {
  const scene::Scene& scene = data.scene;
  const assign::AssignerDescriptor& assigner = *assign::find_assigner(request.name);
  const std::string& name = assigner.name;
  if (!assigner.takes(kind)) return name + " takes " + listed(assigner.kinds) + " grids, not " + grid::kind_name(kind);
  if (assigner.needs.depth && (!data.geometry || data.geometry->empty()))
    return name + " needs a depth buffer, and the scene has no triangles";
  if (orthographic && !assigner.orthographic) return name + " does not take orthographic cameras";
  if (!assigner.points && has_lights(scene, scene::LightType::point)) return name + " takes no point lights";
  if (!assigner.spots && has_lights(scene, scene::LightType::spot)) return name + " takes no spot lights";
  if (!assigner.boxes && has_lights(scene, scene::LightType::box)) return name + " takes no boxes";
  const std::string reason = assign::unavailability(assigner, request.params);
  return reason.empty() ? "" : name + " cannot run here: " + reason;
}

// Why it cannot use lights in this precision; "" if it can.
std::string precision_obstacle(const assign::AssignerDescriptor& assigner, const config::PrecisionRequest& precision,
                               const scene::Scene& scene) {
  if (!precision.is_lossy()) return "";
  if (has_lights(scene, scene::LightType::box)) return "boxes have no packed format; run them in float32";
  if (!assigner.exact) return "";
  return assigner.name + " decides from the scene's own numbers, whatever the lights are packed in; run it in float32";
}

// Why a scene's lights cannot be culled this way; "" if they can.
std::string pre_cull_obstacle(const cull::PreCullSpec& pre_cull, const SceneData& data) {
  if (!pre_cull.is_none() && has_lights(data.scene, scene::LightType::box))
    return "pre-culls take points and spots; run boxes without";
  if (!pre_cull.needs_triangles() || (data.geometry && !data.geometry->empty())) return "";
  return "a visible set needs surfaces that hide, and the scene has no triangles";
}

// Numbers of a path's first frame in a grid; or why the grid cannot be made for it.
struct FirstFrame {
  std::uint32_t cells = 0;
  view::LightRanges lights;
  std::string obstacle;
};

FirstFrame first_frame(const grid::GridSpec& spec, const SceneData& data, const scene::CameraPath& path,
                       Vec2i viewport) {
  if (path.shots.empty()) return {0, {}, "the camera path has no frame"};
  if (follows_surfaces(spec) && (!data.geometry || data.geometry->empty()))
    return {0, {}, "slices that follow surfaces need a depth buffer, and the scene has no triangles"};
  if (spec.reaction && spec.reaction->to == grid::Reaction::To::entries &&
      has_lights(data.scene, scene::LightType::box) && !assign::find_assigner(spec.reaction->of)->boxes)
    return {0,
            {},
            "its tiles react to the lists of " + spec.reaction->of +
                ", which takes no boxes; react.of names another method"};
  try {
    const view::Frame frame = view::make_frame(data.scene, path.shots.front(), 0, viewport);
    LightReach reach;
    reach.add(frame);
    const grid::Grid grid =
        grid::make_grid(spec, grid::grid_inputs(spec, frame, reach.far_m(), reach.lo(), reach.hi()));
    return {grid.cell_count(), frame.ranges(), ""};
  } catch (const Error& error) {
    return {0, {}, error.what()};
  }
}

// Why this assigner would take too long; "" if it would not.
std::string limit_obstacle(const assign::AssignerDescriptor& assigner, const config::LimitsRequest& limits,
                           const FirstFrame& first) {
  if (!assigner.all_pairs || !limits.all_pairs) return "";
  const std::uint64_t tests = std::uint64_t{first.lights.size()} * first.cells;
  if (tests <= *limits.all_pairs) return "";
  return assigner.name + " would test " + number_of(first.lights.size(), "light") + " against " +
         number_of(first.cells, "cell") + ", " + number_of(tests, "pair") + "; limits.all_pairs allows " +
         std::to_string(*limits.all_pairs);
}

// Why this storage cannot hold lists of this many cells and lights; "" if it can.
std::string storage_obstacle(const config::MethodRequest& request, const FirstFrame& first) {
  const std::uint64_t most_bytes = memory_limit();
  try {
    const auto one_cell = assign::find_storage(request.name)->make(request.params);
    one_cell->start(1, first.lights);
    // The size of an empty storage grows with the number of cells.
    const std::uint64_t bytes = one_cell->use().upload_bytes * first.cells;
    if (bytes <= most_bytes) return "";
    return request.label() + " would reserve " + std::to_string(bytes >> 20) + " MiB for " +
           std::to_string(first.cells) + " cells and " + std::to_string(first.lights.size()) + " lights; at most " +
           std::to_string(most_bytes >> 20) + " MiB";
  } catch (const Error& error) {
    return error.what();
  }
}

// One assigner in a group: of the configuration's own product, or of a preset.
struct Family {
  std::string group_name;  // prefix of its cases' names
  std::size_t assigner;
  const config::PresetChoice* preset;  // null: own
};

class Expansion {
 public:
  Expansion(const config::Config& config, const std::string& filter) : config_(config), filter_(filter, "--filter") {}

  void expand(Plan& plan) {
    for (std::size_t scene = 0; scene < plan.scenes.size(); ++scene) expand_scene(plan, scene);
    skip_sets(plan);
  }

  std::size_t all_cases() const { return all_cases_; }
  const std::string& example() const { return example_; }
  const std::vector<Skipped>& impossible() const { return impossible_; }  // also those that the filter rejects

 private:
  void expand_scene(Plan& plan, std::size_t scene) {
    for (std::size_t camera = 0; camera < plan.scenes[scene].paths.size(); ++camera)
      for (std::size_t viewport = 0; viewport < config_.viewports.size(); ++viewport)
        for (std::size_t grid = 0; grid < config_.grids.size(); ++grid)
          expand_group(plan, {scene, camera, viewport, grid, {}}, plan.scenes[scene].paths[camera].camera);
  }

  // `preset`: "" for the configuration's own clusterings.
  std::string group_name(const Plan& plan, const GroupPlan& group, const std::string& camera,
                         const std::string& preset) const {
    const Vec2i size = config_.viewports[group.viewport];
    const std::string viewport =
        config_.viewports.size() > 1 ? std::to_string(size.x) + "x" + std::to_string(size.y) + " " : "";
    return plan.scenes[group.scene].scene.name + "/" + camera + "/" + viewport + (preset.empty() ? "" : preset + ": ") +
           name_part(config_.grids[group.grid].name());
  }

  // The presets that have this grid in this viewport.
  std::vector<const config::PresetChoice*> presets_of(const GroupPlan& group) const {
    std::vector<const config::PresetChoice*> choices;
    for (const config::PresetChoice& choice : config_.presets)
      if (choice.viewport == group.viewport && choice.grid == group.grid) choices.push_back(&choice);
    return choices;
  }

  void expand_group(Plan& plan, GroupPlan group, const std::string& camera) {
    std::vector<Family> families;
    for (std::size_t i = 0; group.grid < config_.own_grids && i < config_.assigners.size(); ++i)
      if (i < config_.own_assigners) families.push_back({group_name(plan, group, camera, ""), i, nullptr});
    for (const config::PresetChoice* choice : presets_of(group))
      families.push_back({group_name(plan, group, camera, choice->preset), choice->assigner, choice});
    if (families.empty()) return;
    const SceneData& data = plan.scenes[group.scene];
    const scene::CameraPath& path = data.paths[group.camera];
    const FirstFrame first = first_frame(config_.grids[group.grid], data, path, config_.viewports[group.viewport]);
    std::string skipped_name;
    for (const Family& family : families) {
      if (first.obstacle.empty()) {
        expand_assigner(plan, group, family, first);
      } else if (family.group_name != skipped_name) {
        skipped_name = family.group_name;
        skip(plan, family, skipped_name, first.obstacle);
      }
    }
    if (!group.cases.empty()) plan.groups.push_back(std::move(group));
  }

  void expand_assigner(Plan& plan, GroupPlan& group, const Family& family, const FirstFrame& first) {
    const config::MethodRequest& method = config_.assigners[family.assigner];
    const std::string name = family.group_name + "/" + name_part(method.label());
    const SceneData& data = plan.scenes[group.scene];
    std::string impossible = obstacle(method, config_.grids[group.grid].kind, data,
                                      data.paths[group.camera].shots.front().projection.orthographic);
    if (impossible.empty()) impossible = limit_obstacle(*assign::find_assigner(method.name), config_.limits, first);
    if (!impossible.empty()) {
      const bool takes_kind = assign::find_assigner(method.name)->takes(config_.grids[group.grid].kind);
      skip(plan, family, name, impossible, !takes_kind);
      return;
    }
    for (const std::size_t pre_cull : pre_culls_of(family))
      for (std::size_t precision = 0; precision < config_.precisions.size(); ++precision)
        expand_lights(plan, group, family, {pre_cull, precision}, first, name);
  }

  // The pre-culls of the configuration, or those of a preset instead.
  std::vector<std::size_t> pre_culls_of(const Family& family) const {
    if (family.preset != nullptr && !family.preset->pre_culls.empty()) return family.preset->pre_culls;
    std::vector<std::size_t> own(config_.own_pre_culls);
    std::iota(own.begin(), own.end(), std::size_t{0});
    return own;
  }

  // How a method gets its lights: precision and pre-cull.
  struct LightChoice {
    std::size_t pre_cull, precision;
  };

  void expand_lights(Plan& plan, GroupPlan& group, const Family& family, LightChoice lights, const FirstFrame& first,
                     const std::string& name) {
    const config::PrecisionRequest& request = config_.precisions[lights.precision];
    const cull::PreCullSpec& pre_cull = config_.pre_culls[lights.pre_cull];
    const std::string part =
        (pre_cull.is_none() ? "" : "/" + pre_cull.label()) + (request.is_lossy() ? "/" + request.label() : "");
    const assign::AssignerDescriptor& descriptor = *assign::find_assigner(config_.assigners[family.assigner].name);
    std::string impossible = precision_obstacle(descriptor, request, plan.scenes[group.scene].scene);
    if (impossible.empty()) impossible = pre_cull_obstacle(pre_cull, plan.scenes[group.scene]);
    if (!impossible.empty()) {
      skip(plan, family, name + part, impossible);
      return;
    }
    CasePlan case_plan{
        "", "", group.scene, group.camera, group.viewport, group.grid, family.assigner, {}, lights.precision};
    case_plan.pre_cull = lights.pre_cull;
    case_plan.cells_not_compared = cells_not_compared(plan.scenes[group.scene], group.camera, first.cells);
    if (family.preset != nullptr) case_plan.preset = family.preset->preset;
    for (std::size_t storage = 0; descriptor.answers(assign::Answer::lists) && storage < config_.storages.size();
         ++storage) {
      if (!is_wanted(family, storage)) continue;
      case_plan.storage = storage;
      case_plan.name = name + "/" + name_part(config_.storages[storage].label()) + part;
      const std::string too_much = storage_obstacle(config_.storages[storage], first);
      if (too_much.empty())
        add_case(plan, group, case_plan);
      else
        skip(plan, family, case_plan.name, too_much);
    }
    if (!descriptor.answers(assign::Answer::structure) || !is_wanted(family, std::nullopt)) return;
    case_plan.storage.reset();
    case_plan.name = name + "/" + own_structure_name(descriptor.name) + part;
    if (const std::string earlier = same_without_grid(plan, descriptor, case_plan); !earlier.empty())
      skip(plan, family, case_plan.name,
           descriptor.name + "'s own structure has nothing of the grid: measured once, as " + earlier);
    else
      add_case(plan, group, case_plan);
  }

  // The case on an earlier grid that this one would repeat, "" if there is none: a structure that does not depend on
  // its grid is measured once in a view.
  std::string same_without_grid(const Plan& plan, const assign::AssignerDescriptor& descriptor,
                                const CasePlan& case_plan) {
    if (!descriptor.own_without_grid || !is_selected(filter_, names_of(plan, case_plan))) return "";
    const Json key{case_plan.scene,    case_plan.camera,    case_plan.viewport, case_plan.assigner,
                   case_plan.pre_cull, case_plan.precision, case_plan.preset};
    return without_grid_.try_emplace(key.dump(), case_plan.name).first->second == case_plan.name
               ? ""
               : without_grid_.at(key.dump());
  }

  std::uint64_t cells_not_compared(const SceneData& data, std::size_t camera, std::uint64_t cells) const {
    if (!config_.accuracy.most_pairs) return 0;
    return true_pairs_about(cells, data.lights_at_points[camera]) > *config_.accuracy.most_pairs ? cells : 0;
  }

  bool is_wanted(const Family& family, std::optional<std::size_t> storage) const {
    if (family.preset != nullptr) return family.preset->storage == storage;
    return !storage || *storage < config_.own_storages;
  }

  CaseNames names_of(const Plan& plan, const CasePlan& case_plan) const {
    const Vec2i viewport = config_.viewports[case_plan.viewport];
    const config::PrecisionRequest& precision = config_.precisions[case_plan.precision];
    const cull::PreCullSpec& pre_cull = config_.pre_culls[case_plan.pre_cull];
    return {case_plan.name,
            case_plan.id,
            plan.scenes[case_plan.scene].scene.name,
            plan.scenes[case_plan.scene].paths[case_plan.camera].camera,
            std::to_string(viewport.x) + "x" + std::to_string(viewport.y),
            config_.grids[case_plan.grid].name(),
            (case_plan.preset.empty() ? "" : case_plan.preset + ": ") + config_.assigners[case_plan.assigner].label() +
                (precision.is_lossy() ? " " + precision.label() : "") +
                (pre_cull.is_none() ? "" : " after " + pre_cull.label()),
            storage_label(config_, case_plan)};
  }

  void add_case(const Plan& plan, GroupPlan& group, CasePlan case_plan) {
    case_plan.name = unique_name(case_plan.name, names_);
    const CaseIdentity identity = identity_of(config_, plan.scenes[group.scene], case_plan);
    case_plan.id = unique_name(identity.id, ids_);
    case_plan.settings = identity.settings;
    ++all_cases_;
    if (example_.empty()) example_ = case_plan.name;
    if (is_selected(filter_, names_of(plan, case_plan))) group.cases.push_back(std::move(case_plan));
  }

  // Skips sets of samples that a scene with cases cannot have.
  void skip_sets(Plan& plan) const {
    for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
      if (std::ranges::none_of(plan.groups, [&](const GroupPlan& group) { return group.scene == i; })) continue;
      for (const config::SampleSetRequest& request : config_.sample_sets)
        if (const std::string reason = set_obstacle(request, plan.scenes[i]); !reason.empty())
          plan.skipped.push_back(
              {plan.scenes[i].scene.name + "/samples " + measure::name_of(request.set), reason, false});
      if (const std::string reason = shadow_obstacle(plan.scenes[i]); !config_.shadow_culls.empty() && !reason.empty())
        plan.skipped.push_back({plan.scenes[i].scene.name + "/shadow_cull", reason, false});
    }
  }

  // Cases that the filter rejects are not listed as skipped either.
  void skip(Plan& plan, const Family& family, const std::string& name, const std::string& reason,
            bool is_other_kind = false) {
    const std::string preset = family.preset == nullptr ? "" : family.preset->preset;
    impossible_.push_back({name, reason, is_other_kind, preset});
    if (filter_.is_in(name)) plan.skipped.push_back({name, reason, is_other_kind, preset});
  }

  const config::Config& config_;
  Pattern filter_;
  std::set<std::string> names_, ids_;
  std::map<std::string, std::string> without_grid_;  // settings that its structure depends on -> the case's name
  std::size_t all_cases_ = 0;
  std::string example_;
  std::vector<Skipped> impossible_;
};

}  // namespace

std::string SceneData::contents_sha256() const {
  return geometry ? sha256_hex(scene.sha256 + geometry->sha256) : scene.sha256;
}

std::string set_obstacle(const config::SampleSetRequest& request, const SceneData& data) {
  if (request.needs_triangles() && !data.has_triangles() && !ground_height(request, data))
    return "the scene has no triangles";
  const bool has_bounds = std::ranges::any_of(data.scene.lights, [](const scene::Light& light) {
    return light.type != scene::LightType::directional && std::isfinite(geom::range_in_domain(light.range_m));
  });
  if (!request.needs_bounds() || has_bounds) return "";
  return data.scene.lights.empty() ? "the scene has no lights" : "no light of the scene has an end";
}

std::optional<double> ground_height(const config::SampleSetRequest& request, const SceneData& data) {
  if (!request.ground || data.has_triangles()) return {};
  return request.ground->is_lowest ? data.lowest_m : request.ground->height_m;
}

std::string shadow_obstacle(const SceneData& data) {
  if (has_lights(data.scene, scene::LightType::box)) return "shadow maps are of points and spots; run boxes without";
  return !data.geometry || data.geometry->empty() ? "the scene has no triangles" : "";
}

bool compares_cells(const config::Config& config, const GroupPlan& group) {
  return config.accuracy.check &&
         std::ranges::all_of(group.cases, [](const CasePlan& case_plan) { return case_plan.cells_not_compared == 0; });
}

std::vector<Method> methods_of(const GroupPlan& group) {
  std::vector<Method> list;
  for (const CasePlan& case_plan : group.cases)
    if (std::find(list.begin(), list.end(), case_plan.method()) == list.end()) list.push_back(case_plan.method());
  return list;
}

const char* own_structure_name(const std::string& assigner) {
  const assign::AssignerDescriptor* known = assign::find_assigner(assigner);
  return known != nullptr && known->own_lists ? k_own_lists : k_no_lists;
}

std::string method_label(const config::Config& config, const Method& method) {
  const config::PrecisionRequest& precision = config.precisions[method.precision];
  const config::MethodRequest& assigner = config.assigners[method.assigner];
  const cull::PreCullSpec& pre_cull = config.pre_culls[method.pre_cull];
  const bool is_one_of_two = method.answer == assign::Answer::structure &&
                             assign::find_assigner(assigner.name)->answers(assign::Answer::lists);
  return assigner.label() + (is_one_of_two ? std::string(" (") + own_structure_name(assigner.name) + ")" : "") +
         (precision.is_lossy() ? " " + precision.label() : "") +
         (pre_cull.is_none() ? "" : " after " + pre_cull.label());
}

std::string storage_label(const config::Config& config, const CasePlan& case_plan) {
  return case_plan.storage ? config.storages[*case_plan.storage].label() : k_own_structure;
}

assign::AssignerRun start_method(const config::Config& config, const Method& method) {
  const config::MethodRequest& request = config.assigners[method.assigner];
  return {*assign::find_assigner(request.name), request.params, method.answer};
}

namespace {

// If nothing matches, the user may have meant a case that is impossible.
std::string impossible_text(const std::vector<Skipped>& skipped, const std::string& filter) {
  if (skipped.empty()) return "";
  const Pattern whole(filter, "--filter");
  std::optional<Pattern> grid;
  try {
    grid.emplace(filter.substr(0, filter.find('/')), "--filter");
  } catch (const Error&) {  // half of a pattern may be invalid
  }
  auto meant = std::ranges::find_if(skipped, [&](const Skipped& one) { return whole.is_in(one.name); });
  if (meant == skipped.end() && grid)
    meant = std::ranges::find_if(skipped, [&](const Skipped& one) { return grid->is_in(one.name); });
  if (meant == skipped.end()) meant = skipped.begin();
  return "; " + number_of(skipped.size(), "combination") + " cannot be measured, among them " + meant->name + ": " +
         meant->reason;
}

}  // namespace

Plan make_plan(const config::Config& config, const std::string& filter) {
  set_memory_limit(config.limits.memory_mib << 20);
  Expansion expansion(config, filter);
  Plan plan;
  plan.scenes = load_scenes(config);
  expansion.expand(plan);
  if (!plan.groups.empty()) return plan;
  if (expansion.all_cases() > 0)
    throw Error("", "--filter",
                "'" + filter + "' matches none of " + number_of(expansion.all_cases(), "case") + pattern_hint(filter) +
                    "; one of them is '" + expansion.example() + "'" + impossible_text(expansion.impossible(), filter));
  throw Error(config.file.string(), "",
              "no case is left: " + number_of(plan.skipped.size(), "combination") + " cannot be measured" +
                  (plan.skipped.empty() ? "" : "; the first, " + plan.skipped[0].name + ": " + plan.skipped[0].reason));
}

}  // namespace clusterbench::run
