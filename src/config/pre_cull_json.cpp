#include "config/pre_cull_json.h"

#include "config/config_keys.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

cull::Step step_of(const Json& step) {
  if (step.is_string()) return cull::FrustumStep{};
  if (step.contains("distance_m")) return read_keys<cull::DistanceStep>(step);
  if (step.contains("most")) return read_keys<cull::MostStep>(step["most"]);
  return read_keys<cull::VisibleSetStep>(step["visible_set"]);
}

struct StepRequest {
  OrderedJson operator()(const cull::FrustumStep&) const { return "frustum"; }
  OrderedJson operator()(const cull::DistanceStep& step) const { return result::to_json(step); }
  OrderedJson operator()(const cull::VisibleSetStep& step) const { return {{"visible_set", result::to_json(step)}}; }
  OrderedJson operator()(const cull::MostStep& step) const { return {{"most", result::to_json(step)}}; }
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
