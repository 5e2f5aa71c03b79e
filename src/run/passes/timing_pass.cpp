#include "run/passes/timing_pass.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>

#include "core/random.h"
#include "run/counters/machine_load.h"
#include "run/findings/fit_meter.h"
#include "run/passes/copy_floor.h"
#include "run/timing/cache_sweep.h"
#include "run/timing/repeated.h"
#include "run/timing/timed_work.h"

namespace clusterbench::run {
namespace {

EachFrame sums(EachFrame left, const EachFrame& right) {
  std::transform(left.begin(), left.end(), right.begin(), left.begin(), std::plus<>());
  return left;
}

// One method and its times.
class TimingTrack {
 public:
  TimingTrack(const config::Config& config, const GroupPlan& group, const Method& method,
              std::span<const TimedFrame> frames, const TimedFrame* fullest)
      : min_ns_(config.timing.min_time_ms * 1e6),
        has_too_many_cells_(group.cases.front().cells_not_compared > 0),
        work_(config, group, method, frames, fullest) {
    samples_.mean_frames = work_.frame_count();
    for (std::size_t i = 0; i < work_.frame_count() + (work_.has_extra() ? 1 : 0); ++i)
      samples_.frames.push_back(work_.path_frame(i));
    samples_.pairs = pairs_of_frames();
    samples_.builds_per_frame = static_cast<double>(work_.builds()) / static_cast<double>(work_.frame_count());
    if (work_.converts()) samples_.stores.resize(work_.case_indices().size());
    for (std::size_t store = 0; store < samples_.stores.size(); ++store)
      converts_.emplace_back([this, store] { work_.convert(store); }, min_ns_ / 10.0);
    copy_floor_.emplace(work_);
  }

  void warm_round() {
    const double start = wall_ns();
    work_.build();
    samples_.build_ns.push_back(wall_ns() - start);
    const auto frames = static_cast<double>(work_.frame_count());
    if (work_.culls()) {
      cull_.warm_up();
      samples_.cull_warm_ns.push_back(cull_.sample() / frames);
    }
    work_.assign();  // warms caches
    samples_.warm_ns.push_back(assign_.sample() / frames);
    samples_.warm_passes = assign_.runs_per_sample();
    work_.check();
    samples_.floor_ns.push_back(floor_.sample() / frames);
    // Conversion has branches that depend on the lists. Without a warm-up of its own, some conversions take up to a
    // quarter longer after a method with other lists than after one with the same lists.
    for (std::size_t store = 0; store < samples_.stores.size(); ++store) {
      converts_[store].warm_up();
      samples_.stores[store].warm_ns.push_back(converts_[store].sample() / frames);
      samples_.stores[store].warm_passes = converts_[store].runs_per_sample();
    }
  }

  // Frame by frame, with the caches as the round left them.
  void warm_frames() {
    if (work_.culls())
      samples_.cull_warm_each.push_back(frame_by_frame([this](std::size_t frame) { work_.cull_frame(frame); }));
    samples_.warm_each.push_back(frame_by_frame([this](std::size_t frame) { work_.assign_frame(frame); }));
    for (std::size_t frame = 0; frame < samples_.frames.size(); ++frame) work_.check_frame(frame);
    for (std::size_t store = 0; store < samples_.stores.size(); ++store)
      samples_.stores[store].warm_each.push_back(
          frame_by_frame([this, store](std::size_t frame) { work_.convert_frame(store, frame); }));
  }

  // Each frame once after `sweep`. With several storages each one has its own frame: its buffers are cold and its lists
  // are as the assignment left them. A conversion by another storage just before would have warmed them.
  void cold_frames(const std::function<void()>& sweep) {
    samples_.cold_each.emplace_back();
    if (work_.culls()) samples_.cull_cold_each.emplace_back();
    for (StoreSamples& store : samples_.stores) store.cold_each.emplace_back();
    for (std::size_t frame = 0; frame < samples_.frames.size(); ++frame) {
      if (frame >= samples_.mean_frames) work_.prepare_frame(frame);
      for (std::size_t store = 0; store == 0 || store < samples_.stores.size(); ++store) {
        const ColdLists lists = cold_lists(frame, sweep);
        if (store == 0 && work_.culls()) samples_.cull_cold_each.back().push_back(lists.cull_ns);
        if (store == 0) samples_.cold_each.back().push_back(lists.assign_ns);
        if (samples_.stores.empty()) continue;
        work_.check_frame(frame);
        const double before = wall_ns();
        work_.convert_frame(store, frame);
        samples_.stores[store].cold_each.back().push_back(wall_ns() - before);
      }
    }
  }

  const MethodSamples& samples() const { return samples_; }

 private:
  struct ColdLists {
    double cull_ns = 0.0, assign_ns = 0.0;
  };
  ColdLists cold_lists(std::size_t frame, const std::function<void()>& sweep) {
    ColdLists out;
    sweep();
    wall_ns();  // brings the clock's own data into the cache
    double before = wall_ns();
    if (work_.culls()) {
      work_.cull_frame(frame);
      const double culled = wall_ns();
      out.cull_ns = culled - before;
      before = culled;
    }
    work_.assign_frame(frame);
    out.assign_ns = wall_ns() - before;
    return out;
  }

  // Pairs in lists, or in the cells of a structure; empty without cells, or if they are too many to be expanded.
  std::vector<std::uint64_t> pairs_of_frames() const {
    std::vector<std::uint64_t> pairs;
    for (const assign::Lists& lists : work_.lists()) pairs.push_back(lists.pair_count());
    for (const auto& structure : work_.structures())
      if (structure->has_cells() && !has_too_many_cells_) pairs.push_back(structure->expanded().pair_count());
    return pairs;
  }

  // Passes for at least a tenth of a round; the clock is read after each frame.
  template <class Once>
  EachFrame frame_by_frame(const Once& once) const {
    EachFrame each(samples_.frames.size(), 0.0);
    const double begin = wall_ns();
    for (double before = begin; before - begin < min_ns_ / 10.0 || before == begin;)
      for (std::size_t frame = 0; frame < each.size(); ++frame) {
        once(frame);
        const double now = wall_ns();
        each[frame] += now - before;
        before = now;
      }
    return each;
  }

  double min_ns_;
  bool has_too_many_cells_;
  TimedWork work_;
  MethodSamples samples_;
  std::deque<Repeated> converts_;  // one per storage
  std::optional<CopyFloor> copy_floor_;
  Repeated assign_{[this] { work_.assign(); }, min_ns_};
  Repeated cull_{[this] { work_.cull(); }, min_ns_ / 10.0};
  Repeated floor_{[this] { copy_floor_->copy_once(); }, min_ns_ / 10.0};
};

// The frames of the means, followed by the fullest frames of the methods that are not among them.
std::vector<int> all_frames(const std::vector<int>& of_means, const std::vector<int>& fullest) {
  std::vector<int> all = of_means;
  for (const int frame : fullest)
    if (frame >= 0 && std::find(all.begin(), all.end(), frame) == all.end()) all.push_back(frame);
  return all;
}

// A group's methods over the timed frames, in the grid of a configuration.
struct TimedSide {
  TimedSide(const config::Config& config, const GroupPlan& group, const PathFrames& path,
            const std::vector<int>& of_means, const LaunchRequest& request)
      : mean_frames(of_means.size()) {
    const std::vector<int> all = all_frames(of_means, request.fullest_frames);
    frames = timed_frames(config, group, path, all);
    const std::vector<Method> methods = methods_of(group);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const auto fullest =
          i < request.fullest_frames.size()
              ? std::find(all.begin() + static_cast<std::ptrdiff_t>(mean_frames), all.end(), request.fullest_frames[i])
              : all.end();
      const TimedFrame* extra =
          fullest == all.end() ? nullptr : &frames[static_cast<std::size_t>(fullest - all.begin())];
      tracks.push_back(std::make_unique<TimingTrack>(config, group, methods[i], in_means(), extra));
    }
  }

  std::span<const TimedFrame> in_means() const { return std::span(frames).first(mean_frames); }

  std::size_t mean_frames;
  std::vector<TimedFrame> frames;
  std::vector<std::unique_ptr<TimingTrack>> tracks;
};

// Time per frame, in nanoseconds, to find the needed span and make the grid for it. Depths are already cast.
double time_to_follow(const grid::GridSpec& spec, const PathFrames& path, std::span<const TimedFrame> frames) {
  double sum_ns = 0.0;
  for (const TimedFrame& frame : frames) {
    const grid::GridInputs inputs = path.inputs(spec, frame.frame);
    path.needed(spec, frame.frame);  // casts depths that are not cached
    const double start = wall_ns();
    path.needed(spec, frame.frame);
    grid::make_grid(spec, inputs);
    sum_ns += wall_ns() - start;
  }
  return sum_ns / static_cast<double>(frames.size());
}

// The rounds of all launches, one launch after the other.
template <class Value, class Of>
std::vector<Value> joined_rounds(std::span<const GroupSamples> launches, const Of& of) {
  std::vector<Value> all;
  for (const GroupSamples& launch : launches) {
    const std::vector<Value>& some = of(launch);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::vector<double> means(const std::vector<EachFrame>& rounds, std::size_t frames) {
  std::vector<double> out;
  for (const EachFrame& each : rounds)
    out.push_back(std::accumulate(each.begin(), each.begin() + static_cast<std::ptrdiff_t>(frames), 0.0) /
                  static_cast<double>(frames));
  return out;
}

// All launches' samples of one method, and the timing results of its cases.
class MethodTimes {
 public:
  MethodTimes(std::span<const GroupSamples> launches, std::size_t method, std::uint64_t seed)
      : launches_(launches), method_(method), first_(launches.front().methods[method]), seed_(seed) {}

  TimingResult of_case(std::size_t store) const {
    const bool converts = !first_.stores.empty(), culls = !first_.cull_warm_ns.empty();
    const std::vector<double> warm = rounds(&MethodSamples::warm_ns);
    const std::vector<double> warm_convert = converts ? rounds(store, &StoreSamples::warm_ns) : std::vector<double>{};
    TimingResult out = of_method(warm);
    const std::vector<double> warm_cull = rounds(&MethodSamples::cull_warm_ns);
    std::vector<double> warm_frame = converts ? sums(warm, warm_convert) : warm;
    if (culls) warm_frame = sums(warm_frame, warm_cull);
    WarmTimes times{stats(warm_frame), stats(warm), std::nullopt, std::nullopt};
    if (converts) times.convert_ns = stats(warm_convert);
    if (culls) times.pre_cull_ns = stats(warm_cull);
    out.warm_assign_passes = fewest([&](const MethodSamples& method) { return method.warm_passes; });
    if (converts)
      out.warm_convert_passes = fewest([&](const MethodSamples& method) { return method.stores[store].warm_passes; });
    std::vector<EachFrame> each = frames(&MethodSamples::cold_each);
    out.is_cold = !each.empty();
    if (!out.is_cold) {
      out.frame_ns = times.frame_ns;
      out.assign_ns = times.assign_ns;
      out.convert_ns = times.convert_ns;
      out.pre_cull_ns = times.pre_cull_ns;
      each = warm_each_frame(store, times.frame_ns.samples);
    } else {
      const std::vector<double> assign = means(each, first_.mean_frames);
      std::vector<double> frame = assign;
      out.assign_ns = stats(assign);
      if (converts) {
        const std::vector<EachFrame> converted = frames(store, &StoreSamples::cold_each);
        const std::vector<double> convert = means(converted, first_.mean_frames);
        out.convert_ns = stats(convert);
        frame = sums(frame, convert);
        for (std::size_t round = 0; round < each.size(); ++round) each[round] = sums(each[round], converted[round]);
      }
      if (culls) {
        const std::vector<EachFrame> culled = frames(&MethodSamples::cull_cold_each);
        const std::vector<double> cull = means(culled, first_.mean_frames);
        out.pre_cull_ns = stats(cull);
        frame = sums(frame, cull);
        for (std::size_t round = 0; round < each.size(); ++round) each[round] = sums(each[round], culled[round]);
      }
      out.frame_ns = stats(frame);
      out.warm = std::move(times);
    }
    if (converts && *out.pairs_mean > 0.0) out.ns_per_pair = out.frame_ns.median / *out.pairs_mean;
    const measure::WorstFrame worst =
        measure::worst_frame(each, first_.mean_frames, out.frame_ns.median, seed_, launch_count());
    out.worst = {first_.frames[worst.index], worst.ns, worst.ci95, {}};
    if (!first_.pairs.empty()) out.worst.pairs = first_.pairs[worst.index];
    return out;
  }

 private:
  int launch_count() const { return static_cast<int>(launches_.size()); }
  measure::TimeStats stats(const std::vector<double>& samples) const {
    return measure::time_stats(samples, seed_, launch_count());
  }

  template <class Value>
  std::vector<Value> rounds(std::vector<Value> MethodSamples::*part) const {
    return joined_rounds<Value>(launches_, [&](const GroupSamples& launch) -> const std::vector<Value>& {
      return launch.methods[method_].*part;
    });
  }
  template <class Value>
  std::vector<Value> rounds(std::size_t store, std::vector<Value> StoreSamples::*part) const {
    return joined_rounds<Value>(launches_, [&](const GroupSamples& launch) -> const std::vector<Value>& {
      return launch.methods[method_].stores[store].*part;
    });
  }
  std::vector<EachFrame> frames(std::vector<EachFrame> MethodSamples::*part) const { return rounds(part); }
  std::vector<EachFrame> frames(std::size_t store, std::vector<EachFrame> StoreSamples::*part) const {
    return rounds(store, part);
  }

  // Each launch decides by itself how many passes are long enough for a sample.
  template <class Of>
  int fewest(const Of& of) const {
    int least = std::numeric_limits<int>::max();
    for (const GroupSamples& launch : launches_) least = std::min(least, of(launch.methods[method_]));
    return least;
  }

  // The figures that all cases of the method share.
  TimingResult of_method(const std::vector<double>& warm) const {
    TimingResult out;
    out.launches = launch_count();
    out.build_ns = stats(rounds(&MethodSamples::build_ns));
    out.builds_per_frame = first_.builds_per_frame;
    out.frames_timed = static_cast<int>(first_.mean_frames);
    if (!first_.pairs.empty()) {
      const auto end = first_.pairs.begin() + static_cast<std::ptrdiff_t>(first_.mean_frames);
      out.pairs_mean = static_cast<double>(std::accumulate(first_.pairs.begin(), end, std::uint64_t{0})) /
                       static_cast<double>(first_.mean_frames);
      out.pairs_max = *std::max_element(first_.pairs.begin(), end);
    }
    const std::vector<double> floor = rounds(&MethodSamples::floor_ns);
    out.write_floor_ns = stats(floor).median;
    out.floor_ratio = measure::paired_ratio(warm, floor, seed_, launch_count()).ratio;
    for (const GroupSamples& launch : launches_) {
      out.disturbance.seconds += launch.disturbance.seconds;
      out.disturbance.others_s += launch.disturbance.others_s;
      out.disturbance.stolen_s += launch.disturbance.stolen_s;
      out.disturbance.throttled += launch.disturbance.throttled;
    }
    return out;
  }

  std::vector<EachFrame> warm_each_frame(std::size_t store, const std::vector<double>& frame_ns) const {
    std::vector<EachFrame> each = frames(&MethodSamples::warm_each);
    if (!first_.stores.empty()) {
      const std::vector<EachFrame> converted = frames(store, &StoreSamples::warm_each);
      for (std::size_t round = 0; round < each.size(); ++round) each[round] = sums(each[round], converted[round]);
    }
    const std::vector<EachFrame> culled = frames(&MethodSamples::cull_warm_each);
    for (std::size_t round = 0; round < culled.size(); ++round) each[round] = sums(each[round], culled[round]);
    for (std::size_t round = 0; round < each.size(); ++round)
      each[round] = measure::scaled_to_mean(each[round], first_.mean_frames, frame_ns[round]);
    return each;
  }

  std::span<const GroupSamples> launches_;
  std::size_t method_;
  const MethodSamples& first_;
  std::uint64_t seed_;
};

// For a grid that follows the needs of frames: compares its cases with the same cases in the grid that does not follow.
void add_fit_times(const config::Config& config, const GroupPlan& group, std::span<const GroupSamples> launches,
                   std::vector<TimingResult>& timings) {
  const std::vector<Method> methods = methods_of(group);
  if (launches.front().methods.size() == methods.size()) return;
  const auto launch_count = static_cast<int>(launches.size());
  const std::vector<double> follow_ns = joined_rounds<double>(
      launches, [](const GroupSamples& launch) -> const std::vector<double>& { return launch.follow_ns; });
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const MethodTimes unfitted(launches, methods.size() + i, config.seed);
    std::size_t store = 0;
    for (std::size_t index = 0; index < timings.size(); ++index) {
      if (group.cases[index].method() != methods[i]) continue;
      const measure::TimeStats before = unfitted.of_case(store++).frame_ns;
      timings[index].fit =
          FitTimes{measure::time_stats(follow_ns, config.seed, launch_count), before,
                   measure::paired_ratio(timings[index].frame_ns.samples, before.samples, config.seed, launch_count)};
    }
  }
}

// The case to compare with: the group's first one with the same storage; for a structure of a method's own, the first
// case.
std::size_t reference_of(const GroupPlan& group, std::size_t index) {
  const auto is_alike = [&](const CasePlan& case_plan) { return case_plan.storage == group.cases[index].storage; };
  if (!group.cases[index].storage) return 0;
  return static_cast<std::size_t>(std::find_if(group.cases.begin(), group.cases.end(), is_alike) - group.cases.begin());
}

}  // namespace

int rounds_per_launch(const config::TimingRequest& timing, int launches) {
  return (timing.rounds + launches - 1) / launches;
}

std::vector<std::size_t> method_order(std::size_t methods, std::uint64_t seed, int launch, int round) {
  SplitMix64 random(seed + 1000003 * static_cast<std::uint64_t>(launch) + static_cast<std::uint64_t>(round / 2));
  std::vector<std::size_t> order(methods);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = methods; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  if (round % 2 == 1) std::reverse(order.begin(), order.end());
  return order;
}

GroupSamples measure_launch(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                            const LaunchRequest& request, const std::function<void(int round)>& on_round,
                            const std::atomic<bool>& stop) {
  const std::vector<int> of_means = mean_frames(config, path);
  const grid::GridSpec& spec = config.grids[group.grid];
  const bool follows = spec.has_tiles() && spec.slices.fit;
  const TimedSide timed(config, group, path, of_means, request);
  std::optional<config::Config> plain;
  std::optional<TimedSide> unfitted;
  if (follows) {
    plain.emplace(without_fit(config, group.grid));
    unfitted.emplace(*plain, group, path, of_means, request);
  }
  std::vector<TimingTrack*> tracks;
  for (const auto& track : timed.tracks) tracks.push_back(track.get());
  if (unfitted)
    for (const auto& track : unfitted->tracks) tracks.push_back(track.get());
  const std::uint64_t bytes = config.timing.cold ? sweep_bytes(config.timing.sweep_mib) : 0;
  const std::function<void()> sweep = request.sweep ? request.sweep : [bytes] { sweep_caches(bytes); };
  const int cold = config.timing.cold ? cold_rounds(request.rounds, of_means.size() + 1, bytes) : 0;
  const LoadWatch watch;
  GroupSamples out;
  for (int round = 0; round < request.rounds; ++round) {
    on_round(round);
    if (follows) out.follow_ns.push_back(time_to_follow(spec, path, timed.in_means()));
    for (const std::size_t method : method_order(tracks.size(), config.seed, request.launch, round)) {
      if (stop) return {};
      TimingTrack& track = *tracks[method];
      if (!config.timing.cold || round < request.warm_rounds) track.warm_round();
      if (!config.timing.cold) track.warm_frames();
      if (round < cold) track.cold_frames(sweep);
    }
  }
  for (const TimingTrack* track : tracks) out.methods.push_back(track->samples());
  out.disturbance = watch.so_far();
  return out;
}

std::vector<TimingResult> timing_results(const config::Config& config, const GroupPlan& group,
                                         std::span<const GroupSamples> launches) {
  const std::vector<Method> methods = methods_of(group);
  const auto launch_count = static_cast<int>(launches.size());
  std::vector<TimingResult> timings(group.cases.size());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const MethodTimes times(launches, i, config.seed);
    std::size_t store = 0;
    for (std::size_t index = 0; index < timings.size(); ++index)
      if (group.cases[index].method() == methods[i]) timings[index] = times.of_case(store++);
  }
  add_fit_times(config, group, launches, timings);
  for (std::size_t index = 0; index < timings.size(); ++index) {
    const std::size_t first = reference_of(group, index);
    if (group.cases[first].method() == group.cases[index].method()) continue;
    timings[index].against_first =
        Versus{method_label(config, group.cases[first].method()),
               measure::paired_ratio(timings[index].frame_ns.samples, timings[first].frame_ns.samples, config.seed,
                                     launch_count)};
  }
  return timings;
}

}  // namespace clusterbench::run
