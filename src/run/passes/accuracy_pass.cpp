#include "run/passes/accuracy_pass.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "assign/contract/storage.h"
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
  std::vector<bool> is_outside;  // of each sample: of the grid
  assign::Lists reaching;
  std::optional<measure::LookupFrame> lookup;
};

class MethodMeter {
 public:
  MethodMeter(const config::Config& config, const Method& method)
      : config_(config), run_(start_method(config, method)) {
    measures_.method = method;
    measures_.has_cells = run_.has_cells();
  }

  void add(const FrameAtHand& now, const grid::Grid& grid) {
    const view::LightArrays& lights = now.lights.in_precision(measures_.method.precision);
    if (now.is_new_grid) run_.build(grid, assign::kinds_of(lights));
    run_.assign({now.frame, lights});
    measures_.tests_done += run_.tests_done();
    measures_.fallbacks += run_.fallbacks();
    if (!measures_.has_cells) return;
    if (!occupancy_) occupancy_.emplace(real_cells(grid));
    lists_ = &run_.cell_lists();
    occupancy_->add_frame(now.frame.index, *lists_);
    if (config_.check_accuracy) measure::add_frame(measures_.error, now.frame, grid, now.truth, *lists_);
  }

  const assign::AssignerRun& run() const { return run_; }
  const assign::Lists* cell_lists() const { return lists_; }
  const Method& method() const { return measures_.method; }

  MethodMeasures result() const {
    MethodMeasures out = measures_;
    if (occupancy_) out.occupancy = occupancy_->result();
    return out;
  }

 private:
  const config::Config& config_;
  assign::AssignerRun run_;
  const assign::Lists* lists_ = nullptr;  // of the cells, in the frame at hand
  std::optional<measure::OccupancyMeter> occupancy_;
  MethodMeasures measures_;
};

class CaseMeter {
 public:
  CaseMeter(const config::Config& config, const CasePlan& plan) : method_(plan.method()), buffers_(config.allocation) {
    if (!plan.storage) return;
    const config::MethodRequest& request = config.storages[*plan.storage];
    storage_ = assign::find_storage(request.name)->make(request.params);
  }

  void add(const FrameAtHand& now, const grid::Grid& grid, const MethodMeter& method) {
    if (storage_) {
      if (now.is_new_grid) storage_->start(grid, now.frame.ranges());
      storage_->store(*method.run().filled_lists());
    }
    const assign::LightStructure& structure = storage_ ? *storage_ : *method.run().structure();
    buffers_.add_frame(now.frame.index, structure, method.cell_lists(), method.run().scratch_bytes());
    if (now.lookup) now.lookup->add(structure, measures_.lookup);
    if (!now.samples.empty()) ask_at_samples(now, structure);
  }

  const Method& method() const { return method_; }
  StructureMeasures result() const {
    StructureMeasures out = measures_;
    out.buffers = buffers_.result();
    return out;
  }

 private:
  void ask_at_samples(const FrameAtHand& now, const assign::LightStructure& structure) {
    const measure::ShadingCounts before = measures_.shading;
    measure::add_frame(measures_.shading, now.frame, now.samples, now.reaching, structure, now.is_outside);
    const UnlitFrame unlit{now.frame.index, measures_.shading.missed - before.missed,
                           measures_.shading.needed - before.needed};
    if (unlit.missed > (measures_.worst_unlit ? measures_.worst_unlit->missed : 0)) measures_.worst_unlit = unlit;
  }

  Method method_;
  std::unique_ptr<assign::Storage> storage_;  // none: the method's own structure
  measure::BufferMeter buffers_;
  StructureMeasures measures_;
};

FrameAtHand look_at(const config::Config& config, const PathFrames& path, GridOfFrames& grids, int index) {
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
    for (const grid::Sample& sample : now.samples) now.is_outside.push_back(grid::lookup(grid, sample) < 0);
  }
  return now;
}

}  // namespace

AccuracyResult accuracy_pass(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                             const std::function<void(int frame)>& on_frame, const std::atomic<bool>& stop) {
  std::vector<MethodMeter> methods;
  for (const Method& method : methods_of(group)) methods.emplace_back(config, method);
  std::vector<CaseMeter> cases;
  for (const CasePlan& case_plan : group.cases) cases.emplace_back(config, case_plan);

  std::vector<measure::PackingLossMeter> losses(config.compares_precisions() ? config.precisions.size() : 0);

  AccuracyResult result;
  GridOfFrames grids(config.grids[group.grid]);
  for (int index = 0; index < path.count(); ++index) {
    if (stop) return result;
    on_frame(index);
    const FrameAtHand now = look_at(config, path, grids, index);
    for (std::size_t i = 0; i < losses.size(); ++i) losses[i].add_frame(now.lights.packed(i));
    for (MethodMeter& method : methods) {
      method.add(now, grids.grid());
      for (CaseMeter& meter : cases)
        if (meter.method() == method.method()) meter.add(now, grids.grid(), method);
    }
  }
  for (const MethodMeter& method : methods) result.methods.push_back(method.result());
  for (const CaseMeter& meter : cases) result.structures.push_back(meter.result());
  for (const measure::PackingLossMeter& loss : losses) result.losses.push_back(loss.result());
  result.last_grid = grids.grid();
  result.is_complete = true;
  return result;
}

}  // namespace clusterbench::run
