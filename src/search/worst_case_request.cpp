#include "search/worst_case_request.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "geom/shapes/domain.h"

namespace clusterbench::search {

void check_request(const run::SceneData& data, const WorstCaseRequest& request) {
  if (request.keep_height && (request.walkable || request.within))
    throw Error("", "--keep-height",
                "says how high the camera stands, as --walkable and --within do; give one of them");
  if (std::ranges::any_of(data.scene.lights,
                          [](const scene::Light& light) { return light.type == scene::LightType::box; }))
    throw Error(
        data.scene.path.string(), "",
        "is measured with its boxes (\"boxes\": true), which worst-case cannot move or write; leave the key out");
  const bool has_lights = std::ranges::any_of(
      data.scene.lights, [](const scene::Light& light) { return light.type != scene::LightType::directional; });
  if (!has_lights && request.extra_ranges_m.empty())
    throw Error(data.scene.path.string(), "", "has no point or spot light, and none is added (--add-lights)");
  if (!request.within) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = request.within->lo[axis], hi = request.within->hi[axis];
    if (!(lo <= hi)) throw Error("", "--within", "must have its minimum not above its maximum on each axis");
    if (!geom::is_in_domain(lo) || !geom::is_in_domain(hi))
      throw Error("", "--within", "must be within 1e15 m from the origin");
  }
}

const run::CasePlan& case_to_search(const config::Config& config, const run::Plan& plan) {
  const run::CasePlan* found = nullptr;
  for (const run::GroupPlan& group : plan.groups)
    for (const run::CasePlan& case_plan : group.cases) {
      const assign::AssignerDescriptor& assigner = *assign::find_assigner(config.assigners[case_plan.assigner].name);
      const std::optional<grid::Fit>& fit = config.grids[case_plan.grid].slices.fit;
      if (assigner.needs.depth || assigner.at_surfaces || (fit && fit->needs_surfaces())) continue;
      if (!assigner.all_pairs) return case_plan;
      if (found == nullptr) found = &case_plan;
    }
  if (found != nullptr) return *found;
  throw Error(config.file.string(), "", "all cases need depth, and a written path holds no triangles to see it from");
}

std::string space_flags(const WorstCaseRequest& request) {
  std::vector<std::string> flags;
  if (request.within) {
    std::vector<std::string> ends;
    for (const Vec3d& end : {request.within->lo, request.within->hi})
      for (int axis = 0; axis < 3; ++axis) ends.push_back(grid::number_name(end[axis]));
    flags.push_back("--within=" + joined(ends, ","));
  }
  if (request.walkable) flags.push_back("--walkable --eye-height " + grid::number_name(request.eye_height_m));
  if (request.keep_height) flags.emplace_back("--keep-height");
  if (request.keep_direction) flags.emplace_back("--keep-direction");
  for (const double range_m : request.extra_ranges_m) flags.push_back("--add-lights " + grid::number_name(range_m));
  if (request.move_m > 0.0) flags.push_back("--move-lights " + grid::number_name(request.move_m));
  return joined(flags, " ");
}

}  // namespace clusterbench::search
