#include "config/pre_cull_json.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

cull::Step most_step(const Json& most) {
  cull::MostStep step{most["lights"].get<int>(), cull::MostStep::Keep::first, most["per"] == "type"};
  for (const cull::MostStep::Keep keep : cull::k_keeps)
    if (most["keep"] == cull::name_of(keep)) step.keep = keep;
  return step;
}

cull::Step step_of(const Json& step) {
  if (step.is_string()) return cull::FrustumStep{};
  if (step.contains("distance_m")) return cull::DistanceStep{step["distance_m"].get<double>()};
  if (step.contains("most")) return most_step(step["most"]);
  const Json& set = step["visible_set"];
  return cull::VisibleSetStep{set["view_cell_m"].get<double>(), set["voxel_m"].get<double>(), set["rays"].get<int>()};
}

struct StepRequest {
  OrderedJson operator()(const cull::FrustumStep&) const { return "frustum"; }
  OrderedJson operator()(const cull::DistanceStep& step) const { return {{"distance_m", step.distance_m}}; }
  OrderedJson operator()(const cull::VisibleSetStep& step) const {
    return {{"visible_set", {{"view_cell_m", step.view_cell_m}, {"voxel_m", step.voxel_m}, {"rays", step.rays}}}};
  }
  OrderedJson operator()(const cull::MostStep& step) const {
    return {{"most",
             {{"lights", step.lights}, {"keep", cull::name_of(step.keep)}, {"per", step.per_type ? "type" : "frame"}}}};
  }
};

}  // namespace

cull::PreCullSpec pre_cull_spec(const Json& request) {
  const Json steps = request.is_array() ? request : request == "none" ? Json::array() : Json::array({request});
  cull::PreCullSpec spec;
  for (const Json& step : steps) spec.steps.push_back(step_of(step));
  return spec;
}

OrderedJson pre_cull_request(const cull::PreCullSpec& spec) {
  if (spec.is_none()) return "none";
  OrderedJson steps = OrderedJson::array();
  for (const cull::Step& step : spec.steps) steps.push_back(std::visit(StepRequest{}, step));
  return steps;
}

}  // namespace clusterbench::config
