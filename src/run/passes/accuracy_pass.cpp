#include "run/passes/accuracy_pass.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "run/cases/frame_samples.h"
#include "run/cases/impossible_cases.h"
#include "run/cases/path_culls.h"
#include "run/findings/light_shadows.h"
#include "run/passes/case_meter.h"
#include "run/passes/frame_pipeline.h"
#include "run/passes/method_meter.h"
#include "run/passes/prepared_frame.h"

namespace clusterbench::run {
namespace {

// A method and its cases, which have nothing in common with other methods.
class MethodWork {
 public:
  using User = FrameUser<PreparedFrame>;

  MethodWork(MethodMeter& method, std::vector<CaseMeter>& cases, ListMemory& memory)
      : method_(method), memory_(memory) {
    for (CaseMeter& meter : cases)
      if (meter.method() == method.method()) cases_.push_back(&meter);
  }

  bool shares_frames(bool counts_scratch) const { return method_.run().shares_frames(counts_scratch); }

  // One user for all; or the method, and behind it its measures and each of its cases, if these need its lists alone.
  // `places`: for the lists of so many frames; none: one user. `shares_frames`: the method may be at several frames at
  // once.
  void add_users(std::vector<User>& users, std::size_t places, bool shares_frames, const Stop& stop) {
    if (places == 0 || !method_.is_done_with_lists())
      return users.push_back({[this, stop](const PreparedFrame& now) { add(now, stop); }});
    lists_ = std::vector<SharedLists>(places);
    const std::size_t leader = users.size();
    users.push_back(
        {[this](const PreparedFrame& now) { fill(now); }, User::k_none, static_cast<int>(places), shares_frames});
    users.push_back({[this](const PreparedFrame& now) {
                       method_.add(now, lists_of(now).lists);
                       end_reading(now);
                     },
                     leader});
    for (CaseMeter* meter : cases_)
      users.push_back({[this, meter, stop](const PreparedFrame& now) {
                         meter->add(now, lists_of(now).lists);
                         meter->add_known_samples(now, stop);
                         end_reading(now);
                       },
                       leader});
  }

  // For frames with many samples.
  void add_samples(const PreparedFrame& now, std::size_t set, std::size_t part, const measure::NeededLights& needed,
                   const Stop& stop) const {
    method_.add_needed(set, needed);
    for (CaseMeter* meter : cases_)
      if (!stop) meter->add_samples(now, set, part, needed);
  }
  void add_waves(const PreparedFrame& now, std::size_t set, const Stop& stop) const {
    for (CaseMeter* meter : cases_)
      if (!stop) meter->add_waves(now, set);
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
      meter->add_known_samples(now, stop);
    }
  }

  struct SharedLists {
    ListsOfFrame lists;
    std::atomic<std::size_t> readers = 0;  // that are not done: measures of the method, and each of its cases
  };
  // The method is at most so many frames ahead of its cases.
  SharedLists& lists_of(const PreparedFrame& now) { return lists_[static_cast<std::size_t>(now.at) % lists_.size()]; }
  void fill(const PreparedFrame& now) {
    SharedLists& shared = lists_of(now);
    method_.fill(now, memory_, shared.lists);
    shared.readers = 1 + cases_.size();
  }
  void end_reading(const PreparedFrame& now) {
    SharedLists& shared = lists_of(now);
    if (--shared.readers == 0) memory_.give(std::move(shared.lists.filled));
  }

  MethodMeter& method_;
  ListMemory& memory_;
  std::vector<CaseMeter*> cases_;
  std::vector<SharedLists> lists_;
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
    const std::vector<bool> in_view = path_.lights_in_view(now.frame);
    measure::add_frame(result_.lights_in_view, now.frame, in_view);
    measure::add_frame(result_.lights_beyond_grid, now.frame, grid, in_view);
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
    for (MethodMeter& method : methods_) works_.emplace_back(method, cases_, memory_);
  }

  FrameWork<PreparedFrame> frame_work() {
    FrameWork<PreparedFrame> work;
    work.begin = [this](int index) { return begun(index); };
    work.prepare = [this](PreparedFrame& now) { prepare(now); };
    work.bytes = [](const PreparedFrame& now) { return now.bytes(); };
    if (has_many_samples_ || shadows_) work.after = [this](const PreparedFrame& now) { finish(now); };
    work.users_apart = !shadows_ && !runs_elsewhere(config_, group_);
    const std::size_t places = config_.threads > 1 && work.users_apart ? places_of_lists() : 0;
    work.users.push_back({[this](const PreparedFrame& now) { start(now); }});
    for (MethodWork& method : works_)
      method.add_users(work.users, places, cells_stay() && method.shares_frames(config_.counts_scratch), stop_);
    return work;
  }

  // Of each method: one for each thread and one that its cases read, or as many as fit, but two.
  std::size_t places_of_lists() const {
    const double fit = static_cast<double>(k_most_bytes_ahead) / std::max(1.0, most_list_bytes(config_, group_, path_));
    return static_cast<std::size_t>(std::clamp(fit, 2.0, config_.threads + 1.0));
  }
  // True if the grids of all frames have the same number of cells.
  bool cells_stay() const { return !config_.grids[group_.grid].reaction; }

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
  ListMemory memory_;              // of all methods
  std::vector<MethodWork> works_;  // one per method
};

}  // namespace

double most_list_bytes(const config::Config& config, const GroupPlan& group, const PathFrames& path) {
  const view::Frame frame = path.frame(0);
  GridOfFrames grids(config.grids[group.grid]);
  grids.update(path, frame);
  const double lists = 1.0 + static_cast<double>(methods_of(group).size());
  return lists * static_cast<double>(grids.grid().cell_count()) * static_cast<double>(frame.lights.size()) *
         sizeof(std::uint32_t);
}

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
