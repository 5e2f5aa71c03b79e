#include "run/accuracy_pass.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "run/frame_lights.h"

namespace clusterbench::run {
namespace {

std::uint32_t real_cells(const grid::Grid& grid) {
  std::uint32_t count = 0;
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) count += grid.is_hole(cell) ? 0 : 1;
  return count;
}

// One frame as all methods of the group see it.
struct FrameAtHand {
  view::Frame frame;
  bool is_new_grid = false;
  FrameLights lights;
  measure::Truth truth;
  std::vector<grid::Sample> samples;
  assign::Lists reaching;
  std::optional<measure::LookupFrame> lookup;

  std::uint32_t spots() const { return static_cast<std::uint32_t>(frame.lights.size()) - frame.points; }
};

class ListMeter {
 public:
  ListMeter(const Config& config, const Method& method) : config_(config) {
    const MethodRequest& assigner = config.assigners[method.assigner];
    assigner_ = assign::find_assigner(assigner.name)->make(assigner.params);
    measures_.method = method;
  }

  void add(const FrameAtHand& now, const grid::Grid& grid) {
    const view::LightArrays& lights = now.lights.seen(measures_.method.precision);
    if (now.is_new_grid) assigner_->build(grid, assign::kinds_of(lights));
    if (!occupancy_) occupancy_.emplace(real_cells(grid));
    assigner_->assign(lights, lists_);
    measures_.tests_done += assigner_->tests_done();
    measures_.fallbacks += assigner_->fallbacks();
    occupancy_->add_frame(now.frame.index, lists_);
    if (config_.check_accuracy) measure::add_frame(measures_.error, now.frame, grid, now.truth, lists_);
    if (now.lookup) now.lookup->add(lists_, measures_.lookup);
    if (!now.samples.empty()) measure::add_frame(measures_.shading, now.frame, grid, now.samples, now.reaching, lists_);
  }

  const assign::Lists& lists() const { return lists_; }
  std::size_t scratch_bytes() const { return assigner_->scratch_bytes(); }
  const Method& method() const { return measures_.method; }

  ListMeasures result() const {
    ListMeasures out = measures_;
    if (occupancy_) out.occupancy = occupancy_->result();
    return out;
  }

 private:
  const Config& config_;
  std::unique_ptr<assign::Assigner> assigner_;
  std::optional<measure::OccupancyMeter> occupancy_;
  ListMeasures measures_;
  assign::Lists lists_;
};

class CaseMeter {
 public:
  CaseMeter(const Config& config, const CasePlan& plan) : method_(plan.method()), buffers_(config.allocation) {
    const MethodRequest& method = config.storages[plan.storage];
    storage_ = assign::find_storage(method.name)->make(method.params);
  }

  void add(const FrameAtHand& now, const grid::Grid& grid, const ListMeter& list) {
    if (now.is_new_grid) storage_->start(grid.cell_count(), now.frame.points, now.spots());
    storage_->store(list.lists());
    buffers_.add_frame(now.frame.index, list.lists(), *storage_, list.scratch_bytes());
  }

  const Method& method() const { return method_; }
  measure::Buffers result() const { return buffers_.result(); }

 private:
  Method method_;
  std::unique_ptr<assign::Storage> storage_;
  measure::BufferMeter buffers_;
};

// How far samples are spread: as far as the camera sees and lights reach, the same for all grids, so that their
// overshade compares. A grid that ends before that misses lights, and the samples say so.
double sample_far(const view::Frame& frame, double path_far_m) {
  return std::max(std::min(frame.projection.far_m, path_far_m), 2.0 * std::abs(frame.projection.near_m) + 1.0);
}

FrameAtHand look_at(const Config& config, const PathFrames& path, GridOfFrames& grids, int index) {
  FrameAtHand now;
  now.frame = path.frame(index);
  now.is_new_grid = grids.update(path, now.frame);
  const grid::Grid& grid = grids.grid();
  now.lights = FrameLights(config.precisions, view::lights_in(now.frame, grid::space_of(grid, now.frame)));
  if (config.check_accuracy) now.truth = measure::find_truth(now.frame, grid, config.threads);
  const double far = sample_far(now.frame, path.far_m());
  if (config.lookup) now.lookup.emplace(now.frame, grid, config.lookup->ways, far, config.lookup->samples, config.seed);
  if (config.shading_samples > 0) {
    now.samples = measure::volume_samples(now.frame, far, config.shading_samples, config.seed);
    now.reaching = measure::lights_reaching(now.frame, now.samples);
  }
  return now;
}

}  // namespace

AccuracyResult accuracy_pass(const Config& config, const GroupPlan& group, const PathFrames& path,
                             const std::function<void(int frame)>& on_frame, const std::atomic<bool>& stop) {
  std::vector<ListMeter> lists;
  for (const Method& method : methods_of(group)) lists.emplace_back(config, method);
  std::vector<CaseMeter> cases;
  for (const CasePlan& one : group.cases) cases.emplace_back(config, one);

  std::vector<measure::PackingLossMeter> losses(config.compares_precisions() ? config.precisions.size() : 0);

  AccuracyResult result;
  GridOfFrames grids(config.grids[group.grid]);
  for (int index = 0; index < path.count(); ++index) {
    if (stop) return result;
    on_frame(index);
    const FrameAtHand now = look_at(config, path, grids, index);
    for (std::size_t i = 0; i < losses.size(); ++i) losses[i].add_frame(now.lights.packed(i));
    for (ListMeter& list : lists) {
      list.add(now, grids.grid());
      for (CaseMeter& one : cases)
        if (one.method() == list.method()) one.add(now, grids.grid(), list);
    }
  }
  for (const ListMeter& list : lists) result.lists.push_back(list.result());
  for (const CaseMeter& one : cases) result.buffers.push_back(one.result());
  for (const measure::PackingLossMeter& loss : losses) result.losses.push_back(loss.result());
  result.last_grid = grids.grid();
  result.is_complete = true;
  return result;
}

}  // namespace clusterbench::run
