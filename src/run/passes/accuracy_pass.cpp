#include "run/passes/accuracy_pass.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include "assign/contract/storage.h"
#include "run/cases/frame_lights.h"
#include "run/cases/frame_samples.h"
#include "run/cases/impossible_cases.h"
#include "run/cases/path_culls.h"
#include "run/findings/light_shadows.h"

namespace clusterbench::run {
namespace {

std::uint32_t real_cells(const grid::Grid& grid) {
  std::uint32_t count = 0;
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) count += grid.is_hole(cell) ? 0 : 1;
  return count;
}

// One frame, shared by all methods of the group.
struct PreparedFrame {
  view::Frame frame;
  bool is_new_grid = false;
  FrameLights lights;
  std::shared_ptr<const depth::DepthImage> depth;  // if a method needs it
  bool has_truth = false;
  measure::Truth truth;                 // of the grid's cells, if something is compared with it
  std::vector<FrameSampleSet> samples;  // one per set of the configuration
  std::optional<measure::LookupFrame> lookup;
};

class MethodMeter {
 public:
  // `shadows`: null if no shadow cull is requested. `compares`: compare cells with the truth. If the cells are too many
  // for that, a structure of the method's own is not expanded to lists either.
  MethodMeter(const config::Config& config, const Method& method, const cull::PreCull& pre_cull,
              std::uint32_t most_lights, ListsOverFrames over_frames, LightShadows* shadows, bool compares,
              bool has_too_many_cells)
      : compares_(compares),
        threads_(config.threads),
        most_lights_(most_lights),
        shadows_(shadows),
        run_(config, method, pre_cull) {
    measures_.method = method;
    if (shadows != nullptr && method.answer == assign::Answer::lists)
      for (const config::ShadowCullRequest& request : config.shadow_culls)
        shadow_culls_.emplace_back(request, shadow_culls_.size());
    measures_.has_cells = run_.has_cells() && (method.answer == assign::Answer::lists || !has_too_many_cells);
    if (!pre_cull.is_none()) cull_meter_.emplace(pre_cull, sets_of(config));
    if (over_frames == ListsOverFrames::compared && measures_.has_cells) list_changes_.emplace();
  }

  void add(const PreparedFrame& now, const grid::Grid& grid) {
    const view::LightArrays& lights = now.lights.in_precision(measures_.method.precision);
    if (now.is_new_grid) run_.build(grid, assign::kinds_of(lights));
    run_.assign(now.frame, lights, now.depth.get());
    if (cull_meter_) cull_meter_->add_frame(*run_.cull(), now.frame, run_.cull_is_conservative(now.frame, lights));
    measures_.tests_done += run_.tests_done();
    measures_.fallbacks += run_.fallbacks();
    if (!measures_.has_cells) return;
    lists_ = &run_.cell_lists();
    measures_.has_grid_cells = !run_.has_occupied_cells();
    if (!occupancy_) occupancy_.emplace(0);
    if (now.is_new_grid)
      occupancy_->set_real_cells(run_.has_occupied_cells() ? lists_->cell_count() : real_cells(grid));
    occupancy_->add_frame(now.frame.index, *lists_);
    if (measures_.has_grid_cells) longest_by_slice_.add_frame(grid, *lists_);
    if (list_changes_) list_changes_->add(*lists_);
    if (compares_) compare(now, grid);
    for (ShadowCullMeter& cull : shadow_culls_)
      cull.add(*shadows_, now.frame, grid, *lists_, now.has_truth ? &now.truth.lists : nullptr);
  }
  // Evaluates some samples of visible surfaces; `is_lit`: one row per way to remove lights in shadow.
  void add_lit_samples(const grid::Grid& grid, std::span<const grid::Sample> samples,
                       const measure::NeededLights& needed, const std::vector<std::vector<bool>>& is_lit) {
    for (std::size_t i = 0; i < shadow_culls_.size(); ++i)
      shadow_culls_[i].add_samples(grid, samples, needed, is_lit[i]);
  }

  // Whether its lists are compared with the truth of the grid's cells; not if the method has cells of its own.
  bool needs_grid_truth() const { return compares_ && measures_.has_cells && !run_.has_occupied_cells(); }

  const CulledRun& run() const { return run_; }
  // The ranges of light numbers for which a storage of its lists has room.
  view::LightRanges light_room(const view::Frame& frame) const {
    return run_.cull() == nullptr ? frame.ranges() : view::LightRanges(0, most_lights_);
  }
  void add_needed(std::size_t set, const measure::NeededLights& needed) {
    if (cull_meter_) cull_meter_->add_samples(set, needed.lists);
  }
  const assign::Lists* cell_lists() const { return lists_; }
  const Method& method() const { return measures_.method; }

  MethodMeasures result() const {
    MethodMeasures out = measures_;
    if (occupancy_) out.occupancy = occupancy_->result();
    out.occupancy.longest_by_slice = longest_by_slice_.result();
    if (list_changes_) out.list_changes = list_changes_->result();
    if (cull_meter_) out.pre_cull = cull_meter_->result();
    for (const ShadowCullMeter& cull : shadow_culls_) out.shadow_culls.push_back(cull.result(*shadows_));
    return out;
  }

 private:
  void compare(const PreparedFrame& now, const grid::Grid& grid) {
    if (!run_.has_occupied_cells()) {
      if (cull_meter_) cull_meter_->add_truth(now.truth.lists);
      return measure::add_frame(measures_.error, now.frame, grid, now.truth, *lists_);
    }
    const grid::OccupiedCells cells = run_.own_structure()->occupied_cells();
    const measure::Truth truth = measure::find_truth(now.frame, grid, cells, threads_);
    if (cull_meter_) cull_meter_->add_truth(truth.lists);
    measure::add_frame(measures_.error, now.frame, cells, truth, *lists_);
  }

  static std::vector<measure::SampleSet> sets_of(const config::Config& config) {
    std::vector<measure::SampleSet> sets;
    for (const config::SampleSetRequest& request : config.sample_sets) sets.push_back(request.set);
    return sets;
  }

  bool compares_;
  int threads_;
  std::uint32_t most_lights_;  // most lights of a frame that the method gets
  LightShadows* shadows_;
  CulledRun run_;
  std::optional<PreCullMeter> cull_meter_;
  std::vector<ShadowCullMeter> shadow_culls_;  // one per way, for lists only
  const assign::Lists* lists_ = nullptr;       // of the cells, in the current frame
  std::optional<measure::OccupancyMeter> occupancy_;
  measure::LongestBySlice longest_by_slice_;
  std::optional<ListChangeMeter> list_changes_;
  MethodMeasures measures_;
};

// One light structure over the frames: its buffers and its lights at samples.
class StructureMeter {
 public:
  explicit StructureMeter(const config::Config& config) : buffers_(config.allocation) {
    for (const config::SampleSetRequest& request : config.sample_sets)
      measures_.samples.push_back({request.set, {}, {}});
  }

  void add(int frame, const assign::LightStructure& made, const MethodMeter& method) {
    mapped_ = method.run().mapped(made);
    const assign::LightStructure& structure = mapped_ ? static_cast<const assign::LightStructure&>(*mapped_) : made;
    buffers_.add_frame(frame, structure, method.cell_lists(), method.run().scratch_bytes());
    structure_ = &structure;
  }
  void add_lookup(const measure::LookupFrame& lookup) { lookup.add(*structure_, measures_.lookup); }
  // Evaluates some samples of a set with the lights that they need.
  void add_samples(std::size_t set, int frame, std::span<const grid::Sample> samples,
                   const measure::NeededLights& needed) {
    measure::add_samples(measures_.samples[set].counts, frame, samples, needed, *structure_);
  }
  void add_waves(std::size_t set, const FrameSampleSet& samples) {
    std::optional<measure::Coherence>& coherence = measures_.samples[set].coherence;
    if (!coherence) coherence.emplace();
    measure::add_frame(*coherence, *samples.picture, samples.samples, *structure_);
  }

  StructureMeasures result() const {
    StructureMeasures out = measures_;
    out.buffers = buffers_.result();
    return out;
  }

 private:
  std::optional<assign::MappedStructure> mapped_;      // behind a pre-cull: of the current frame
  const assign::LightStructure* structure_ = nullptr;  // of the current frame
  measure::BufferMeter buffers_;
  StructureMeasures measures_;
};

class CaseMeter {
 public:
  CaseMeter(const config::Config& config, const CasePlan& plan)
      : method_(plan.method()),
        evaluates_lookup_(!assign::find_assigner(config.assigners[plan.assigner].name)->at_surfaces),
        meter_(config) {
    if (!plan.storage) return;
    const config::MethodRequest& request = config.storages[*plan.storage];
    const assign::StorageDescriptor& descriptor = *assign::find_storage(request.name);
    storage_ = descriptor.make(request.params);
    const std::optional<assign::Params> roomy = assign::without_fallback(descriptor, request.params);
    if (!roomy) return;
    roomy_storage_ = descriptor.make(*roomy);
    roomy_meter_.emplace(config);
  }

  void add(const PreparedFrame& now, const grid::Grid& grid, const MethodMeter& method) {
    for (assign::Storage* storage : {storage_.get(), roomy_storage_.get()}) {
      if (storage == nullptr) continue;
      if (now.is_new_grid) storage->start(grid, method.light_room(now.frame));
      method.run().store(*storage);
    }
    const assign::LightStructure& structure = storage_ ? *storage_ : *method.run().own_structure();
    meter_.add(now.frame.index, structure, method);
    if (roomy_storage_) roomy_meter_->add(now.frame.index, *roomy_storage_, method);
    if (now.lookup && evaluates_lookup_ && !structure.has_occupied_cells()) meter_.add_lookup(*now.lookup);
  }

  void add_samples(std::size_t set, int frame, std::span<const grid::Sample> samples,
                   const measure::NeededLights& needed) {
    meter_.add_samples(set, frame, samples, needed);
    if (roomy_meter_) roomy_meter_->add_samples(set, frame, samples, needed);
  }
  void add_waves(std::size_t set, const FrameSampleSet& samples) { meter_.add_waves(set, samples); }

  const Method& method() const { return method_; }
  StructureMeasures result() const {
    StructureMeasures out = meter_.result();
    if (roomy_meter_) out.roomy = std::make_shared<StructureMeasures>(roomy_meter_->result());
    return out;
  }

 private:
  Method method_;
  bool evaluates_lookup_;                     // its samples are anywhere in the view
  std::unique_ptr<assign::Storage> storage_;  // none: the method's own structure
  StructureMeter meter_;
  // For comparison with a storage that can run out of room.
  std::unique_ptr<assign::Storage> roomy_storage_;
  std::optional<StructureMeter> roomy_meter_;
};

// Needed lights are stored for this many samples at a time: those of a full-resolution image would not fit in memory.
constexpr std::size_t k_samples_at_once = 16384;

void evaluate_samples(const PreparedFrame& now, std::vector<MethodMeter>& methods, std::vector<CaseMeter>& cases,
                      const std::atomic<bool>& stop) {
  for (std::size_t set = 0; set < now.samples.size(); ++set) {
    const std::span<const grid::Sample> all = now.samples[set].samples;
    for (std::size_t begin = 0; begin < all.size(); begin += k_samples_at_once) {
      const std::span<const grid::Sample> some = all.subspan(begin, std::min(k_samples_at_once, all.size() - begin));
      const measure::NeededLights needed = measure::needed_lights(now.frame, some);
      for (MethodMeter& method : methods) method.add_needed(set, needed);
      for (CaseMeter& meter : cases) {
        if (stop) return;
        meter.add_samples(set, now.frame.index, some, needed);
      }
    }
    const std::optional<depth::DepthImage>& picture = now.samples[set].picture;
    if (!picture || !picture->pixels.is_full_resolution()) continue;  // waves are made of neighbouring pixels
    for (CaseMeter& meter : cases) {
      if (stop) return;
      meter.add_waves(set, now.samples[set]);
    }
  }
}

// Finds by true shadow rays which of the needed lights are lit.
void evaluate_lit_samples(const config::Config& config, const PreparedFrame& now, const grid::Grid& grid,
                          const LightShadows& shadows, std::vector<MethodMeter>& methods,
                          const std::atomic<bool>& stop) {
  for (std::size_t set = 0; set < now.samples.size(); ++set) {
    if (config.sample_sets[set].set != measure::SampleSet::opaque) continue;
    const std::span<const grid::Sample> all = now.samples[set].samples;
    for (std::size_t begin = 0; begin < all.size() && !stop; begin += k_samples_at_once) {
      const std::span<const grid::Sample> some = all.subspan(begin, std::min(k_samples_at_once, all.size() - begin));
      const measure::NeededLights needed = measure::needed_lights(now.frame, some);
      const std::vector<std::vector<bool>> is_lit = shadows.lit(some, needed);
      for (MethodMeter& method : methods) method.add_lit_samples(grid, some, needed, is_lit);
    }
  }
}

void add_depth_ranges(const PreparedFrame& now, const grid::ScreenGrid& grid, AccuracyResult& result) {
  for (const FrameSampleSet& set : now.samples) {
    if (!set.picture) continue;
    if (!result.depth_ranges) result.depth_ranges.emplace();
    measure::add_frame(*result.depth_ranges, *set.picture, set.samples, grid);
  }
}

measure::SharingLimits sharing_limits(const config::SharedFrustaRequest& request) {
  return {request.apart_m, glm::radians(request.turned_deg), request.growth};
}

PreparedFrame prepare(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                      FrameSamples& samples, GridOfFrames& grids, int index, bool needs_truth) {
  PreparedFrame now;
  now.frame = path.frame(index);
  now.is_new_grid = grids.update(path, now.frame);
  const grid::Grid& grid = grids.grid();
  now.lights = FrameLights(config.precisions, view::lights_in(now.frame, grid::space_of(grid, now.frame)));
  now.depth = depths_for(config, group, path, now.frame);
  now.has_truth = needs_truth;
  if (needs_truth) now.truth = measure::find_truth(now.frame, grid, config.threads);
  const double far = sample_far(now.frame, path.far_m());
  if (config.lookup)
    now.lookup.emplace(now.frame, grid, config.lookup->ways(), far, config.lookup->samples, config.seed);
  now.samples = samples.of(now.frame);
  return now;
}

}  // namespace

CaseSide structure_side(const StructureMeasures& measures) {
  CaseSide side;
  side.index_entries = measures.buffers.index_entries.high_water;
  side.bytes = measures.buffers.bytes.high_water;
  for (const SampleSetResult& set : measures.samples)
    if (set.counts.samples > 0)
      side.evaluated.push_back({measure::name_of(set.set), set.counts.evaluated, set.counts.missed});
  return side;
}

AccuracyResult accuracy_pass(const config::Config& config, const SceneData& data, const GroupPlan& group,
                             const PathFrames& path, const std::function<void(int frame)>& on_frame,
                             const std::atomic<bool>& stop, ListsOverFrames over_frames) {
  std::optional<LightShadows> shadows;
  if (!config.shadow_culls.empty() && shadow_obstacle(data).empty()) shadows.emplace(config, data, path);
  const GroupCulls culls(config, group, path);
  const bool compares = compares_cells(config, group),
             has_too_many_cells = !group.cases.empty() && group.cases.front().cells_not_compared > 0;
  std::vector<MethodMeter> methods;
  for (const Method& method : culls.methods)
    methods.emplace_back(config, method, culls.path.of(method), culls.max_lights_of(method), over_frames,
                         shadows ? &*shadows : nullptr, compares, has_too_many_cells);
  const bool needs_truth = std::ranges::any_of(methods, &MethodMeter::needs_grid_truth);
  std::vector<CaseMeter> cases;
  for (const CasePlan& case_plan : group.cases) cases.emplace_back(config, case_plan);

  std::vector<measure::PackingLossMeter> losses(config.compares_precisions() ? config.precisions.size() : 0);

  AccuracyResult result;
  if (config.shared_frusta) result.sharing.emplace();
  FrameSamples samples(config, data, path);
  const grid::GridSpec& spec = config.grids[group.grid];
  GridOfFrames grids(spec);
  std::optional<GridMoveMeter> moves;
  if (spec.has_tiles() && spec.slices.fit)
    moves.emplace(spec.slices.scheme == grid::Scheme::exponential_first ? std::size_t{1} : std::size_t{0});
  for (int index = 0; index < path.count(); ++index) {
    if (stop) return result;
    on_frame(index);
    const PreparedFrame now = prepare(config, group, path, samples, grids, index, needs_truth);
    measure::add_frame(result.lights_in_view, now.frame);
    measure::add_frame(result.lights_beyond_grid, now.frame, grids.grid());
    if (moves) moves->add(grids.grid().screen(), path.spans(spec)[static_cast<std::size_t>(index)]);
    for (std::size_t i = 0; i < losses.size(); ++i) losses[i].add_frame(now.lights.packed(i));
    if (shadows) shadows->start(now.frame);
    if (result.sharing) measure::add_frame(*result.sharing, now.frame, sharing_limits(*config.shared_frusta));
    for (MethodMeter& method : methods) {
      if (stop) return result;
      method.add(now, grids.grid());
      for (CaseMeter& meter : cases)
        if (meter.method() == method.method()) meter.add(now, grids.grid(), method);
    }
    evaluate_samples(now, methods, cases, stop);
    if (shadows) evaluate_lit_samples(config, now, grids.grid(), *shadows, methods, stop);
    if (stop) return result;
    if (grids.grid().kind() == grid::Kind::frustum) add_depth_ranges(now, grids.grid().screen(), result);
  }
  for (const MethodMeter& method : methods) result.methods.push_back(method.result());
  for (const CaseMeter& meter : cases) result.structures.push_back(meter.result());
  for (const measure::PackingLossMeter& loss : losses) result.losses.push_back(loss.result());
  if (moves) result.moves = moves->result();
  result.last_grid = grids.grid();
  result.is_complete = true;
  return result;
}

}  // namespace clusterbench::run
