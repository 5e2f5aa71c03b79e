#include "search/replay_config.h"

#include "config/grid_json.h"
#include "core/error.h"

namespace clusterbench::search {
namespace {

using Json = nlohmann::ordered_json;

Json method_json(const config::MethodRequest& method) {
  Json out{{"name", method.name}};
  for (const auto& [key, value] : method.params.values())
    std::visit([&, &name_of = key](const auto& number) { out[name_of] = number; }, value);
  return out;
}

}  // namespace

Json replay_config(const config::Config& config, const run::CasePlan& case_plan, const std::string& scene) {
  const Vec2i viewport = config.viewports[case_plan.viewport];
  const config::PrecisionRequest& precision = config.precisions[case_plan.precision];
  const bool fits_height = config.scenes[case_plan.scene].camera.fit == scene::CameraFit::vertical;
  Json out = config.resolved;
  out["name"] = "worst-case";
  out["scenes"] =
      Json::array({Json{{"path", scene}, {"frames", "keys"}, {"camera_fit", fits_height ? "vertical" : "contain"}}});
  out["viewports"] = Json::array({Json::array({viewport.x, viewport.y})});
  out["grids"] = Json::array({config::grid_request(config.grids[case_plan.grid])});
  out["assigners"] = Json::array({method_json(config.assigners[case_plan.assigner])});
  if (case_plan.storage) out["storages"] = Json::array({method_json(config.storages[*case_plan.storage])});
  out["precision"] =
      Json::array({Json{{"packing", view::packing_name(precision.packing)}, {"inflate", precision.inflate}}});
  out["timing"]["measure"] = false;
  out["stability"] = nullptr;
  return out;
}

const run::CasePlan& replayed_case(const run::Plan& replay, const run::CasePlan& case_plan) {
  for (const run::GroupPlan& group : replay.groups)
    for (const run::CasePlan& one : group.cases)
      if (one.storage.has_value() == case_plan.storage.has_value()) return one;
  throw Error("", "replay", "has no case like " + case_plan.name, ExitCode::internal);
}

}  // namespace clusterbench::search
