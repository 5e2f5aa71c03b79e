#include "run/cases/impossible_cases.h"

#include <algorithm>
#include <cmath>

#include "assign/contract/storage.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "geom/shapes/domain.h"
#include "grid/lights_in_view.h"

namespace clusterbench::run {
namespace {

std::string kind_names(const std::vector<grid::Kind>& kinds) {
  std::vector<std::string> names;
  for (const grid::Kind kind : kinds) names.emplace_back(grid::kind_name(kind));
  return joined(names);
}

// Of a grid that needs something that the scene does not have.
std::string grid_obstacle(const grid::GridSpec& spec, const SceneData& data) {
  const std::string unseen = data.surface_obstacle();
  if (follows_surfaces(spec) && !unseen.empty())
    return "slices that follow surfaces need a depth buffer, and " + unseen;
  if (spec.reaction && spec.reaction->to == grid::Reaction::To::entries && data.has_lights(scene::LightType::box) &&
      !assign::find_assigner(spec.reaction->of)->boxes)
    return "its tiles react to the lists of " + spec.reaction->of +
           ", which takes no boxes; react.of names another method";
  return "";
}

}  // namespace

FirstView::FirstView(const SceneData& data, const scene::CameraPath& path, Vec2i viewport) : data_(data) {
  if (path.shots.empty()) {
    obstacle_ = "the camera path has no frame";
    return;
  }
  try {
    frame_ = view::make_frame(data.scene, path.shots.front(), 0, viewport);
    reach_.add(*frame_, grid::lights_in_view(*frame_));
  } catch (const Error& error) {
    obstacle_ = error.what();
  }
}

FirstFrame FirstView::in(const grid::GridSpec& spec) const {
  if (const std::string reason = grid_obstacle(spec, data_); !reason.empty()) return {0, {}, {}, reason};
  if (!frame_) return {0, {}, {}, obstacle_};
  try {
    grid::Grid grid = grid::make_grid(spec, grid::grid_inputs(spec, *frame_, reach_.far_m(), reach_.lo(), reach_.hi()));
    const std::uint32_t cells = grid.cell_count();
    return {cells, frame_->ranges(), std::move(grid), ""};
  } catch (const Error& error) {
    return {0, {}, {}, error.what()};
  }
}

std::string method_obstacle(const config::MethodRequest& request, grid::Kind kind, const SceneData& data,
                            bool orthographic) {
  const assign::AssignerDescriptor& assigner = *assign::find_assigner(request.name);
  const std::string& name = assigner.name;
  if (!assigner.takes(kind))
    return name + " takes " + kind_names(assigner.kinds) + " grids, not " + grid::kind_name(kind);
  const std::string unseen = data.surface_obstacle();
  if (assigner.needs.depth && !unseen.empty()) return name + " needs a depth buffer, and " + unseen;
  if (orthographic && !assigner.orthographic) return name + " does not take orthographic cameras";
  if (!assigner.points && data.has_lights(scene::LightType::point)) return name + " takes no point lights";
  if (!assigner.spots && data.has_lights(scene::LightType::spot)) return name + " takes no spot lights";
  if (!assigner.boxes && data.has_lights(scene::LightType::box)) return name + " takes no boxes";
  const std::string reason = assign::unavailability(assigner, request.params);
  return reason.empty() ? "" : name + " cannot run here: " + reason;
}

std::string fit_obstacle(const assign::AssignerDescriptor& assigner, const FirstFrame& first) {
  return assigner.unfit ? assigner.unfit(*first.grid) : "";
}

std::string limit_obstacle(const assign::AssignerDescriptor& assigner, const config::LimitsRequest& limits,
                           const FirstFrame& first) {
  if (!assigner.all_pairs || !limits.all_pairs) return "";
  const std::uint64_t tests = std::uint64_t{first.lights.size()} * first.cells;
  if (tests <= *limits.all_pairs) return "";
  return assigner.name + " would test " + number_of(first.lights.size(), "light") + " against " +
         number_of(first.cells, "cell") + ", " + number_of(tests, "pair") + "; limits.all_pairs allows " +
         std::to_string(*limits.all_pairs);
}

std::string precision_obstacle(const assign::AssignerDescriptor& assigner, const config::PrecisionRequest& precision,
                               const SceneData& data) {
  if (!precision.is_lossy()) return "";
  if (data.has_lights(scene::LightType::box)) return "boxes have no packed format; run them in float32";
  if (!assigner.exact) return "";
  return assigner.name + " decides from the scene's own numbers, whatever the lights are packed in; run it in float32";
}

std::string pre_cull_obstacle(const cull::PreCullSpec& pre_cull, const SceneData& data) {
  if (!pre_cull.is_none() && data.has_lights(scene::LightType::box))
    return "pre-culls take points and spots; run boxes without";
  const std::string unseen = data.surface_obstacle();
  if (!pre_cull.needs_triangles() || unseen.empty()) return "";
  return "a visible set needs surfaces that hide, and " + unseen;
}

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

std::string set_obstacle(const config::SampleSetRequest& request, const SceneData& data) {
  if (request.needs_triangles() && !ground_height(request, data))
    if (std::string unseen = data.surface_obstacle(); !unseen.empty()) return unseen;
  const bool has_bounds = std::ranges::any_of(data.scene.lights, [](const scene::Light& light) {
    return light.type != scene::LightType::directional && std::isfinite(geom::range_in_domain(light.range_m));
  });
  if (!request.needs_bounds() || has_bounds) return "";
  return data.scene.lights.empty() ? "the scene has no lights" : "no light of the scene has an end";
}

std::string shadow_obstacle(const SceneData& data) {
  if (data.has_lights(scene::LightType::box)) return "shadow maps are of points and spots; run boxes without";
  return data.surface_obstacle();
}

}  // namespace clusterbench::run
