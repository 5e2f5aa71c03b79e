#include "search/views.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "measure/lists/lights_in_view_counts.h"
#include "run/cases/path_frames.h"

namespace clusterbench::search {
namespace {

// The identity of a candidate within a view.
using Key = std::tuple<std::size_t, std::size_t, std::size_t, std::size_t>;
Key key_of(const run::CasePlan& plan) {
  return {plan.grid, plan.assigner, plan.precision, plan.storage ? *plan.storage + 1 : 0};
}

// "grid/assigner/storage" of "scene/camera/grid/assigner/storage".
std::string short_name(const std::string& name) {
  return name.substr(name.find('/', name.find('/') + 1) + 1);
}

// If all candidates of a view are of one kind, none is separate.
void set_apart(const config::Config& config, View& view) {
  const auto is_searched = [&](const Candidate& candidate) {
    const run::CasePlan& plan = *candidate.cases.front();
    return !plan.storage && assign::find_assigner(config.assigners[plan.assigner].name)->own_is_searched();
  };
  if (std::ranges::all_of(view.candidates, is_searched)) return;
  for (Candidate& candidate : view.candidates) candidate.is_apart = is_searched(candidate);
}

// Boxes are assigned to cells, too, but light nothing.
bool sees_no_light(const config::Config& config, const run::Plan& plan, const run::GroupPlan& group) {
  if (!plan.scenes[group.scene].scene.boxes.empty()) return false;
  const run::PathFrames path = run::path_of(config, plan, group);
  measure::LightsInView in_view;
  for (int i = 0; i < path.count() && in_view.seen() == 0; ++i) {
    const view::Frame frame = path.frame(i);
    measure::add_frame(in_view, frame, path.lights_in_view(frame));
  }
  return in_view.seen() == 0;
}

}  // namespace

std::vector<View> views_of(const config::Config& config, const run::Plan& plan) {
  std::map<std::pair<std::size_t, std::size_t>, View> views;
  std::map<std::pair<std::size_t, std::size_t>, std::map<Key, Candidate>> candidates;
  std::map<std::size_t, std::map<std::size_t, bool>> blind;  // by scene and camera
  for (const run::GroupPlan& group : plan.groups) {
    std::map<std::size_t, bool>& of_scene = blind[group.scene];
    if (!of_scene.contains(group.camera)) of_scene[group.camera] = sees_no_light(config, plan, group);
  }
  for (const run::GroupPlan& group : plan.groups) {
    const std::pair key{group.scene, group.viewport};
    View& view = views[key];
    view.scene = group.scene;
    view.viewport = group.viewport;
    // If all cameras are blind, all are used, and the answer reports it.
    const bool is_left_out = blind[group.scene][group.camera] &&
                             !std::ranges::all_of(blind[group.scene], [](const auto& camera) { return camera.second; });
    std::vector<std::size_t>& cameras = is_left_out ? view.blind : view.cameras;
    if (cameras.empty() || cameras.back() != group.camera) cameras.push_back(group.camera);
    if (is_left_out) continue;
    for (const run::CasePlan& plan_of_case : group.cases) {
      Candidate& candidate = candidates[key][key_of(plan_of_case)];
      candidate.grid = group.grid;
      if (candidate.cases.empty()) candidate.name = short_name(plan_of_case.name);
      candidate.cases.push_back(&plan_of_case);
    }
  }
  std::vector<View> out;
  for (auto& [key, view] : views) {
    for (const std::size_t camera : view.cameras) view.frames += plan.scenes[view.scene].paths[camera].shots.size();
    for (auto& [_, candidate] : candidates[key]) {
      if (candidate.cases.size() == view.cameras.size())
        view.candidates.push_back(std::move(candidate));
      else
        ++view.incomplete;
    }
    std::ranges::stable_sort(view.candidates, {}, [&](const Candidate& candidate) {
      const int slowness = assign::slowness_of(config.assigners[candidate.cases.front()->assigner].name);
      return std::tuple(candidate.grid, slowness != 1, slowness, candidate.name);
    });
    set_apart(config, view);
    out.push_back(std::move(view));
  }
  return out;
}

}  // namespace clusterbench::search
