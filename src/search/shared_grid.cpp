#include "search/shared_grid.h"

#include "core/error.h"
#include "core/text.h"
#include "run/cases/path_frames.h"
#include "search/frame_measure.h"

namespace clusterbench::search {
namespace {

void check_cameras(const config::Config& config, const run::CasePlan& case_plan, const scene::CameraPath& owner,
                   const scene::CameraPath& guest) {
  const assign::AssignerDescriptor& method = *assign::find_assigner(config.assigners[case_plan.assigner].name);
  if (method.needs.depth || method.at_surfaces)
    throw Error("", "--grid-of", case_plan.name + " follows the surfaces that its own camera sees");
  if (!config.pre_culls[case_plan.pre_cull].is_none())
    throw Error("", "--grid-of", case_plan.name + " leaves out lights for its own camera; run it without a pre-cull");
  if (owner.shots.size() != guest.shots.size())
    throw Error("", "--grid-of",
                "'" + owner.camera + "' has " + number_of(owner.shots.size(), "frame") + " and '" + guest.camera +
                    "' " + std::to_string(guest.shots.size()) +
                    "; cameras of one frame need the same moments: animate them together, or set scenes.*.frames=N");
}

// The points in the other camera's view.
std::vector<grid::Sample> seen_from(const view::Frame& frame, const std::vector<grid::Sample>& samples) {
  std::vector<grid::Sample> out;
  for (const grid::Sample& sample : samples)
    out.push_back(measure::sample_of(frame, sample.from_eye + (sample.eye - frame.view_space.origin)));
  return out;
}

}  // namespace

measure::ShadingCounts samples_in_grid_of(const config::Config& config, const run::Plan& plan,
                                          const run::CasePlan& case_plan, std::size_t guest, int samples,
                                          const std::atomic<bool>& stop) {
  const run::SceneData& data = plan.scenes[case_plan.scene];
  check_cameras(config, case_plan, data.paths[case_plan.camera], data.paths[guest]);
  const run::PathFrames owners = run::path_of(config, data, case_plan.camera, case_plan.viewport),
                        guests = run::path_of(config, data, guest, case_plan.viewport);
  FrameMeter meter(config, case_plan, Measure::entries);
  measure::ShadingCounts counts;
  for (int i = 0; i < owners.count() && !stop; ++i) {
    const view::Frame owner = owners.frame(i), other = guests.frame(i);
    meter.value(owners, i);
    const std::vector<grid::Sample> own =
        measure::volume_samples(other, run::sample_far(other, guests.far_m()), samples, config.seed);
    measure::add_samples(counts, i, seen_from(owner, own), measure::needed_lights(other, own), meter.structure());
  }
  return counts;
}

}  // namespace clusterbench::search
