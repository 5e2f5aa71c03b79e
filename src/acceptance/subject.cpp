#include "acceptance/subject.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/text.h"
#include "os/call_notes.h"
#include "stress/random_setting.h"

namespace clusterbench::acceptance {
namespace {

constexpr std::uint64_t k_most_pairs = 1u << 20;
constexpr std::uint64_t k_most_seeds = 1000;

// The frame of a trial; none where frame_of_seed() has none.
std::optional<SubjectFrame> frame_of_trial(const Subject& subject, const stress::Trial& trial, std::string label) {
  const stress::StressMethod method = subject.with_defaults();
  if (!stress::supports_trial(method, trial)) return {};
  SubjectFrame out;
  out.label = std::move(label);
  try {
    out.frame = stress::frame_of(trial);
    out.grid = stress::grid_of(trial, out.frame);
  } catch (const Error&) {
    return {};
  }
  out.lights = view::lights_in(out.frame, grid::space_of(out.grid, out.frame));
  out.depths = stress::depths_for(*method.assigner, out.frame);
  if (out.frame.lights.empty() || std::uint64_t{out.grid.cell_count()} * out.lights.size() > k_most_pairs) return {};
  return out;
}

// As levels have: lights of some metres, most of them in view, and none on the edge of a cell.
stress::Rig ordinary_rig(std::uint64_t seed, bool has_spots) {
  SplitMix64 random(seed);
  const auto place = [&random] {
    return Vec3d(random.between(-25.0, 25.0), random.between(-8.0, 8.0), random.between(-60.0, 5.0));
  };
  stress::Rig rig;
  for (int i = 0; i < 64; ++i) rig.point(place(), random.between(1.0, 9.0));
  for (int i = 0; has_spots && i < 32; ++i)
    rig.spot(place(), {random.between(-1.0, 1.0), -1.0, random.between(-1.0, 1.0)}, random.between(2.0, 15.0),
             random.between(0.2, 0.8));
  return rig;
}

}  // namespace

std::vector<stress::StressMethod> Subject::with_every_choice() const {
  std::vector<stress::StressMethod> all = stress::stress_methods();
  std::erase_if(all, [&](const stress::StressMethod& one) { return one.assigner->name != method->descriptor.name; });
  return all;
}

stress::StressMethod Subject::with_defaults() const {
  const assign::AssignerDescriptor& descriptor = *assign::find_assigner(method->descriptor.name);
  const assign::Params params(descriptor.params);
  return {descriptor.name, &descriptor, params, assign::is_conservative(descriptor, params), assign::Answer::lists};
}

std::optional<SubjectFrame> frame_of_seed(const Subject& subject, std::uint64_t seed) {
  const stress::Trial trial = stress::random_setting(seed);
  return frame_of_trial(subject, trial, "seed " + std::to_string(seed) + ", " + trial.grid.name());
}

std::vector<SubjectFrame> ordinary_frames(const Subject& subject) {
  std::vector<SubjectFrame> frames;
  for (const bool has_spots : {true, false}) {
    const stress::Rig rig = ordinary_rig(subject.seed, has_spots);
    for (const grid::GridSpec& grid : stress::grids_of_every_kind())
      if (std::optional<SubjectFrame> frame = frame_of_trial(subject, rig.on(grid), "an ordinary view, " + grid.name()))
        frames.push_back(std::move(*frame));
  }
  return frames;
}

std::vector<SubjectFrame> frames_for(const Subject& subject, int per_kind) {
  std::vector<SubjectFrame> frames;
  std::map<grid::Kind, int> counts;
  const auto wanted = static_cast<std::size_t>(per_kind) * subject.method->descriptor.kinds.size();
  for (std::uint64_t i = 0; i < k_most_seeds && frames.size() < wanted; ++i) {
    std::optional<SubjectFrame> frame = frame_of_seed(subject, subject.seed + i);
    if (frame && counts[frame->grid.kind()]++ < per_kind) frames.push_back(std::move(*frame));
  }
  return frames;
}

SubjectFrame with_lights(const SubjectFrame& from, const std::function<bool(std::size_t light)>& keep) {
  SubjectFrame out;
  out.label = from.label;
  out.frame = from.frame;
  out.grid = from.grid;
  out.depths = from.depths;
  out.frame.lights.clear();
  for (std::size_t i = 0; i < from.frame.lights.size(); ++i)
    if (keep(i)) out.frame.lights.push_back(from.frame.lights[i]);
  out.frame.count_types();
  out.lights = view::lights_in(out.frame, grid::space_of(out.grid, out.frame));
  return out;
}

assign::Lists lists_of(const Subject& subject, const SubjectFrame& frame) {
  const stress::StressMethod method = subject.with_defaults();
  os::note_setting(frame.label);
  assign::AssignerRun run = method.start();
  run.build(frame.grid, frame.kinds());
  run.assign(frame.input());
  return run.cell_lists();
}

std::string frames_text(std::size_t frames) {
  return number_of(frames, "frame");
}

}  // namespace clusterbench::acceptance
