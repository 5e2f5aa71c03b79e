#include "search/replay_config.h"

#include "config/config_plugins.h"
#include "config/grid_json.h"
#include "config/pre_cull_json.h"
#include "core/error.h"

namespace clusterbench::search {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson method_json(const config::MethodRequest& method) {
  OrderedJson out{{"name", method.name}};
  for (const auto& [key, value] : method.params.values())
    std::visit([&, &name_of = key](const auto& number) { out[name_of] = number; }, value);
  return out;
}

}  // namespace

OrderedJson replay_config(const config::Config& config, const run::CasePlan& case_plan, const std::string& scene) {
  const Vec2i viewport = config.viewports[case_plan.viewport];
  const config::PrecisionRequest& precision = config.precisions[case_plan.precision];
  const scene::PathRequest& camera = config.scenes[case_plan.scene].camera;
  const bool fits_height = camera.fit == scene::CameraFit::vertical &&
                           // a horizontal field of view fits the width
                           !(camera.field_of_view && camera.field_of_view->is_horizontal);
  OrderedJson out = config.resolved;
  out["name"] = "worst-case";
  out["scenes"] = OrderedJson::array(
      {OrderedJson{{"path", scene}, {"frames", "keys"}, {"camera_fit", fits_height ? "vertical" : "contain"}}});
  out["viewports"] = OrderedJson::array({OrderedJson::array({viewport.x, viewport.y})});
  for (const char* key : {"presets", "as_shipped"}) out.erase(key);
  config::name_plugins(config, out);
  out["grids"] = OrderedJson::array({config::grid_request(config.grids[case_plan.grid])});
  out["assigners"] = OrderedJson::array({method_json(config.assigners[case_plan.assigner])});
  if (case_plan.storage) out["storages"] = OrderedJson::array({method_json(config.storages[*case_plan.storage])});
  out["precision"] = OrderedJson::array(
      {OrderedJson{{"packing", view::packing_name(precision.packing)}, {"inflate", precision.inflate}}});
  const cull::PreCullSpec& pre_cull = config.pre_culls[case_plan.pre_cull];
  if (out.contains("pre_cull") || !pre_cull.is_none())
    out["pre_cull"] = OrderedJson::array({config::pre_cull_request(pre_cull)});
  out["timing"]["measure"] = false;
  out["stability"] = nullptr;
  return out;
}

const run::CasePlan& replayed_case(const run::Plan& replay, const run::CasePlan& case_plan) {
  for (const run::GroupPlan& group : replay.groups)
    for (const run::CasePlan& other : group.cases)
      if (other.storage.has_value() == case_plan.storage.has_value()) return other;
  throw Error("", "replay", "has no case like " + case_plan.name, ExitCode::internal);
}

}  // namespace clusterbench::search
