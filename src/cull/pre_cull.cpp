#include "cull/pre_cull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "cull/view_planes.h"

namespace clusterbench::cull {
namespace {

// Applies the steps to one frame's lights.
struct StepOnLights {
  const view::Frame& frame;
  const grid::Grid& grid;
  const view::LightArrays& lights;
  const VisibleSets* sets;  // the step's own
  FrameCull& out;
  std::vector<std::uint32_t>& kept = out.kept;

  // A light of range 0 reaches nothing, and is not in view (grid/lights_in_view.h).
  void operator()(const FrustumStep&) const {
    const ViewPlanes planes(frame, grid, ViewPlanes::Depths::camera);
    std::erase_if(kept,
                  [&](std::uint32_t light) { return lights.is_empty(light) || planes.are_missed_by(ball(light)); });
  }

  void operator()(const DistanceStep& step) const {
    const Vec3d eye = lights.space.rotation * (frame.view_space.origin - lights.space.origin);
    std::erase_if(kept, [&](std::uint32_t light) {
      const geom::Ball padded = ball(light);
      const Vec3d way = Vec3d(padded.center) - eye;
      return std::sqrt(glm::dot(way, way)) - static_cast<double>(padded.radius) - k_cull_least_m > step.distance_m;
    });
  }

  void operator()(const VisibleSetStep&) const {
    const VisibleSets::ViewCell* cell = sets->at(frame.view_space.origin);
    if (cell == nullptr) return;
    std::erase_if(kept, [&](std::uint32_t light) { return !sets->keeps(*cell, light, lights.source[light]); });
  }

  void operator()(const MostStep& step) const {
    if (kept.size() <= static_cast<std::size_t>(step.lights)) return;
    out.before = kept;
    if (step.keep != MostStep::Keep::first) sort_for(step);
    keep_first(step);
    std::ranges::sort(kept);
    std::ranges::set_difference(out.before, kept, std::back_inserter(out.dropped));
  }

  // Sorts the lights that a limit keeps to the front; equal ones by index.
  void sort_for(const MostStep& step) const {
    const Vec3d eye = lights.space.rotation * (frame.view_space.origin - lights.space.origin);
    const Vec3d back = lights.space.rotation * (glm::transpose(frame.view_space.rotation) * Vec3d(0, 0, 1));
    const bool by_depth = step.keep == MostStep::Keep::shallowest;
    std::ranges::sort(kept, {}, [&](std::uint32_t light) {
      const Vec3d way = Vec3d(lights.x[light], lights.y[light], lights.z[light]) - eye;
      return std::pair(by_depth ? std::max(0.0, -glm::dot(way, back)) : glm::dot(way, way), light);
    });
  }

  // Of all lights, or of each type.
  void keep_first(const MostStep& step) const {
    const auto most = static_cast<std::size_t>(step.lights);
    if (!step.per_type) return kept.resize(most);
    std::array<std::size_t, view::k_light_types> counts{};
    std::erase_if(kept, [&](std::uint32_t light) { return ++counts[lights.type_of(light)] > most; });
  }

  geom::Ball ball(std::uint32_t light) const { return lights.bounding_ball(light, k_cull_roundoffs); }
};

// For one frame.
struct IsConservative {
  const view::Frame& frame;
  const grid::Grid& grid;
  const view::LightArrays& lights;
  std::uint32_t removed;  // by the step

  // Cells of frustum and distance grids end with the picture's sides, and maybe not with the camera's near and far.
  bool operator()(const FrustumStep&) const {
    if (!grid.has_tiles()) return false;
    const ViewPlanes camera(frame, grid, ViewPlanes::Depths::camera), cells(frame, grid, ViewPlanes::Depths::cells);
    for (std::uint32_t light = 0; light < lights.size(); ++light) {
      const geom::Ball ball = lights.bounding_ball(light, k_cull_roundoffs);
      if (!lights.is_empty(light) && camera.are_missed_by(ball) && !cells.are_missed_by(ball)) return false;
    }
    return true;
  }
  bool operator()(const DistanceStep& step) const { return farthest_of_cells(grid) <= step.distance_m; }
  bool operator()(const VisibleSetStep&) const { return false; }
  bool operator()(const MostStep&) const { return removed == 0; }
};

// `first`: index of the array's first light.
void gather(const std::vector<float>& from, std::uint32_t first, std::span<const std::uint32_t> chosen,
            std::vector<float>& to) {
  to.resize(chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) to[i] = from[chosen[i] - first];
}

// Copies the lights of these ascending indices, side by side as an engine compacts those that a cull leaves. `out`
// keeps its memory and its `source`, which belongs to whoever made it.
void select_lights(const view::LightArrays& all, std::span<const std::uint32_t> chosen, view::LightArrays& out) {
  const auto first_spot = std::ranges::lower_bound(chosen, all.spots.first);
  const auto points = static_cast<std::size_t>(first_spot - chosen.begin());
  static_cast<view::LightRanges&>(out) =
      view::LightRanges(static_cast<std::uint32_t>(points), static_cast<std::uint32_t>(chosen.size() - points));
  out.space = all.space;
  for (std::vector<float> view::LightArrays::*part :
       {&view::LightArrays::x, &view::LightArrays::y, &view::LightArrays::z, &view::LightArrays::radius,
        &view::LightArrays::reach})
    gather(all.*part, 0, chosen, out.*part);
  for (std::vector<float> view::LightArrays::*part :
       {&view::LightArrays::axis_x, &view::LightArrays::axis_y, &view::LightArrays::axis_z,
        &view::LightArrays::cos_angle, &view::LightArrays::sin_angle})
    gather(all.*part, all.spots.first, chosen.subspan(points), out.*part);
}

}  // namespace

PreCull::PreCull(PreCullSpec spec, std::vector<std::shared_ptr<const VisibleSets>> sets) : spec_(std::move(spec)) {
  auto next = sets.begin();
  for (const Step& step : spec_.steps)
    sets_.push_back(std::holds_alternative<VisibleSetStep>(step) ? std::move(*next++) : nullptr);
}

void PreCull::cull(const view::Frame& frame, const grid::Grid& grid, const view::LightArrays& lights,
                   FrameCull& out) const {
  out.kept.resize(lights.size());
  std::iota(out.kept.begin(), out.kept.end(), 0u);
  out.removed.clear();
  out.dropped.clear();
  for (std::size_t i = 0; i < spec_.steps.size(); ++i) {
    const std::size_t before = out.kept.size();
    std::visit(StepOnLights{frame, grid, lights, sets_[i].get(), out}, spec_.steps[i]);
    out.removed.push_back(static_cast<std::uint32_t>(before - out.kept.size()));
  }
  select_lights(lights, out.kept, out.lights);
}

void PreCull::give_source(const view::LightArrays& lights, FrameCull& out) {
  out.source.clear();
  for (const std::uint32_t light : out.kept) out.source.push_back(lights.source[light]);
  out.lights.source = out.source;
}

bool PreCull::is_conservative(const view::Frame& frame, const grid::Grid& grid, const view::LightArrays& lights,
                              const FrameCull& cull) const {
  for (std::size_t i = 0; i < spec_.steps.size(); ++i)
    if (!std::visit(IsConservative{frame, grid, lights, cull.removed[i]}, spec_.steps[i])) return false;
  return true;
}

std::uint64_t PreCull::bytes() const {
  std::uint64_t sum = 0;
  for (const auto& set : sets_) sum += set ? set->bytes() : 0;
  return sum;
}

double PreCull::build_ns() const {
  double sum = 0.0;
  for (const auto& set : sets_) sum += set ? set->build_ns() : 0.0;
  return sum;
}

std::size_t PreCull::view_cells() const {
  std::size_t sum = 0;
  for (const auto& set : sets_) sum += set ? set->view_cell_count() : 0;
  return sum;
}

}  // namespace clusterbench::cull
