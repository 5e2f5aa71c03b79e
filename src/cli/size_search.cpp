#include "cli/size_search.h"

#include <unistd.h>

#include <algorithm>

#include "cli/stop.h"
#include "core/error.h"
#include "search/shared_grid.h"
#include "search/worst_case.h"

namespace clusterbench::cli {
namespace {

const run::CasePlan* case_named(const run::Plan& plan, const std::string& name) {
  for (const run::GroupPlan& group : plan.groups)
    for (const run::CasePlan& case_plan : group.cases)
      if (case_plan.name == name) return &case_plan;
  return nullptr;
}

// What makes the buffers of a structure large: room for the longest list in each cell, else all entries.
search::Measure measure_of(const report::SizedCase& sized) {
  return sized.storage.starts_with("fixed") ? search::Measure::longest : search::Measure::entries;
}

// "" if frames elsewhere can be measured.
std::string why_not(const config::Config& config, const run::CasePlan& case_plan) {
  const assign::AssignerDescriptor& method = *assign::find_assigner(config.assigners[case_plan.assigner].name);
  const std::optional<grid::Fit>& fit = config.grids[case_plan.grid].slices.fit;
  const bool needs_surfaces = method.needs.depth || method.at_surfaces || (fit && fit->needs_surfaces());
  return needs_surfaces ? "its lists follow visible surfaces, which a search does not have" : "";
}

report::FoundFrame found_in(const SizeCounts& counts, const report::SizedCase& sized, search::WorstCaseRequest request,
                            const search::WorstCaseListener& listener, const std::atomic<bool>& stop) {
  report::FoundFrame out;
  out.case_name = sized.name;
  const run::CasePlan* case_plan = case_named(counts.plan, sized.name);
  if (case_plan == nullptr) return out.refusal = "it is not in the plan", out;
  out.refusal = why_not(counts.config, *case_plan);
  if (!out.refusal.empty()) return out;
  config::Config config = counts.config;
  search::fix_grid(config, counts.plan, *case_plan);
  request.measure = measure_of(sized);
  request.random = 0;
  try {
    const search::WorstCase found = search::find_worst_case(config, counts.plan, *case_plan, request, listener, stop);
    if (found.frames.empty()) return out.refusal = "the search was interrupted", out;
    out.evaluations = found.evaluations;
    out.seed = request.seed;
    out.lights = found.own_lights + request.extra_ranges_m.size();
    const Vec3d& eye = found.frames.front().choice.eye;
    out.eye_m = {eye.x, eye.y, eye.z};
    for (const assign::BufferNeed& need : found.buffers)
      out.needs.push_back({need.name, need.elements, need.most, need.element_bytes});
  } catch (const Error& error) {
    if (error.where().starts_with("--")) throw;  // a flag that is wrong for all
    out.refusal = error.what();
  }
  return out;
}

}  // namespace

std::optional<std::vector<report::FoundFrame>> search_sized(const SizeCounts& counts,
                                                            const std::vector<report::SizedCase>& cases,
                                                            const SearchFlags& flags, bool quiet) {
  const search::WorstCaseRequest request = search_request(flags, counts.config);
  const std::atomic<bool>& stop = stop_on_signals();
  ProgressLine progress(terminal(STDERR_FILENO), quiet);
  std::vector<report::FoundFrame> out;
  for (const report::SizedCase& sized : cases) {
    out.push_back(found_in(counts, sized, request, search_listener(progress), stop));
    if (stop) return {};
  }
  return out;
}

std::optional<std::vector<report::GuestSamples>> samples_of_guests(const SizeCounts& counts,
                                                                   const std::vector<report::SizedCase>& cases,
                                                                   bool quiet) {
  constexpr int k_samples = 1024;  // of a frame
  const std::atomic<bool>& stop = stop_on_signals();
  ProgressLine progress(terminal(STDERR_FILENO), quiet);
  std::vector<report::GuestSamples> out;
  for (const report::SizedCase& sized : cases) {
    const run::CasePlan* case_plan = case_named(counts.plan, sized.grid_case);
    if (case_plan == nullptr) continue;
    const std::vector<scene::CameraPath>& paths = counts.plan.scenes[case_plan->scene].paths;
    for (std::size_t camera = 0; camera < paths.size(); ++camera) {
      if (std::ranges::find(sized.guests, paths[camera].camera) == sized.guests.end()) continue;
      progress.stage("samples of " + paths[camera].camera + " in the grid of " + paths[case_plan->camera].camera);
      const measure::ShadingCounts found =
          search::samples_in_grid_of(counts.config, counts.plan, *case_plan, camera, k_samples, stop);
      if (stop) return {};
      out.push_back({sized.grid_case, paths[camera].camera, found.samples, found.unanswered, found.needed, found.missed,
                     found.missed_outside, found.worst ? found.worst->frame : 0});
    }
  }
  return out;
}

}  // namespace clusterbench::cli
