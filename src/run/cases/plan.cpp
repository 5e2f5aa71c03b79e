#include "run/cases/plan.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/memory.h"
#include "core/pattern.h"
#include "core/text.h"
#include "gpu/device/device.h"
#include "run/cases/case_identity.h"
#include "run/cases/case_names.h"
#include "run/cases/frame_work.h"
#include "run/cases/impossible_cases.h"

namespace clusterbench::run {
namespace {

using Json = nlohmann::json;

std::string viewport_name(Vec2i viewport) {
  return std::to_string(viewport.x) + "x" + std::to_string(viewport.y);
}

// One assigner in a group, of the configuration's own product or of a preset.
struct Branch {
  CasePlan known;                      // what all of its cases have; the name is the beginning of theirs
  const config::PresetChoice* preset;  // null: own
};

// Goes through the axes: scene, camera, viewport and grid are a group; then assigner, pre-cull, precision and storage.
class Expansion {
 public:
  // Adds to `plan`, whose scenes are loaded. Both must outlive this object.
  Expansion(const config::Config& config, const std::string& filter, Plan& plan)
      : config_(config), filter_(filter, "--filter"), plan_(plan), identities_(config) {}

  void expand() {
    for (std::size_t scene = 0; scene < plan_.scenes.size(); ++scene)
      for (std::size_t camera = 0; camera < plan_.scenes[scene].paths.size(); ++camera)
        for (std::size_t viewport = 0; viewport < config_.viewports.size(); ++viewport) {
          std::optional<FirstView> view;
          for (std::size_t grid = 0; grid < config_.grids.size(); ++grid)
            expand_group({scene, camera, viewport, grid, {}}, view);
        }
    for (std::size_t scene = 0; scene < plan_.scenes.size(); ++scene)
      if (std::ranges::find(plan_.groups, scene, &GroupPlan::scene) != plan_.groups.end())
        skip_sets(plan_.scenes[scene]);
  }

  std::size_t all_cases() const { return all_cases_; }
  const std::string& example() const { return example_; }
  const std::vector<Skipped>& impossible() const { return impossible_; }  // also those that the filter rejects

 private:
  // --- Groups ---

  // `view`: none until a group of its scene, camera and viewport has cases.
  void expand_group(GroupPlan group, std::optional<FirstView>& view) {
    std::vector<Branch> branches = branches_of(group);
    if (branches.empty()) return;
    const SceneData& data = plan_.scenes[group.scene];
    if (!view) view.emplace(data, data.paths[group.camera], config_.viewports[group.viewport]);
    const FirstFrame first = view->in(config_.grids[group.grid]);
    group.cells = first.cells;
    std::string skipped_name;
    for (Branch& branch : branches) {
      if (first.obstacle.empty()) {
        branch.known.cells_not_compared = cells_not_compared(data, group.camera, first.cells);
        expand_assigner(group, branch, first);
      } else if (branch.known.name != skipped_name) {
        skipped_name = branch.known.name;
        skip(branch.known, first.obstacle);
      }
    }
    if (!group.cases.empty()) plan_.groups.push_back(std::move(group));
  }

  // The configuration's own assigners, then those of presets that have this grid in this viewport.
  std::vector<Branch> branches_of(const GroupPlan& group) const {
    std::vector<Branch> branches;
    const auto add = [&](std::size_t assigner, const config::PresetChoice* choice) {
      CasePlan known{"", "", group.scene, group.camera, group.viewport, group.grid, assigner, {}};
      if (choice != nullptr) known.preset = choice->preset;
      known.name = group_name(known);
      branches.push_back({known, choice});
    };
    if (group.grid < config_.own_grids)
      for (std::size_t i = 0; i < std::min(config_.own_assigners, config_.assigners.size()); ++i) add(i, nullptr);
    for (const config::PresetChoice& choice : config_.presets)
      if (choice.viewport == group.viewport && choice.grid == group.grid) add(choice.assigner, &choice);
    return branches;
  }

  std::string group_name(const CasePlan& known) const {
    const SceneData& data = plan_.scenes[known.scene];
    const std::string viewport =
        config_.viewports.size() > 1 ? viewport_name(config_.viewports[known.viewport]) + " " : "";
    return data.scene.name + "/" + data.paths[known.camera].camera + "/" + viewport + preset_prefix(known) +
           name_part(config_.grids[known.grid].name());
  }

  static std::string preset_prefix(const CasePlan& known) { return known.preset.empty() ? "" : known.preset + ": "; }

  std::uint64_t cells_not_compared(const SceneData& data, std::size_t camera, std::uint64_t cells) const {
    if (!config_.accuracy.most_pairs) return 0;
    return true_pairs_about(cells, data.lights_at_points[camera]) > *config_.accuracy.most_pairs ? cells : 0;
  }

  // --- Cases of a group ---

  void expand_assigner(GroupPlan& group, Branch branch, const FirstFrame& first) {
    const config::MethodRequest& method = config_.assigners[branch.known.assigner];
    const assign::AssignerDescriptor& assigner = *assign::find_assigner(method.name);
    const SceneData& data = plan_.scenes[group.scene];
    const grid::Kind kind = config_.grids[group.grid].kind;
    branch.known.name += "/" + name_part(method.label());
    std::string impossible =
        method_obstacle(method, kind, data, data.paths[group.camera].shots.front().projection.orthographic);
    if (impossible.empty()) impossible = limit_obstacle(assigner, config_.limits, first);
    if (impossible.empty()) impossible = fit_obstacle(assigner, first);
    if (!impossible.empty()) {
      skip(branch.known, impossible, !assigner.takes(kind));
      return;
    }
    for (const std::size_t pre_cull : pre_culls_of(branch))
      for (std::size_t precision = 0; precision < config_.precisions.size(); ++precision) {
        branch.known.pre_cull = pre_cull;
        branch.known.precision = precision;
        expand_lights(group, branch, first);
      }
  }

  // The pre-culls of the configuration, or those of a preset instead.
  std::vector<std::size_t> pre_culls_of(const Branch& branch) const {
    if (branch.preset != nullptr && !branch.preset->pre_culls.empty()) return branch.preset->pre_culls;
    std::vector<std::size_t> own(config_.own_pre_culls);
    std::iota(own.begin(), own.end(), std::size_t{0});
    return own;
  }

  void expand_lights(GroupPlan& group, const Branch& branch, const FirstFrame& first) {
    const SceneData& data = plan_.scenes[group.scene];
    const assign::AssignerDescriptor& assigner = descriptor_of(branch.known);
    std::string impossible = precision_obstacle(assigner, config_.precisions[branch.known.precision], data);
    if (impossible.empty()) impossible = pre_cull_obstacle(config_.pre_culls[branch.known.pre_cull], data);
    if (!impossible.empty()) {
      CasePlan unstored = branch.known;
      unstored.name += lights_part(unstored);
      skip(unstored, impossible);
      return;
    }
    if (assigner.answers(assign::Answer::lists))
      for (std::size_t storage = 0; storage < config_.storages.size(); ++storage)
        if (is_wanted(branch, storage))
          add_unless(storage_obstacle(config_.storages[storage], first), group, stored(branch.known, storage));
    if (assigner.answers(assign::Answer::structure) && is_wanted(branch, std::nullopt)) {
      const CasePlan own = stored(branch.known, std::nullopt);
      add_unless(repetition_of(own), group, own);
    }
  }

  bool is_wanted(const Branch& branch, std::optional<std::size_t> storage) const {
    if (branch.preset != nullptr) return branch.preset->storage == storage;
    return !storage || *storage < config_.own_storages;
  }

  CasePlan stored(CasePlan case_plan, std::optional<std::size_t> storage) const {
    case_plan.storage = storage;
    case_plan.name += "/" +
                      (storage ? name_part(config_.storages[*storage].label())
                               : own_structure_name(config_.assigners[case_plan.assigner].name)) +
                      lights_part(case_plan);
    return case_plan;
  }

  // The parts of a name that follow the storage.
  std::string lights_part(const CasePlan& known) const {
    const config::PrecisionRequest& precision = config_.precisions[known.precision];
    const cull::PreCullSpec& pre_cull = config_.pre_culls[known.pre_cull];
    return (pre_cull.is_none() ? "" : "/" + pre_cull.label()) + (precision.is_lossy() ? "/" + precision.label() : "");
  }

  // Why the case would repeat one on an earlier grid: a structure that does not depend on its grid is measured once in
  // a view. "" if it does not.
  std::string repetition_of(const CasePlan& case_plan) {
    const assign::AssignerDescriptor& assigner = descriptor_of(case_plan);
    if (!assigner.own_without_grid || !is_selected(filter_, names_of(case_plan))) return "";
    const Json key{case_plan.scene,    case_plan.camera,    case_plan.viewport, case_plan.assigner,
                   case_plan.pre_cull, case_plan.precision, case_plan.preset};
    const std::string& earlier = without_grid_.try_emplace(key.dump(), case_plan.name).first->second;
    if (earlier == case_plan.name) return "";
    return assigner.name + "'s own structure has nothing of the grid: measured once, as " + earlier;
  }

  const assign::AssignerDescriptor& descriptor_of(const CasePlan& known) const {
    return *assign::find_assigner(config_.assigners[known.assigner].name);
  }

  CaseNames names_of(const CasePlan& case_plan) const {
    const SceneData& data = plan_.scenes[case_plan.scene];
    return {case_plan.name,
            case_plan.id,
            data.scene.name,
            data.paths[case_plan.camera].camera,
            viewport_name(config_.viewports[case_plan.viewport]),
            config_.grids[case_plan.grid].name(),
            preset_prefix(case_plan) + config_.assigners[case_plan.assigner].label() +
                lights_label(config_, case_plan.method()),
            storage_label(config_, case_plan)};
  }

  // --- Adding and skipping ---

  void add_unless(const std::string& obstacle, GroupPlan& group, const CasePlan& case_plan) {
    if (obstacle.empty())
      add_case(group, case_plan);
    else
      skip(case_plan, obstacle);
  }

  void add_case(GroupPlan& group, CasePlan case_plan) {
    case_plan.name = names_.add(case_plan.name);
    const CaseIdentity identity = identities_.of(plan_.scenes[group.scene], case_plan);
    case_plan.id = ids_.add(identity.id);
    case_plan.settings = identity.settings;
    ++all_cases_;
    check_count();
    if (example_.empty()) example_ = case_plan.name;
    if (is_selected(filter_, names_of(case_plan))) group.cases.push_back(std::move(case_plan));
  }

  // Cases that the filter rejects are not listed as skipped either. `known`: with the name of the skipped cases.
  void skip(const CasePlan& known, const std::string& reason, bool is_other_kind = false) {
    impossible_.push_back({known.name, reason, is_other_kind, known.preset});
    check_count();
    if (filter_.is_in(known.name)) plan_.skipped.push_back(impossible_.back());
  }

  void check_count() const {
    if (all_cases_ + impossible_.size() > k_most_cases)
      throw Error(config_.file.string(), "",
                  "scenes x cameras x viewports x grids x methods make more than " + std::to_string(k_most_cases) +
                      " cases; shorten a list, or write several configurations");
  }

  // Skips sets of samples and shadows that a scene cannot have.
  void skip_sets(const SceneData& data) {
    const auto skip_if = [&](const std::string& reason, const std::string& name) {
      if (!reason.empty()) plan_.skipped.push_back({data.scene.name + "/" + name, reason});
    };
    for (const config::SampleSetRequest& request : config_.sample_sets)
      skip_if(set_obstacle(request, data), std::string("samples ") + measure::name_of(request.set));
    if (!config_.shadow_culls.empty()) skip_if(shadow_obstacle(data), "shadow_cull");
  }

  const config::Config& config_;
  Pattern filter_;
  Plan& plan_;
  CaseIdentities identities_;
  UniqueNames names_, ids_;
  std::map<std::string, std::string> without_grid_;  // settings that its structure depends on -> the case's name
  std::size_t all_cases_ = 0;
  std::string example_;
  std::vector<Skipped> impossible_;
};

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

// A device that somebody named and that is not there is an error; without a name, cases that need one are skipped.
void use_device(const config::Config& config) {
  gpu::use_device(config.device);
  if (!config.device.empty() && !gpu::device_obstacle().empty())
    throw Error(config.file.string(), "device", gpu::device_obstacle());
}

}  // namespace

std::size_t Plan::case_count() const {
  std::size_t count = 0;
  for (const GroupPlan& group : groups) count += group.cases.size();
  return count;
}

Plan make_plan(const config::Config& config, const std::string& filter, SceneFiles* files) {
  set_memory_limit(config.limits.memory_mib << 20);
  use_device(config);
  Plan plan;
  Expansion expansion(config, filter, plan);
  plan.scenes = load_scenes(config, files);
  expansion.expand();
  if (!plan.groups.empty()) return plan;
  if (expansion.all_cases() > 0)
    throw Error("", "--filter",
                no_match_text(filter, expansion.all_cases(), expansion.example()) +
                    impossible_text(expansion.impossible(), filter));
  throw Error(config.file.string(), "",
              "no case is left: " + number_of(plan.skipped.size(), "combination") + " cannot be measured" +
                  (plan.skipped.empty() ? "" : "; the first, " + plan.skipped[0].name + ": " + plan.skipped[0].reason));
}

}  // namespace clusterbench::run
