#include "search/frame_measure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "measure/lists/lights_in_view_counts.h"
#include "measure/lists/occupancy.h"
#include "result/figures/case_figure.h"

namespace clusterbench::search {
namespace {

const config::SampleSetRequest* volume_set(const config::Config& config) {
  const auto found = std::ranges::find(config.sample_sets, measure::SampleSet::volume, &config::SampleSetRequest::set);
  return found == config.sample_sets.end() ? nullptr : &*found;
}

std::unique_ptr<assign::Storage> storage_of(const config::Config& config, const run::CasePlan& plan) {
  if (!plan.storage) return nullptr;
  const config::MethodRequest& request = config.storages[*plan.storage];
  return assign::find_storage(request.name)->make(request.params);
}

// Without visible sets, which depend on a path's eyes.
std::unique_ptr<const cull::PreCull> pre_cull_of(const config::Config& config, const run::CasePlan& plan) {
  const cull::PreCullSpec& spec = config.pre_culls[plan.pre_cull];
  if (spec.needs_triangles())
    throw Error("", "pre_cull", "visible_set: its sets are those of a path's eyes, and this looks at eyes elsewhere");
  return std::make_unique<const cull::PreCull>(spec, std::vector<std::shared_ptr<const cull::VisibleSets>>{});
}

std::uint32_t longest_of(const assign::Lists& lists) {
  std::uint32_t longest = 0;
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
    longest = std::max(longest, lists.begin[cell + 1] - lists.begin[cell]);
  return longest;
}

// Includes entries that a full pool leaves out, or that are read from a list of all lights: of two such frames the
// fuller one is worse.
double entries_with_room(const assign::LightStructure& structure) {
  const assign::StructureUse use = structure.use();
  if (use.fallback_cells > 0) return static_cast<double>(structure.buffers().front().elements);
  return static_cast<double>(use.index_entries + use.dropped_pairs);
}

}  // namespace

std::string MeasureRow::unit() const {
  return *own_unit != '\0' ? own_unit : std::string(result::figure_named(figure)->unit);
}

std::span<const MeasureRow> measure_rows() {
  static constexpr std::array<MeasureRow, 7> k_rows{{
      {.measure = Measure::entries,
       .name = "entries",
       .figure = "index_entries",
       .pointer = "buffers.index_entries.high_water",
       .meaning = "index entries of the lists, with room for all of them"},
      {.measure = Measure::longest,
       .name = "longest",
       .figure = "longest",
       .pointer = "occupancy.lights_per_cell.max",
       .meaning = "lights in the longest list"},
      {.measure = Measure::p99,
       .name = "p99",
       .figure = "lights_per_cell.p99",
       .pointer = "occupancy.lights_per_cell.p99",
       .meaning = "list length that 99 % of the cells do not exceed"},
      {.measure = Measure::evaluated,
       .name = "evaluated",
       .figure = "volume.evaluated",
       .pointer = "shading.evaluated / shading.samples",
       .meaning = "lights that a random point in the view is given, mean",
       .own_unit = "lights per sample"},
      {.measure = Measure::tests,
       .name = "tests",
       .figure = "tests_done",
       .pointer = "tests_done",
       .meaning = "tests of a light against a cell, a row of cells or a plane"},
      {.measure = Measure::lights,
       .name = "lights",
       .figure = "lights_in_view",
       .pointer = "lights_in_view.max",
       .meaning = "lights in view, whatever the method"},
      {.measure = Measure::lights_of_type,
       .name = "lights-of-type",
       .figure = "",
       .pointer = "the largest of lights_in_view.max_by_type",
       .meaning = "lights in view of the type that has most of them",
       .own_unit = "lights"},
  }};
  return k_rows;
}

const MeasureRow& row_of(Measure measure) {
  return measure_rows()[static_cast<std::size_t>(measure)];
}

FrameMeter::FrameMeter(const config::Config& config, const run::CasePlan& plan, Measure measure)
    : config_(config),
      measure_(measure),
      spec_(config.grids[plan.grid]),
      precision_{config.precisions[plan.precision]},
      pre_cull_(pre_cull_of(config, plan)),
      run_(config, plan.method(), *pre_cull_),
      storage_(storage_of(config, plan)) {
  if ((measure == Measure::longest || measure == Measure::p99) && !run_.has_cells())
    throw Error("", "--measure", std::string(row_of(measure).name) + ": " + plan.name + " has no cells");
  if (measure == Measure::evaluated && volume_set(config) == nullptr)
    throw Error("", "--measure", "evaluated needs samples in the view, and shading.samples is 0");
}

// Each frame has a path of its own here, and so another extent of lights, which only a few grids follow.
bool FrameMeter::update_grid(const run::PathFrames& path, const view::Frame& frame) {
  grid::GridInputs inputs = path.inputs(spec_, frame);
  const bool has_far = spec_.slices.far_m != 0.0 || std::isfinite(frame.projection.far_m);
  if (has_far && spec_.slices.scheme != grid::Scheme::fit) inputs.light_far_m = 0.0;
  if (grid_ && inputs == inputs_) return false;
  grid_ = grid::make_grid(spec_, inputs);
  inputs_ = inputs;
  return true;
}

double FrameMeter::lights_in_view(const view::Frame& frame) {
  measure::LightsInView counts;
  measure::add_frame(counts, frame);
  const view::LightRanges ranges = frame.ranges();
  if (measure_ == Measure::lights) {
    lights_ = ranges.size();
    return static_cast<double>(counts.most);
  }
  lights_ = std::ranges::max(ranges.types(), {}, &view::LightRange::count).count;
  return static_cast<double>(std::ranges::max(counts.most_of_type));
}

double FrameMeter::value(const run::PathFrames& path, int index) {
  const view::Frame frame = path.frame(index);
  if (measure_ == Measure::lights || measure_ == Measure::lights_of_type) return lights_in_view(frame);
  const bool is_new_grid = update_grid(path, frame);
  const grid::Grid& grid = *grid_;
  const run::FrameLights lights(precision_, view::lights_in(frame, grid::space_of(grid, frame)));
  const view::LightArrays& packed = lights.in_precision(0);
  if (is_new_grid) run_.build(grid, assign::kinds_of(packed));
  run_.assign(frame, packed, nullptr);
  const cull::FrameCull* culled = run_.cull();
  lights_ = culled == nullptr ? frame.ranges().size() : culled->lights.size();
  if (storage_ && (is_new_grid || culled != nullptr))
    storage_->start(grid, culled == nullptr ? frame.ranges() : view::LightRanges(0, lights_));
  if (storage_) run_.store(*storage_);
  if (is_new_grid && measure_ == Measure::p99) {
    real_cells_ = 0;
    for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) real_cells_ += grid.is_hole(cell) ? 0 : 1;
  }
  switch (measure_) {
    case Measure::entries:
      return entries_with_room(structure());
    case Measure::longest:
      return longest_of(run_.cell_lists());
    case Measure::p99: {
      measure::OccupancyMeter occupancy(real_cells_);
      occupancy.add_frame(0, run_.cell_lists());
      return occupancy.result().lights_per_cell.p99;
    }
    case Measure::evaluated:
      return evaluated_at_samples(path, frame);
    case Measure::tests:
    case Measure::lights:
    case Measure::lights_of_type:
      break;
  }
  return static_cast<double>(run_.tests_done());
}

double FrameMeter::evaluated_at_samples(const run::PathFrames& path, const view::Frame& frame) {
  const std::vector<grid::Sample> samples =
      measure::volume_samples(frame, run::sample_far(frame, path.far_m()), volume_set(config_)->count, config_.seed);
  std::uint64_t evaluated = 0;
  for (const grid::Sample& sample : samples) {
    structure().lights_at(sample, grid::Log2::rounded, given_);
    evaluated += given_.size();
  }
  return samples.empty() ? 0.0 : static_cast<double>(evaluated) / static_cast<double>(samples.size());
}

std::optional<double> FrameMeter::theoretical_max() const {
  if (measure_ == Measure::tests) return std::nullopt;
  if (measure_ == Measure::entries) {
    const auto most = static_cast<double>(structure().limit().index_entries);
    return entries_with_room(structure()) <= most ? most : static_cast<double>(structure().buffers().front().most);
  }
  return static_cast<double>(lights_);
}

void fix_grid(config::Config& config, const run::Plan& plan, const run::CasePlan& case_plan) {
  grid::GridSpec& spec = config.grids[case_plan.grid];
  const run::PathFrames recorded =
      run::path_of(config, plan.scenes[case_plan.scene], case_plan.camera, case_plan.viewport);
  const bool has_slices = spec.kind == grid::Kind::frustum || spec.kind == grid::Kind::distance;
  const bool is_endless = spec.slices.ends_with_lights(recorded.camera_path().shots.front().projection.far_m);
  if (has_slices && spec.slices.scheme != grid::Scheme::fit && is_endless) spec.slices.far_m = recorded.far_m();
  if (spec.kind != grid::Kind::world || spec.has_bounds || spec.follow == grid::Follow::lights) return;
  const auto [lo, hi] = recorded.light_bounds();
  if (!(lo.x < hi.x && lo.y < hi.y && lo.z < hi.z)) return;
  spec.has_bounds = true;
  spec.bounds_lo_m = lo;
  spec.bounds_hi_m = hi;
}

std::vector<double> values_along(const config::Config& config, const run::CasePlan& plan, Measure measure,
                                 const run::PathFrames& path, const std::function<void()>& on_frame) {
  FrameMeter meter(config, plan, measure);
  std::vector<double> values;
  for (int frame = 0; frame < path.count(); ++frame) {
    values.push_back(meter.value(path, frame));
    if (on_frame) on_frame();
  }
  return values;
}

}  // namespace clusterbench::search
