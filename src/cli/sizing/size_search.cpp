#include "cli/sizing/size_search.h"

#include <algorithm>
#include <chrono>

#include "cli/output/duration.h"
#include "cli/output/output.h"
#include "core/error.h"
#include "core/libraries.h"
#include "core/text.h"
#include "os/stop_signals.h"
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

// Why frames at other places cannot be measured; "" if they can.
std::string search_obstacle(const config::Config& config, const run::CasePlan& case_plan) {
  if (!is_built_in(Library::nlopt)) return "a search needs NLopt, and " + missing_library(Library::nlopt);
  const assign::AssignerDescriptor& method = *assign::find_assigner(config.assigners[case_plan.assigner].name);
  const std::optional<grid::Fit>& fit = config.grids[case_plan.grid].slices.fit;
  const bool needs_surfaces = method.needs.depth || method.at_surfaces || (fit && fit->needs_surfaces());
  return needs_surfaces ? "its lists follow visible surfaces, which a search does not have" : "";
}

search::Measure measure_named(const std::string& name) {
  return std::ranges::find(search::measure_rows(), name, [](const auto& row) { return std::string(row.name); })
      ->measure;
}

// `failures`: receives why a device ended the search before its time.
report::FoundFrame found_in(const SizeCounts& counts, const report::SizedCase& sized,
                            const search::WorstCaseRequest& request, const search::WorstCaseListener& listener,
                            std::vector<std::string>& failures, const std::atomic<bool>& stop) {
  report::FoundFrame out;
  out.case_name = sized.name;
  out.measure = search::row_of(request.measure).name;
  const run::CasePlan* case_plan = case_named(counts.plan, sized.name);
  if (case_plan == nullptr) return out.refusal = "it is not in the plan", out;
  out.refusal = search_obstacle(counts.config, *case_plan);
  if (!out.refusal.empty()) return out;
  config::Config config = counts.config;
  search::fix_grid(config, counts.plan, *case_plan);
  try {
    const search::WorstCase found = search::find_worst_case(config, counts.plan, *case_plan, request, listener, stop);
    if (found.frames.empty())
      return out.refusal = "its seconds were over before its first frame; allow more (--seconds)", out;
    if (found.ended == search::Ended::device)
      failures.push_back("the search of " + sized.name + " ended early: " + found.device_failure);
    out.value = static_cast<std::uint64_t>(found.frames.front().value);
    out.evaluations = found.evaluations;
    out.seed = request.seed;
    out.lights = found.own_lights + request.extra_ranges_m.size();
    out.space_flags = search::space_flags(request);
    const search::FrameChoice& worst = found.frames.front().choice;
    const Vec3d direction = search::direction_of(worst.rotation);
    out.lights_in_view = found.lights_in_view;
    out.dark_in_view = found.dark_in_view;
    out.eye_m = {worst.eye.x, worst.eye.y, worst.eye.z};
    out.direction = {direction.x, direction.y, direction.z};
    for (const assign::BufferNeed& need : found.buffers)
      out.needs.push_back({need.name, need.elements, need.most, need.element_bytes});
  } catch (const Error& error) {
    if (error.where().starts_with("--")) throw;  // a flag that is wrong for all searches
    out.refusal = error.what();
  }
  return out;
}

// Of each camera, the cases that may be printed: all cases, or one per grid. If one allocation serves several
// viewports, only those of the first one.
std::vector<const run::CasePlan*> cases_to_search(const SizePlan& plan, const report::SizeRequest& request) {
  std::vector<const run::CasePlan*> out;
  for (const run::GroupPlan& group : plan.plan.groups) {
    if (group.viewport != 0 && request.scope.over_viewports) continue;
    const std::string& camera = plan.plan.scenes[group.scene].paths[group.camera].camera;
    if (!request.scope.grid_of.empty() && camera != request.scope.grid_of) continue;
    std::string preset = "none yet";
    for (const run::CasePlan& case_plan : group.cases) {
      if (request.all || case_plan.preset != preset) out.push_back(&case_plan);
      preset = case_plan.preset;
    }
  }
  return out;
}

// The remaining time of all searches together.
class SharedSeconds {
 public:
  explicit SharedSeconds(double seconds) : seconds_(seconds) {}
  // The time limit for the next of this many searches; 0: no limit.
  double share(std::size_t searches) const {
    if (seconds_ == 0.0) return 0.0;
    const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return std::max(1e-3, (seconds_ - passed) / static_cast<double>(searches));
  }

 private:
  double seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::string planned_search_text(const SizePlan& plan, const report::SizeRequest& request, const SearchFlags& flags) {
  constexpr double k_max_estimate_s = 2.0;
  search::WorstCaseRequest planned = search_request(flags, plan.config);
  planned.random = 0;
  const SharedSeconds time(k_max_estimate_s);
  std::size_t searches = 0, estimated = 0;
  double estimated_s = 0.0;
  for (const run::CasePlan* case_plan : cases_to_search(plan, request)) {
    if (!search_obstacle(plan.config, *case_plan).empty()) continue;
    for (const std::string& measure :
         report::sized_measures(run::storage_label(plan.config, *case_plan), request.engine)) {
      ++searches;
      if (time.share(1) < 0.1) continue;
      planned.measure = measure_named(measure);
      config::Config config = plan.config;
      search::fix_grid(config, plan.plan, *case_plan);
      try {
        estimated_s += search::estimated_search_s(config, plan.plan, *case_plan, planned);
        ++estimated;
      } catch (const Error& error) {
        if (error.where().starts_with("--")) throw;
        --searches;
      }
    }
  }
  if (searches == 0) return "";
  double all_s = estimated_s / static_cast<double>(estimated) * static_cast<double>(searches);
  if (planned.seconds > 0.0) all_s = std::min(all_s, planned.seconds);
  const std::string frames = number_of(static_cast<std::uint64_t>(planned.evaluations), "frame");
  return ", then searches " + frames + " for worse ones" +
         (searches > 1 ? ", " + std::to_string(searches) + " times" : std::string()) + ", " + duration_text(all_s) +
         "; --evaluations N searches fewer, --seconds N ends all searches after N seconds";
}

std::optional<std::vector<report::FoundFrame>> search_sized(const SizeCounts& counts,
                                                            const std::vector<report::SizedCase>& cases,
                                                            const SearchFlags& flags, bool quiet) {
  search::WorstCaseRequest request = search_request(flags, counts.config);
  request.random = 0;
  const SharedSeconds seconds(request.seconds);
  const std::atomic<bool>& stop = os::stop_on_signals();
  ProgressLine progress(os::terminal(os::StandardStream::error), quiet);
  std::vector<report::FoundFrame> out;
  std::vector<std::string> failures;
  std::size_t searches = 0;
  for (const report::SizedCase& sized : cases) searches += sized.measures.size();
  for (const report::SizedCase& sized : cases)
    for (const std::string& measure : sized.measures) {
      request.measure = measure_named(measure);
      request.seconds = seconds.share(searches - out.size());
      out.push_back(found_in(counts, sized, request, search_listener(progress, out.size(), searches), failures, stop));
      if (stop) return {};
    }
  progress.clear();
  for (const std::string& failure : failures) print_message("warning: " + failure);
  return out;
}

std::optional<std::vector<report::GuestSamples>> samples_of_guests(const SizeCounts& counts,
                                                                   const std::vector<report::SizedCase>& cases,
                                                                   bool quiet) {
  constexpr int k_samples = 1024;  // per frame
  const std::atomic<bool>& stop = os::stop_on_signals();
  ProgressLine progress(os::terminal(os::StandardStream::error), quiet);
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
