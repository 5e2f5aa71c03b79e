#include "run/timing/served_cases.h"

#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "measure/samples/shading.h"
#include "run/cases/path_culls.h"
#include "run/timing/repeated.h"
#include "run/timing/timed_work.h"

namespace clusterbench::run {
namespace {

std::string_view bytes_of(const std::vector<std::uint32_t>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(std::uint32_t)};
}

ListDigest digest_of(const assign::Lists& lists) {
  return {lists.pair_count(), sha256_hex(sha256_hex(bytes_of(lists.begin)) + sha256_hex(bytes_of(lists.lights)))};
}

// One method's lists of the path's frames, in their order: of its cells or, without cells, at samples.
class ListsOfFrames {
 public:
  ListsOfFrames(const config::Config& config, const GroupPlan& group, const CasePlan& case_plan, const PathFrames& path)
      : config_(config),
        group_(group),
        path_(path),
        grids_(config.grids[group.grid]),
        precision_(case_plan.precision),
        culls_(config, case_plan, path),
        run_(config, case_plan.method(), culls_.of(case_plan.method())) {}

  const assign::Lists& at(int index) {
    const view::Frame frame = path_.frame(index);
    const bool is_new_grid = grids_.update(path_, frame);
    const FrameLights lights(config_.precisions, view::lights_in(frame, grid::space_of(grids_.grid(), frame)));
    const view::LightArrays& packed = lights.in_precision(precision_);
    if (is_new_grid) run_.build(grids_.grid(), assign::kinds_of(packed));
    depth_ = depths_for(config_, group_, path_, frame);
    run_.assign(frame, packed, depth_.get());
    if (run_.has_cells()) return run_.cell_lists();
    list_at_samples(frame);
    return lists_at_samples_;
  }
  Vec3i cells() const {
    if (run_.has_occupied_cells()) return run_.own_structure()->occupied_cells().counts;
    return run_.has_cells() ? grids_.grid().cells() : Vec3i{k_samples, 1, 1};
  }

 private:
  static constexpr int k_samples = 4096;

  void list_at_samples(const view::Frame& frame) {
    assign::Lists& lists = lists_at_samples_;
    const std::optional<assign::MappedStructure> mapped = run_.mapped(*run_.own_structure());
    const assign::LightStructure* structure = run_.own_structure();
    if (mapped) structure = &*mapped;
    lists.lights.clear();
    lists.begin.assign(1, 0);
    for (const grid::Sample& sample :
         measure::volume_samples(frame, sample_far(frame, path_.far_m()), k_samples, config_.seed)) {
      structure->lights_at(sample, grid::Log2::rounded, given_);
      lists.lights.insert(lists.lights.end(), given_.begin(), given_.end());
      lists.begin.push_back(lists.pair_count());
    }
    assign::make_ascending(lists);
  }

  const config::Config& config_;
  const GroupPlan& group_;
  const PathFrames& path_;
  std::shared_ptr<const depth::DepthImage> depth_;  // of the current frame
  GridOfFrames grids_;
  std::size_t precision_;
  PathCulls culls_;
  CulledRun run_;
  assign::Lists lists_at_samples_;
  std::vector<std::uint32_t> given_;
};

}  // namespace

class ServedCases::OpenGroup {
 public:
  OpenGroup(const config::Config& config, const Plan& plan, const GroupPlan& group)
      : config_(config), group_(group), frames_(frames_of(config, plan, group)) {}

  const GroupPlan& group() const { return group_; }

  double assign_ns(const Method& method) {
    Track& track = track_of(method);
    track.work.cull();
    track.work.assign();  // warms caches that the other program has filled
    return track.assign.sample() / static_cast<double>(track.work.frame_count());
  }

 private:
  struct Track {
    Track(const config::Config& config, const GroupPlan& group, const Method& of, const std::vector<TimedFrame>& frames)
        : method(of),
          work(config, group, of, frames),
          assign(
              [this] {
                work.cull();
                work.assign();
              },
              config.timing.min_time_ms * 1e6, is_threaded(config.assigners[of.assigner]) ? wall_ns : thread_ns) {}

    Method method;
    TimedWork work;
    Repeated assign;
  };

  static std::vector<TimedFrame> frames_of(const config::Config& config, const Plan& plan, const GroupPlan& group) {
    const PathFrames path = path_of(config, plan, group);
    return timed_frames(config, group, path, mean_frames(config, path));
  }

  Track& track_of(const Method& method) {
    for (const auto& track : tracks_)
      if (track->method == method) return *track;
    tracks_.push_back(std::make_unique<Track>(config_, group_, method, frames_));
    return *tracks_.back();
  }

  const config::Config& config_;
  const GroupPlan& group_;
  std::vector<TimedFrame> frames_;
  std::vector<std::unique_ptr<Track>> tracks_;
};

ServedCases::ServedCases(const config::Config& config, const Plan& plan) : config_(config), plan_(plan) {}
ServedCases::~ServedCases() = default;

std::vector<std::string> ServedCases::case_ids() {
  std::vector<std::string> ids;
  for (const GroupPlan& group : plan_.groups)
    for (const CasePlan& case_plan : group.cases) ids.push_back(case_plan.id);
  return ids;
}

ServedCases::PlannedCase ServedCases::find(const std::string& id) const {
  for (const GroupPlan& group : plan_.groups)
    for (const CasePlan& case_plan : group.cases)
      if (case_plan.id == id) return {group, case_plan};
  throw Error("", id, "is no case of this plan");
}

std::vector<ListDigest> ServedCases::list_digests(const std::string& id) {
  const PlannedCase planned = find(id);
  const PathFrames path = path_of(config_, plan_, planned.group);
  ListsOfFrames lists(config_, planned.group, planned.case_plan, path);
  std::vector<ListDigest> digests;
  for (int frame = 0; frame < path.count(); ++frame) digests.push_back(digest_of(lists.at(frame)));
  return digests;
}

FrameLists ServedCases::frame_lists(const std::string& id, int frame) {
  const PlannedCase planned = find(id);
  const PathFrames path = path_of(config_, plan_, planned.group);
  if (frame < 0 || frame >= path.count()) throw Error("", id, "has no frame " + std::to_string(frame));
  ListsOfFrames lists(config_, planned.group, planned.case_plan, path);
  const assign::Lists& found = lists.at(frame);
  FrameLists out{lists.cells(), {}};
  for (std::uint32_t cell = 0; cell < found.cell_count(); ++cell)
    out.lights.emplace_back(found.of(cell).begin(), found.of(cell).end());
  return out;
}

double ServedCases::assign_ns(const std::string& id) {
  const PlannedCase planned = find(id);
  if (!open_ || &open_->group() != &planned.group) {
    open_.reset();
    open_ = std::make_unique<OpenGroup>(config_, plan_, planned.group);
  }
  return open_->assign_ns(planned.case_plan.method());
}

}  // namespace clusterbench::run
