#include "run/passes/accuracy_pass.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "assign/contract/storage.h"
#include "run/cases/frame_lights.h"
#include "run/cases/frame_samples.h"
#include "run/cases/impossible_cases.h"
#include "run/cases/path_culls.h"
#include "run/findings/light_shadows.h"
#include "run/passes/frame_pipeline.h"

namespace clusterbench::run {
namespace {

std::uint32_t real_cells(const grid::Grid& grid) {
  std::uint32_t count = 0;
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) count += grid.is_hole(cell) ? 0 : 1;
  return count;
}

// One frame, shared by all methods of the group.
struct PreparedFrame {
  int at = 0;  // its place among the frames of the pass
  view::Frame frame;
  std::shared_ptr<const grid::Grid> grid;
  bool is_new_grid = false;
  FrameLights lights;
  std::shared_ptr<const depth::DepthImage> depth;  // if a method needs it
  bool has_truth = false;
  measure::Truth truth;                 // of the grid's cells, if something is compared with it
  std::vector<FrameSampleSet> samples;  // one per set of the configuration
  // The lights that parts of the samples need, per set; none for frames with many samples (has_many_samples()).
  std::vector<std::vector<measure::NeededLights>> needed;
  std::optional<measure::LookupFrame> lookup;

  std::size_t bytes() const;
};

std::size_t bytes_of(const assign::Lists& lists) {
  return lists.begin.size() * sizeof(lists.begin[0]) + lists.lights.size() * sizeof(lists.lights[0]);
}

std::size_t bytes_of(const FrameSampleSet& set) {
  return set.samples.size() * sizeof(grid::Sample) + (set.picture ? set.picture->nearest.size() * sizeof(float) : 0);
}

// Of the parts that grow with cells, lights and samples.
std::size_t PreparedFrame::bytes() const {
  std::size_t sum = bytes_of(truth.lists) + frame.lights.size() * 2 * sizeof(scene::WorldLight);
  if (depth) sum += depth->nearest.size() * sizeof(float);
  for (const FrameSampleSet& set : samples) sum += bytes_of(set);
  for (const std::vector<measure::NeededLights>& set : needed)
    for (const measure::NeededLights& part : set) sum += bytes_of(part.lists) + part.lux.size() * sizeof(double);
  return sum;
}

// A method's lists of one frame, copied for those that use them while the method is at the next frame.
struct ListsOfFrame {
  assign::Lists filled;                    // as the method filled them
  std::optional<assign::Lists> ascending;  // if those are not
  std::size_t scratch_bytes = 0;

  const assign::Lists& cells() const { return ascending ? *ascending : filled; }
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

  void add(const PreparedFrame& now) {
    assign(now);
    if (measures_.has_cells) measure(now, run_.cell_lists());
  }
  void assign(const PreparedFrame& now) {
    grid_ = now.grid;
    const view::LightArrays& lights = now.lights.in_precision(measures_.method.precision);
    if (now.is_new_grid) run_.build(*grid_, assign::kinds_of(lights));
    run_.assign(now.frame, lights, now.depth.get());
    if (cull_meter_) cull_meter_->add_frame(*run_.cull(), now.frame, run_.cull_is_conservative(now.frame, lights));
    measures_.tests_done += run_.tests_done();
    measures_.fallbacks += run_.fallbacks();
  }
  // Whether the lists are all that cases and measures need of the method.
  bool is_done_with_lists() const { return run_.filled_lists() != nullptr && run_.cull() == nullptr; }
  void copy_lists(ListsOfFrame& out) const {
    const assign::Lists& filled = *run_.filled_lists();
    out.filled = filled;
    out.ascending.reset();
    if (const assign::Lists& cells = run_.cell_lists(); &cells != &filled) out.ascending = cells;
    out.scratch_bytes = run_.scratch_bytes();
  }
  // `lists`: of the cells; they must stay until the next call.
  void measure(const PreparedFrame& now, const assign::Lists& lists) {
    const grid::Grid& grid = *now.grid;
    lists_ = &lists;
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
  std::shared_ptr<const grid::Grid> grid_;  // for which the method is built
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
    add(frame, mapped_ ? static_cast<const assign::LightStructure&>(*mapped_) : made, method.cell_lists(),
        method.run().scratch_bytes());
  }
  // `lists`: of the cells; null without cells.
  void add(int frame, const assign::LightStructure& structure, const assign::Lists* lists, std::size_t scratch_bytes) {
    buffers_.add_frame(frame, structure, lists, scratch_bytes);
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

  void add(const PreparedFrame& now, const MethodMeter& method) {
    for (assign::Storage* storage : {storage_.get(), roomy_storage_.get()}) {
      if (storage == nullptr) continue;
      if (now.is_new_grid) storage->start(*now.grid, method.light_room(now.frame));
      method.run().store(*storage);
    }
    const assign::LightStructure& structure = storage_ ? *storage_ : *method.run().own_structure();
    meter_.add(now.frame.index, structure, method);
    if (roomy_storage_) roomy_meter_->add(now.frame.index, *roomy_storage_, method);
    if (now.lookup && evaluates_lookup_ && !structure.has_occupied_cells()) meter_.add_lookup(*now.lookup);
  }
  // The same with a copy of the lists, without the method.
  void add(const PreparedFrame& now, const ListsOfFrame& lists) {
    add(now, lists, *storage_, meter_);
    if (roomy_storage_) add(now, lists, *roomy_storage_, *roomy_meter_);
    if (now.lookup && evaluates_lookup_) meter_.add_lookup(*now.lookup);
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
  static void add(const PreparedFrame& now, const ListsOfFrame& lists, assign::Storage& storage,
                  StructureMeter& meter) {
    if (now.is_new_grid) storage.start(*now.grid, now.frame.ranges());
    storage.store(lists.filled);
    meter.add(now.frame.index, storage, &lists.cells(), lists.scratch_bytes);
  }

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

std::size_t part_count(std::span<const grid::Sample> samples) {
  return (samples.size() + k_samples_at_once - 1) / k_samples_at_once;
}
std::span<const grid::Sample> part_of(std::span<const grid::Sample> samples, std::size_t part) {
  const std::size_t begin = part * k_samples_at_once;
  return samples.subspan(begin, std::min(k_samples_at_once, samples.size() - begin));
}

// Samples whose needed lights are known, for one case.
void add_samples(CaseMeter& meter, const PreparedFrame& now, std::size_t set, std::size_t part,
                 const measure::NeededLights& needed) {
  meter.add_samples(set, now.frame.index, part_of(now.samples[set].samples, part), needed);
}
// Waves are made of neighbouring pixels.
void add_waves(CaseMeter& meter, const PreparedFrame& now, std::size_t set) {
  const std::optional<depth::DepthImage>& picture = now.samples[set].picture;
  if (picture && picture->pixels.is_full_resolution()) meter.add_waves(set, now.samples[set]);
}
void add_known_samples(CaseMeter& meter, const PreparedFrame& now, const Stop& stop) {
  for (std::size_t set = 0; set < now.needed.size() && !stop; ++set) {
    for (std::size_t part = 0; part < now.needed[set].size() && !stop; ++part)
      add_samples(meter, now, set, part, now.needed[set][part]);
    add_waves(meter, now, set);
  }
}

// A method and its cases, which have nothing in common with other methods.
class MethodWork {
 public:
  using User = FrameUser<PreparedFrame>;

  MethodWork(MethodMeter& method, std::vector<CaseMeter>& cases) : method_(method) {
    for (CaseMeter& meter : cases)
      if (meter.method() == method.method()) cases_.push_back(&meter);
  }

  // One user for all; or the method, and behind it its measures and each of its cases, if these need its lists alone.
  void add_users(std::vector<User>& users, bool shares, const Stop& stop) {
    if (!shares || !method_.is_done_with_lists())
      return users.push_back({[this, stop](const PreparedFrame& now) { add(now, stop); }});
    const std::size_t leader = users.size();
    users.push_back({[this](const PreparedFrame& now) {
      method_.assign(now);
      method_.copy_lists(lists_of(now));
    }});
    users.push_back({[this](const PreparedFrame& now) { method_.measure(now, lists_of(now).cells()); }, leader});
    for (CaseMeter* meter : cases_)
      users.push_back({[this, meter, stop](const PreparedFrame& now) {
                         meter->add(now, lists_of(now));
                         add_known_samples(*meter, now, stop);
                       },
                       leader});
  }

  // For frames with many samples.
  void add_samples(const PreparedFrame& now, std::size_t set, std::size_t part, const measure::NeededLights& needed,
                   const Stop& stop) const {
    method_.add_needed(set, needed);
    for (CaseMeter* meter : cases_)
      if (!stop) run::add_samples(*meter, now, set, part, needed);
  }
  void add_waves(const PreparedFrame& now, std::size_t set, const Stop& stop) const {
    for (CaseMeter* meter : cases_)
      if (!stop) run::add_waves(*meter, now, set);
  }

 private:
  void add(const PreparedFrame& now, const Stop& stop) const {
    method_.add(now);
    for (const std::vector<measure::NeededLights>& set : now.needed)
      for (const measure::NeededLights& part : set)
        method_.add_needed(static_cast<std::size_t>(&set - now.needed.data()), part);
    for (CaseMeter* meter : cases_) {
      if (stop) return;
      meter->add(now, method_);
      add_known_samples(*meter, now, stop);
    }
  }
  // The method is at most two frames ahead of its cases.
  ListsOfFrame& lists_of(const PreparedFrame& now) { return lists_[static_cast<std::size_t>(now.at) % lists_.size()]; }

  MethodMeter& method_;
  std::vector<CaseMeter*> cases_;
  std::array<ListsOfFrame, User::k_most_ahead> lists_;
};

// Finds by true shadow rays which of the needed lights are lit.
void evaluate_lit_samples(const config::Config& config, const PreparedFrame& now, const LightShadows& shadows,
                          std::vector<MethodMeter>& methods, const Stop& stop) {
  for (std::size_t set = 0; set < now.samples.size(); ++set) {
    if (config.sample_sets[set].set != measure::SampleSet::opaque) continue;
    const std::span<const grid::Sample> all = now.samples[set].samples;
    for (std::size_t part = 0; part < part_count(all) && !stop; ++part) {
      const std::span<const grid::Sample> some = part_of(all, part);
      const measure::NeededLights needed = measure::needed_lights(now.frame, some);
      const std::vector<std::vector<bool>> is_lit = shadows.lit(some, needed);
      for (MethodMeter& method : methods) method.add_lit_samples(*now.grid, some, needed, is_lit);
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

bool has_many_samples(const config::Config& config, const PathFrames& path) {
  return std::ranges::any_of(config.sample_sets, [&](const config::SampleSetRequest& request) {
    return request.most_samples(path.viewport()) > static_cast<double>(k_samples_at_once);
  });
}

// What all methods of a group share, over the frames of the pass.
class FrameFacts {
 public:
  // All must outlive this object; `result` receives the facts.
  FrameFacts(const config::Config& config, const grid::GridSpec& spec, const PathFrames& path, AccuracyResult& result)
      : config_(config),
        spec_(spec),
        path_(path),
        losses_(config.compares_precisions() ? config.precisions.size() : 0),
        result_(result) {
    if (config.shared_frusta) result.sharing.emplace();
    if (spec.has_tiles() && spec.slices.fit)
      moves_.emplace(spec.slices.scheme == grid::Scheme::exponential_first ? std::size_t{1} : std::size_t{0});
  }

  void add(const PreparedFrame& now) {
    const grid::Grid& grid = *now.grid;
    measure::add_frame(result_.lights_in_view, now.frame);
    measure::add_frame(result_.lights_beyond_grid, now.frame, grid);
    if (moves_) moves_->add(grid.screen(), path_.spans(spec_)[static_cast<std::size_t>(now.at)]);
    for (std::size_t i = 0; i < losses_.size(); ++i) losses_[i].add_frame(now.lights.packed(i));
    if (result_.sharing) measure::add_frame(*result_.sharing, now.frame, sharing_limits(*config_.shared_frusta));
    if (grid.kind() == grid::Kind::frustum) add_depth_ranges(now, grid.screen(), result_);
  }
  void finish() {
    for (const measure::PackingLossMeter& loss : losses_) result_.losses.push_back(loss.result());
    if (moves_) result_.moves = moves_->result();
  }

 private:
  const config::Config& config_;
  const grid::GridSpec& spec_;
  const PathFrames& path_;
  std::optional<GridMoveMeter> moves_;
  std::vector<measure::PackingLossMeter> losses_;
  AccuracyResult& result_;
};

class AccuracyPass {
 public:
  AccuracyPass(const config::Config& config, const SceneData& data, const GroupPlan& group, const PathFrames& path,
               const std::function<void(int frame)>& on_frame, const Stop& stop, ListsOverFrames over_frames)
      : config_(config),
        group_(group),
        path_(path),
        on_frame_(on_frame),
        stop_(stop),
        samples_(config, data, path),
        culls_(config, group, path),
        has_many_samples_(has_many_samples(config, path)),
        grids_(config.grids[group.grid]),
        facts_(config, config.grids[group.grid], path, result_) {
    if (!config.shadow_culls.empty() && shadow_obstacle(data).empty()) shadows_.emplace(config, data, path);
    make_meters(over_frames);
  }

  AccuracyResult run() {
    const FrameWork<PreparedFrame> work = frame_work();
    if (!FramePipeline<PreparedFrame>(work, path_.count(), config_.threads, stop_).run()) return std::move(result_);
    for (const MethodMeter& method : methods_) result_.methods.push_back(method.result());
    for (const CaseMeter& meter : cases_) result_.structures.push_back(meter.result());
    facts_.finish();
    result_.last_grid = grids_.grid();
    result_.is_complete = true;
    return std::move(result_);
  }

 private:
  void make_meters(ListsOverFrames over_frames) {
    const bool compares = compares_cells(config_, group_),
               has_too_many_cells = !group_.cases.empty() && group_.cases.front().cells_not_compared > 0;
    for (const Method& method : culls_.methods)
      methods_.emplace_back(config_, method, culls_.path.of(method), culls_.max_lights_of(method), over_frames,
                            shadows_ ? &*shadows_ : nullptr, compares, has_too_many_cells);
    needs_truth_ = std::ranges::any_of(methods_, &MethodMeter::needs_grid_truth);
    for (const CasePlan& case_plan : group_.cases) cases_.emplace_back(config_, case_plan);
    for (MethodMeter& method : methods_) works_.emplace_back(method, cases_);
  }

  FrameWork<PreparedFrame> frame_work() {
    FrameWork<PreparedFrame> work;
    work.begin = [this](int index) { return begun(index); };
    work.prepare = [this](PreparedFrame& now) { prepare(now); };
    work.bytes = [](const PreparedFrame& now) { return now.bytes(); };
    if (has_many_samples_ || shadows_) work.after = [this](const PreparedFrame& now) { finish(now); };
    work.users_apart = !shadows_ && !runs_elsewhere(config_, group_);
    const bool shares = config_.threads > 1 && work.users_apart;
    work.users.push_back({[this](const PreparedFrame& now) { start(now); }});
    for (MethodWork& method : works_) method.add_users(work.users, shares, stop_);
    return work;
  }

  std::unique_ptr<PreparedFrame> begun(int index) {
    on_frame_(index);
    auto now = std::make_unique<PreparedFrame>();
    now->at = index;
    now->frame = path_.frame(index);
    now->is_new_grid = grids_.update(path_, now->frame);
    now->grid = grids_.shared();
    now->has_truth = needs_truth_;
    return now;
  }

  void prepare(PreparedFrame& now) const {
    const grid::Grid& grid = *now.grid;
    now.lights = FrameLights(config_.precisions, view::lights_in(now.frame, grid::space_of(grid, now.frame)));
    now.depth = depths_for(config_, group_, path_, now.frame);
    if (needs_truth_) now.truth = measure::find_truth(now.frame, grid, config_.threads);
    const double far = sample_far(now.frame, path_.far_m());
    if (config_.lookup)
      now.lookup.emplace(now.frame, grid, config_.lookup->ways(), far, config_.lookup->samples, config_.seed);
    now.samples = samples_.of(now.frame);
    if (!has_many_samples_) add_needed(now);
  }

  static void add_needed(PreparedFrame& now) {
    for (const FrameSampleSet& set : now.samples) {
      std::vector<measure::NeededLights>& parts = now.needed.emplace_back();
      for (std::size_t part = 0; part < part_count(set.samples); ++part)
        parts.push_back(measure::needed_lights(now.frame, part_of(set.samples, part)));
    }
  }

  void start(const PreparedFrame& now) {
    facts_.add(now);
    if (shadows_) shadows_->start(now.frame);
  }

  void finish(const PreparedFrame& now) {
    if (has_many_samples_)
      for (std::size_t set = 0; set < now.samples.size(); ++set) evaluate_many(now, set);
    if (shadows_) evaluate_lit_samples(config_, now, *shadows_, methods_, stop_);
  }

  // As many parts at a time as there are threads: first the lights that they need, then the methods.
  void evaluate_many(const PreparedFrame& now, std::size_t set) {
    ThreadPool pool(config_.threads);
    const std::span<const grid::Sample> all = now.samples[set].samples;
    const std::size_t parts = part_count(all), at_once = static_cast<std::size_t>(config_.threads);
    for (std::size_t first = 0; first < parts && !stop_; first += at_once) {
      std::vector<measure::NeededLights> needed(std::min(at_once, parts - first));
      each_in_order(pool, needed.size(), [&](std::size_t i) {
        if (!stop_) needed[i] = measure::needed_lights(now.frame, part_of(all, first + i));
      });
      if (stop_) return;
      each_method(pool, [&](const MethodWork& method) {
        for (std::size_t i = 0; i < needed.size() && !stop_; ++i)
          method.add_samples(now, set, first + i, needed[i], stop_);
      });
    }
    each_method(pool, [&](const MethodWork& method) { method.add_waves(now, set, stop_); });
  }

  // Those that run elsewhere are asked by the calling thread alone, too.
  template <class Work>
  void each_method(ThreadPool& pool, const Work& work) {
    if (!runs_elsewhere(config_, group_))
      return each_in_order(pool, works_.size(), [&](std::size_t i) { work(works_[i]); });
    for (const MethodWork& method : works_) work(method);
  }

  const config::Config& config_;
  const GroupPlan& group_;
  const PathFrames& path_;
  const std::function<void(int frame)>& on_frame_;
  Stop stop_;
  FrameSamples samples_;
  GroupCulls culls_;
  bool has_many_samples_, needs_truth_ = false;
  std::optional<LightShadows> shadows_;
  GridOfFrames grids_;
  AccuracyResult result_;
  FrameFacts facts_;
  std::vector<MethodMeter> methods_;
  std::vector<CaseMeter> cases_;
  std::vector<MethodWork> works_;  // one per method
};

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
                             const PathFrames& path, const std::function<void(int frame)>& on_frame, const Stop& stop,
                             ListsOverFrames over_frames) {
  return AccuracyPass(config, data, group, path, on_frame, stop, over_frames).run();
}

}  // namespace clusterbench::run
