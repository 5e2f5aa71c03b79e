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

// JSON texts by key.
using Members = std::map<std::string, std::string>;

std::string object_text(const Members& members) {
  std::string text = "{";
  for (const auto& [key, value] : members) text += (text.size() > 1 ? ",\"" : "\"") + key + "\":" + value;
  return text + "}";
}

std::string short_hash(const Members& all) {
  constexpr std::size_t k_digits = 12;
  return sha256_hex(object_text(all)).substr(0, k_digits);
}

// Settings that change the counts of all cases; timing and threads do not.
Json common_identity(const config::Config& config) {
  Json all{{"seed", config.seed}, {"shading_samples", 0}};
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
  return all;
}

// The text at `key`, made if it is missing.
template <class Texts, class Key, class Make>
const auto& text_at(Texts& texts, const Key& key, const Make& make) {
  const auto known = texts.find(key);
  return known != texts.end() ? known->second : texts.emplace(key, make()).first->second;
}

}  // namespace

CaseIdentities::CaseIdentities(const config::Config& config) : config_(config) {
  const Json common = common_identity(config);
  for (const auto& [key, value] : common.items()) common_[key] = value.dump();
}

const CaseIdentities::SceneTexts& CaseIdentities::scene(const SceneData& data, std::size_t index) {
  return text_at(scenes_, index, [&] {
    Json all = identity(config_.scenes[index], data);
    SceneTexts texts{all.dump(), ""};
    all.erase("sha256");
    texts.without = all.dump();
    return texts;
  });
}

const std::string& CaseIdentities::grid(std::size_t index) {
  return text_at(grids_, index, [&] { return config::grid_identity(config_.grids[index]).dump(); });
}

const std::string& CaseIdentities::assigner(std::size_t index) {
  return text_at(assigners_, index, [&] {
    const config::MethodRequest& method = config_.assigners[index];
    return identity(method, assign::find_assigner(method.name)->params).dump();
  });
}

const std::string& CaseIdentities::storage(std::optional<std::size_t> index) {
  return text_at(storages_, index, [&] {
    if (!index) return Json(k_own_structure).dump();
    const config::MethodRequest& kept_in = config_.storages[*index];
    return identity(kept_in, assign::find_storage(kept_in.name)->params).dump();
  });
}

CaseIdentity CaseIdentities::of(const SceneData& data, const CasePlan& plan) {
  const Vec2i viewport = config_.viewports[plan.viewport];
  const SceneTexts& scene_texts = scene(data, plan.scene);
  Members all = common_;
  all["scene"] = scene_texts.with_contents;
  all["camera"] = Json{data.paths[plan.camera].camera, plan.camera}.dump();
  all["viewport"] = Json{viewport.x, viewport.y}.dump();
  all["grid"] = grid(plan.grid);
  all["assigner"] = assigner(plan.assigner);
  all["storage"] = storage(plan.storage);
  if (!plan.preset.empty()) all["preset"] = Json(plan.preset).dump();
  if (const cull::PreCullSpec& pre_cull = config_.pre_culls[plan.pre_cull]; !pre_cull.is_none())
    all["pre_cull"] = Json(pre_cull.label()).dump();
  if (const config::PrecisionRequest& precision = config_.precisions[plan.precision]; precision.is_lossy())
    all["precision"] = Json{view::packing_name(precision.packing), precision.inflate}.dump();
  CaseIdentity out{short_hash(all), ""};
  all["scene"] = scene_texts.without;
  out.settings = short_hash(all);
  return out;
}

}  // namespace clusterbench::run
