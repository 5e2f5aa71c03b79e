#include "run/case_result.h"

#include <algorithm>
#include <filesystem>

#include "run/cases/impossible_cases.h"
#include "run/findings/gate.h"
#include "run/grid_facts.h"

namespace clusterbench::run {
namespace {

nlohmann::json params_to_json(const assign::Params& params) {
  nlohmann::json out = nlohmann::json::object();
  for (const auto& [name, value] : params.values())
    out[name] = std::visit([](const auto& number) { return nlohmann::json(number); }, value);
  return out;
}

// Adds the samples of the whole view and of the sets that the scene has. A structure cut to the depths of visible
// surfaces makes no promise for other points of the view, so it is not evaluated there.
void add_samples(const config::Config& config, const SceneData& data, const StructureMeasures& structure,
                 CaseResult& out) {
  const bool is_cut_to_surfaces = assign::find_assigner(out.assigner)->at_surfaces;
  for (std::size_t i = 0; i < config.sample_sets.size(); ++i) {
    const SampleSetResult& set = structure.samples[i];
    if (set.set == measure::SampleSet::volume) {
      if (!is_cut_to_surfaces) out.shading = set.counts;
      continue;
    }
    if (!set_obstacle(config.sample_sets[i], data).empty()) continue;
    out.samples.push_back(set);
    out.samples.back().ground_m = ground_height(config.sample_sets[i], data);
  }
}

}  // namespace

Vec3i cells_in(const CaseResult& result, int frame) {
  if (result.reaction && frame >= 0 && static_cast<std::size_t>(frame) < result.reaction->cells.size())
    return result.reaction->cells[static_cast<std::size_t>(frame)];
  const nlohmann::json& cells = result.grid["cells"];
  return {cells[0].get<int>(), cells[1].get<int>(), cells[2].get<int>()};
}

CaseResult case_result(const config::Config& config, const Plan& whole, const CasePlan& plan, int frames,
                       const AccuracyResult& counted, std::size_t index) {
  const scene::Scene& scene = whole.scenes[plan.scene].scene;
  const config::MethodRequest& assigner = config.assigners[plan.assigner];
  const assign::AssignerDescriptor& descriptor = *assign::find_assigner(assigner.name);
  const MethodMeasures& method = *std::find_if(counted.methods.begin(), counted.methods.end(),
                                               [&](const auto& measures) { return measures.method == plan.method(); });
  const StructureMeasures& structure = counted.structures[index];
  CaseResult out;
  out.id = plan.id;
  out.settings = plan.settings;
  out.name = plan.name;
  out.scene = scene.name;
  const scene::CameraPath& path = whole.scenes[plan.scene].paths[plan.camera];
  out.camera = path.camera;
  out.camera_path = {path.shots.front().time_s, path.shots.back().time_s, path.digest};
  out.viewport = config.viewports[plan.viewport];
  out.frames = frames;
  out.grid = grid_facts(config.grids[plan.grid], counted.last_grid, path.shots.front().projection.far_m);
  out.assigner = assigner.name;
  out.assigner_label = assigner.label();
  out.assigner_params = params_to_json(assigner.params);
  const config::PrecisionRequest& precision = config.precisions[plan.precision];
  out.on_device = descriptor.on_device;
  if (descriptor.origin) {
    out.origin_file = std::filesystem::path(descriptor.origin->file).filename().string();
    out.origin_sha256 = descriptor.origin->sha256;
  }
  out.conservative =
      assign::is_conservative(descriptor, assigner.params) && (precision.inflate || !precision.is_lossy());
  if (!counted.losses.empty())
    out.precision = {view::packing_name(precision.packing), precision.label(), precision.inflate,
                     counted.losses[plan.precision]};
  if (method.pre_cull) {
    out.pre_cull = {config.pre_culls[plan.pre_cull].label(), *method.pre_cull};
    out.conservative = out.conservative && method.pre_cull->conservative;
  }
  out.exact = descriptor.exact;
  out.storage_label = storage_label(config, plan);
  out.preset = plan.preset;
  out.buffers = structure.buffers;
  if (structure.roomy)
    out.fallback = FallbackResult{structure.buffers.fallback_frames, structure.buffers.fallback_cells,
                                  structure_side(structure), structure_side(*structure.roomy)};
  out.lights = static_cast<int>(std::ranges::count_if(
      scene.lights, [](const scene::Light& light) { return light.type != scene::LightType::directional; }));
  out.lights_in_view = counted.lights_in_view;
  if (method.has_cells && method.has_grid_cells) out.lights_beyond_grid = counted.lights_beyond_grid;
  out.tests_done = method.tests_done;
  out.fallbacks = method.fallbacks;
  if (method.has_cells) out.occupancy = method.occupancy;
  if (method.has_cells && config.accuracy.check && plan.cells_not_compared == 0) out.error = method.error;
  if (config.accuracy.check) out.cells_not_compared = plan.cells_not_compared;
  if (out.error && out.error->deepest)
    out.deepest_miss_light = scene.lights[static_cast<std::size_t>(out.error->deepest->rig_index)].name;
  add_samples(config, whole.scenes[plan.scene], structure, out);
  if (!out.samples.empty()) out.depth_ranges = counted.depth_ranges;
  out.lookup = structure.lookup;
  out.shadow_culls = method.shadow_culls;
  if (counted.sharing) out.shared_frusta = {*config.shared_frusta, *counted.sharing};
  config::LimitsRequest limits = config.limits;
  if (!plan.preset.empty()) limits.dropped_pairs.reset();  // an engine's limits are meant to drop lights
  out.failures = failures_of(out, limits);
  return out;
}

}  // namespace clusterbench::run
