#include "run/cases/case_identity.h"

#include <algorithm>
#include <cstddef>

#include "assign/contract/storage.h"
#include "config/grid_json.h"
#include "core/text.h"
#include "run/cases/case_names.h"

namespace clusterbench::run {
namespace {

using Json = nlohmann::json;

// The settings, besides the scene, that a set's samples depend on.
Json identity(const config::SampleSetRequest& request) {
  Json out{measure::name_of(request.set),
           request.count,
           request.divisor,
           request.layers,
           request.froxels.x,
           request.froxels.y,
           request.froxels.z};
  if (request.ground) out.push_back(request.ground->is_lowest ? Json("lowest") : Json(request.ground->height_m));
  return out;
}

Json identity(const config::MethodRequest& method, std::span<const assign::ParamSpec> specs) {
  Json params = Json::object();
  for (const assign::ParamSpec& spec : specs) {
    const assign::ParamValue& value = method.params.values().at(spec.name);
    if (spec.is_late && spec.default_value == value) continue;
    params[spec.name] = std::visit([](const auto& one) { return Json(one); }, assign::first_value(spec, value));
  }
  return {{"name", method.name}, {"params", params}};
}

Json identity(const config::SceneRequest& request, const SceneData& data) {
  // Uses the number of frames that exist, as if exactly that many had been requested.
  const int count = data.requested_frames == 0 ? request.camera.count : data.equal_steps;
  Json out{{"sha256", data.contents_sha256()},
           {"frames", {static_cast<int>(request.camera.choice), count, request.camera.rate_hz}},
           {"range_rule", {request.range_rule.cutoff_lux, request.range_rule.max_range_m}}};
  if (request.camera.fit != scene::CameraFit::contain) out["camera_fit"] = "vertical";
  if (request.camera.field_of_view)
    out["fov"] = {request.camera.field_of_view->angle_rad, request.camera.field_of_view->is_horizontal};
  if (request.camera.far_m) out["far"] = *request.camera.far_m;
  if (request.boxes) out["boxes"] = true;
  if (!request.choice.scene.empty()) out["scene"] = request.choice.scene;
  if (!request.choice.animation.empty()) out["animation"] = request.choice.animation;
  for (const Vec2d& offset : request.camera.jitter_px) out["jitter"].push_back({offset.x, offset.y});
  return out;
}

std::string short_hash(const Json& all) {
  constexpr std::size_t k_digits = 12;
  return sha256_hex(all.dump()).substr(0, k_digits);
}

// Settings that change the counts of a case; timing and threads do not.
Json identity(const config::Config& config, const SceneData& data, const CasePlan& plan) {
  const Vec2i viewport = config.viewports[plan.viewport];
  const config::MethodRequest& assigner = config.assigners[plan.assigner];
  Json storage = k_own_structure;
  if (plan.storage) {
    const config::MethodRequest& kept_in = config.storages[*plan.storage];
    storage = identity(kept_in, assign::find_storage(kept_in.name)->params);
  }
  Json all{{"scene", identity(config.scenes[plan.scene], data)},
           {"camera", {data.paths[plan.camera].camera, plan.camera}},
           {"viewport", {viewport.x, viewport.y}},
           {"grid", config::grid_identity(config.grids[plan.grid])},
           {"assigner", identity(assigner, assign::find_assigner(assigner.name)->params)},
           {"storage", std::move(storage)},
           {"seed", config.seed},
           {"shading_samples", 0}};
  for (const config::SampleSetRequest& request : config.sample_sets) {
    if (request.set == measure::SampleSet::volume)
      all["shading_samples"] = request.count;
    else
      all["samples"].push_back(identity(request));
  }
  if (config.lookup) {
    all["lookup"] = {config.lookup->samples};
    for (const measure::LookupWay& way : config.lookup->ways())
      all["lookup"].push_back({measure::name_of(way.logarithm), measure::name_of(way.depth)});
  }
  if (config.stability) {
    const config::StabilityRequest& stability = *config.stability;
    all["stability"] = {stability.steps, stability.step_mm, stability.step_deg, stability.window};
  }
  for (const config::ShadowCullRequest& cull : config.shadow_culls)
    all["shadow_cull"].push_back({cull.resolution, depth::name_of(cull.texels), cull.near_m, cull.bias_m});
  if (config.shared_frusta) {
    const config::SharedFrustaRequest& frusta = *config.shared_frusta;
    all["shadow_frusta"] = {frusta.apart_m, frusta.turned_deg, frusta.growth};
  }
  const config::PrecisionRequest& precision = config.precisions[plan.precision];
  if (!plan.preset.empty()) all["preset"] = plan.preset;
  if (const cull::PreCullSpec& pre_cull = config.pre_culls[plan.pre_cull]; !pre_cull.is_none())
    all["pre_cull"] = pre_cull.label();
  if (precision.is_lossy()) all["precision"] = {view::packing_name(precision.packing), precision.inflate};
  return all;
}

}  // namespace

CaseIdentity identity_of(const config::Config& config, const SceneData& data, const CasePlan& plan) {
  Json all = identity(config, data, plan);
  CaseIdentity out{short_hash(all), ""};
  all["scene"].erase("sha256");
  out.settings = short_hash(all);
  return out;
}

}  // namespace clusterbench::run
