#include "run/passes/method_meter.h"

namespace clusterbench::run {
namespace {

std::uint32_t real_cells(const grid::Grid& grid) {
  std::uint32_t count = 0;
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) count += grid.is_hole(cell) ? 0 : 1;
  return count;
}

std::vector<measure::SampleSet> sets_of(const config::Config& config) {
  std::vector<measure::SampleSet> sets;
  for (const config::SampleSetRequest& request : config.sample_sets) sets.push_back(request.set);
  return sets;
}

}  // namespace

MethodMeter::MethodMeter(const config::Config& config, const Method& method, const cull::PreCull& pre_cull,
                         std::uint32_t most_lights, ListsOverFrames over_frames, LightShadows* shadows, bool compares,
                         bool has_too_many_cells)
    : compares_(compares),
      order_(compares || over_frames == ListsOverFrames::compared || shadows != nullptr ? assign::ListOrder::ascending
                                                                                        : assign::ListOrder::any),
      threads_(config.threads),
      most_lights_(most_lights),
      shadows_(shadows),
      run_(config, method, pre_cull),
      instances_(std::make_unique<MethodInstances>(config, method, order_)) {
  measures_.method = method;
  if (shadows != nullptr && method.answer == assign::Answer::lists)
    for (const config::ShadowCullRequest& request : config.shadow_culls)
      shadow_culls_.emplace_back(request, shadow_culls_.size());
  measures_.has_cells = run_.has_cells() && (method.answer == assign::Answer::lists || !has_too_many_cells);
  if (!pre_cull.is_none()) cull_meter_.emplace(pre_cull, sets_of(config));
  if (over_frames == ListsOverFrames::compared && measures_.has_cells) list_changes_.emplace();
}

void MethodMeter::add(const PreparedFrame& now) {
  assign(now);
  if (measures_.has_cells) measure(now, run_.cell_lists(order_));
}

void MethodMeter::add(const PreparedFrame& now, const ListsOfFrame& lists) {
  measures_.tests_done += lists.tests_done;
  measures_.fallbacks += lists.fallbacks;
  measure(now, lists.cells());
  lists_ = nullptr;  // they may be gone by the next call
}

void MethodMeter::assign(const PreparedFrame& now) {
  grid_ = now.grid;
  const view::LightArrays& lights = now.lights.in_precision(measures_.method.precision);
  if (now.is_new_grid) run_.build(*grid_, assign::kinds_of(lights));
  run_.assign(now.frame, lights, now.depth.get());
  if (cull_meter_) cull_meter_->add_frame(*run_.cull(), now.frame, run_.cull_is_conservative(now.frame, lights));
  measures_.tests_done += run_.tests_done();
  measures_.fallbacks += run_.fallbacks();
}

void MethodMeter::measure(const PreparedFrame& now, const assign::Lists& lists) {
  const grid::Grid& grid = *now.grid;
  lists_ = &lists;
  measures_.has_grid_cells = !run_.has_occupied_cells();
  if (!occupancy_) occupancy_.emplace(0);
  if (now.is_new_grid) occupancy_->set_real_cells(run_.has_occupied_cells() ? lists_->cell_count() : real_cells(grid));
  occupancy_->add_frame(now.frame.index, *lists_);
  if (measures_.has_grid_cells) longest_by_slice_.add_frame(grid, *lists_);
  if (list_changes_) list_changes_->add(*lists_);
  if (compares_) compare(now, grid);
  for (ShadowCullMeter& cull : shadow_culls_)
    cull.add(*shadows_, now.frame, grid, *lists_, now.has_truth ? &now.truth.lists : nullptr);
}

void MethodMeter::compare(const PreparedFrame& now, const grid::Grid& grid) {
  if (!run_.has_occupied_cells()) {
    if (cull_meter_) cull_meter_->add_truth(now.truth.lists);
    return measure::add_frame(measures_.error, now.frame, grid, now.truth, *lists_);
  }
  const grid::OccupiedCells cells = run_.own_structure()->occupied_cells();
  const measure::Truth truth = measure::find_truth(now.frame, grid, cells, threads_);
  if (cull_meter_) cull_meter_->add_truth(truth.lists);
  measure::add_frame(measures_.error, now.frame, cells, truth, *lists_);
}

void MethodMeter::add_lit_samples(const grid::Grid& grid, std::span<const grid::Sample> samples,
                                  const measure::NeededLights& needed, const std::vector<std::vector<bool>>& is_lit) {
  for (std::size_t i = 0; i < shadow_culls_.size(); ++i) shadow_culls_[i].add_samples(grid, samples, needed, is_lit[i]);
}

void MethodMeter::add_needed(std::size_t set, const measure::NeededLights& needed) {
  if (cull_meter_) cull_meter_->add_samples(set, needed.lists);
}

MethodMeasures MethodMeter::result() const {
  MethodMeasures out = measures_;
  if (occupancy_) out.occupancy = occupancy_->result();
  out.occupancy.longest_by_slice = longest_by_slice_.result();
  if (list_changes_) out.list_changes = list_changes_->result();
  if (cull_meter_) out.pre_cull = cull_meter_->result();
  for (const ShadowCullMeter& cull : shadow_culls_) out.shadow_culls.push_back(cull.result(*shadows_));
  return out;
}

}  // namespace clusterbench::run
