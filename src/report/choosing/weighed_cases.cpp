#include "report/choosing/weighed_cases.h"

#include <algorithm>
#include <optional>
#include <set>

#include "core/libraries.h"
#include "report/cases/case_samples.h"
#include "report/cases/json_values.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Json;

WeighedCase weigh(const Case& result_case, const Json& config, UnseenSurfaces unseen) {
  WeighedCase out;
  out.result_case = &result_case;
  out.contender = contender_of(result_case);
  if (const std::optional<WholeFrame> frame = whole_frame(result_case, config)) {
    out.cost = frame->cost;
    out.is_modelled = true;
    out.has_random_depths = frame->has_random_depths;
    out.unseen = unseen;
  }
  out.cost.assign_ns = result::number<&Case::timing, &result::Timing::frame_ns, &result::Time::median>(result_case);
  for (double& ns : out.contender.rounds_ns) ns += out.cost.gpu_ns();
  out.contender.costs.time_ns.low += out.cost.gpu_ns();
  out.contender.costs.time_ns.high += out.cost.gpu_ns();
  return out;
}

Json lists_of(const Case& result_case) {
  const result::Buffers& buffers = result_case.buffers;
  return Json::array({result::to_json(buffers.index_entries), result::to_json(buffers.bytes),
                      buffers.each ? result::to_json(*buffers.each) : Json(),
                      result_case.occupancy ? result::to_json(*result_case.occupancy) : Json()});
}

}  // namespace

UnseenSurfaces unseen_surfaces(const result::Result& result, const Json& config) {
  if (value_at(config, "/samples/opaque") == nullptr) return UnseenSurfaces::not_requested;
  const auto lacks_embree = [](const result::Skipped& skipped) {
    return skipped.name.ends_with("/samples opaque") && skipped.reason == built_without(Library::embree);
  };
  return std::ranges::any_of(result.skipped, lacks_embree) ? UnseenSurfaces::no_embree : UnseenSurfaces::no_triangles;
}

std::vector<SceneView> scene_views(const result::Result& result, const Json& config) {
  std::set<std::string> front;
  for (const result::Front& of_scene : result.pareto_front) front.insert(of_scene.ids.begin(), of_scene.ids.end());
  const std::set<std::string> without_samples = ids_without_samples(result.cases);
  const UnseenSurfaces unseen = unseen_surfaces(result, config);
  std::vector<SceneView> views;
  for (const Case& result_case : result.cases) {
    if (result_case.preset) continue;
    const auto is_its = [&](const SceneView& view) {
      return result_case.scene == view.scene && result_case.camera == view.camera &&
             result_case.viewport == view.viewport && result_case.machine == view.machine;
    };
    auto view = std::ranges::find_if(views, is_its);
    if (view == views.end())
      view = views.insert(views.end(),
                          SceneView{result_case.scene, result_case.camera, result_case.viewport, result_case.machine});
    view->cases.push_back(&result_case);
    if (!loses_nothing_seen(result_case)) continue;
    WeighedCase weighed = weigh(result_case, config, unseen);
    weighed.is_on_front = front.contains(result_case.id);
    // Drawn lights have no lists whose size could be an advantage.
    const bool is_on_device = runs_on_device(result_case);  // where no cost decides
    const bool has_no_cost =
        without_samples.contains(result_case.id) || (draws_lights(result_case) && !weighed.is_modelled);
    if (has_no_cost && !is_on_device) {
      ++view->unsampled;
      continue;
    }
    (is_on_device ? view->on_device : samples_search(result_case) ? view->searched : view->sound).push_back(weighed);
  }
  for (SceneView& view : views) std::ranges::stable_sort(view.on_device, {}, &WeighedCase::device_ns);
  for (SceneView& view : views)
    for (std::vector<WeighedCase>* cases : {&view.sound, &view.searched})
      std::ranges::stable_sort(*cases, {}, &WeighedCase::order);
  return views;
}

bool has_lists_of(const WeighedCase& a, const WeighedCase& b) {
  const Case &of_a = *a.result_case, &of_b = *b.result_case;
  const auto label = [](const auto& part) { return part ? part->label : std::string(); };
  return of_a.grid.name == of_b.grid.name && of_a.storage == of_b.storage &&
         label(of_a.precision) == label(of_b.precision) && label(of_a.pre_cull) == label(of_b.pre_cull) &&
         a.bytes() == b.bytes() && a.cost.gpu_ns() == b.cost.gpu_ns() && a.unlit() == b.unlit() &&
         lists_of(of_a) == lists_of(of_b);
}

}  // namespace clusterbench::report
