#include "run/passes/timing_pass.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <numeric>

#include "run/repeated.h"
#include "run/timed_work.h"

namespace clusterbench::run {
namespace {

// Memory traffic that no way of assigning can avoid: what each frame leaves, headers and indices, copied once. Each
// frame has buffers of its own, one for headers and one for indices, as each frame's lists have: one pair of buffers
// for all would stay in the cache where the lists of a long path do not.
class WriteFloor {
 public:
  void add_frame(const assign::StructureUse& use) {
    for (const std::uint64_t bytes : {use.header_bytes, use.index_bytes})
      if (bytes > 0) copies_.push_back({std::vector<unsigned char>(bytes, 1), std::vector<unsigned char>(bytes, 2)});
  }
  void copy_once() {
    for (Copy& copy : copies_) {
      std::memcpy(copy.to.data(), copy.from.data(), copy.from.size());
      asm volatile("" : : "r"(copy.to.data()) : "memory");  // the copies are wanted for themselves
    }
  }

 private:
  struct Copy {
    std::vector<unsigned char> from, to;
  };
  std::vector<Copy> copies_;
};

// The times of one case over the rounds; of a method's own structure, nothing is converted.
struct CaseTimes {
  std::vector<double> convert_ns;               // per frame
  std::vector<double> frame_ns;                 // per frame: assign and convert
  std::vector<std::vector<double>> each_frame;  // of each round, each frame by itself
};

std::vector<double> sums(std::vector<double> left, const std::vector<double>& right) {
  std::transform(left.begin(), left.end(), right.begin(), left.begin(), std::plus<>());
  return left;
}

// One method with the times of its rounds.
class TimingTrack {
 public:
  TimingTrack(const config::Config& config, const GroupPlan& group, const Method& method,
              const std::vector<TimedFrame>& frames)
      : min_ns_(config.timing.min_time_ms * 1e6), work_(config, group, method, frames) {
    cases_.resize(work_.places().size());
    if (work_.converts())
      for (std::size_t store = 0; store < cases_.size(); ++store)
        converts_.emplace_back([this, store] { work_.convert(store); }, min_ns_ / 10.0);
    prepare_floor();
  }

  void round() {
    const double start = wall_ns();
    work_.build();
    build_ns_.push_back(wall_ns() - start);
    work_.assign();  // warms caches
    const auto frames = static_cast<double>(work_.frame_count());
    assign_ns_.push_back(assign_.sample() / frames);
    floor_ns_.push_back(floor_.sample() / frames);
    const std::vector<double> assign_each = frame_by_frame([this](std::size_t frame) { work_.assign_frame(frame); });
    for (std::size_t store = 0; store < cases_.size(); ++store) {
      CaseTimes& one = cases_[store];
      one.frame_ns.push_back(assign_ns_.back());
      one.each_frame.push_back(assign_each);
      if (!work_.converts()) continue;
      one.convert_ns.push_back(converts_[store].sample() / frames);
      one.frame_ns.back() += one.convert_ns.back();
      one.each_frame.back() =
          sums(assign_each, frame_by_frame([this, store](std::size_t frame) { work_.convert_frame(store, frame); }));
    }
  }

  // Fills the timing of each of this method's cases.
  void report(std::uint64_t seed, std::vector<TimingResult>& out) const {
    const auto frames = static_cast<double>(work_.frame_count());
    TimingResult timing;
    timing.build_ns = measure::time_stats(build_ns_, seed);
    timing.assign_ns = measure::time_stats(assign_ns_, seed);
    timing.builds_per_frame = static_cast<double>(work_.builds()) / frames;
    const std::vector<std::uint64_t> pairs = pairs_of_frames();
    if (!pairs.empty()) {
      timing.pairs_mean = static_cast<double>(std::accumulate(pairs.begin(), pairs.end(), std::uint64_t{0})) / frames;
      timing.pairs_max = *std::max_element(pairs.begin(), pairs.end());
    }
    timing.write_floor_ns = measure::time_stats(floor_ns_, seed).median;
    timing.floor_ratio = measure::paired_ratio(assign_ns_, floor_ns_, seed).ratio;
    timing.frames_timed = static_cast<int>(work_.frame_count());
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      TimingResult& one = out[work_.places()[i]];
      one = timing;
      if (work_.converts()) one.convert_ns = measure::time_stats(cases_[i].convert_ns, seed);
      one.frame_ns = measure::time_stats(cases_[i].frame_ns, seed);
      if (work_.converts() && *timing.pairs_mean > 0.0) one.ns_per_pair = one.frame_ns.median / *timing.pairs_mean;
      const measure::WorstFrame worst = measure::worst_frame(cases_[i].each_frame, cases_[i].frame_ns, seed);
      one.worst = {work_.path_frame(worst.place), worst.ns, worst.ci95, {}};
      if (!pairs.empty()) one.worst.pairs = pairs[worst.place];
    }
  }

 private:
  // In lists, or in the cells of a structure; none without cells.
  std::vector<std::uint64_t> pairs_of_frames() const {
    std::vector<std::uint64_t> pairs;
    for (const assign::Lists& lists : work_.lists()) pairs.push_back(lists.pair_count());
    for (const auto& structure : work_.structures())
      if (structure->has_cells()) pairs.push_back(structure->expanded().pair_count());
    return pairs;
  }

  // Passes that last as long as a tenth of a round, a look at the clock after each frame.
  template <class Once>
  std::vector<double> frame_by_frame(const Once& once) const {
    std::vector<double> each(work_.frame_count(), 0.0);
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

  // What the tight storage writes for these lists; or the method's own structure, as it is.
  void prepare_floor() {
    for (const auto& structure : work_.structures()) write_floor_.add_frame(structure->use());
    if (!work_.converts()) return;
    const assign::StorageDescriptor& packed = *assign::find_storage("packed");
    const auto storage = work_.storage(packed, assign::Params(packed.params));
    for (const assign::Lists& lists : work_.lists()) {
      storage->store(lists);
      write_floor_.add_frame(storage->use());
    }
  }

  double min_ns_;
  TimedWork work_;
  std::vector<CaseTimes> cases_;   // in the order of the work's cases
  std::deque<Repeated> converts_;  // of each
  WriteFloor write_floor_;
  std::vector<double> build_ns_, assign_ns_, floor_ns_;
  Repeated assign_{[this] { work_.assign(); }, min_ns_};
  Repeated floor_{[this] { write_floor_.copy_once(); }, min_ns_ / 10.0};
};

// What a case is compared with: the group's first one in the same storage; a structure of a method's own with the first
// of all.
std::size_t reference_of(const GroupPlan& group, std::size_t place) {
  const auto is_alike = [&](const CasePlan& one) { return one.storage == group.cases[place].storage; };
  if (!group.cases[place].storage) return 0;
  return static_cast<std::size_t>(std::find_if(group.cases.begin(), group.cases.end(), is_alike) - group.cases.begin());
}

}  // namespace

std::vector<TimingResult> timing_pass(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                                      const std::function<void(int round)>& on_round, const std::atomic<bool>& stop) {
  const std::vector<TimedFrame> frames = timed_frames(config, group, path);
  const std::vector<Method> methods = methods_of(group);
  std::vector<std::unique_ptr<TimingTrack>> tracks;
  for (const Method& method : methods) tracks.push_back(std::make_unique<TimingTrack>(config, group, method, frames));

  for (int round = 0; round < config.timing.rounds; ++round) {
    on_round(round);
    const bool is_backward = round % 2 == 1;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      if (stop) return {};
      tracks[is_backward ? tracks.size() - 1 - i : i]->round();
    }
  }

  std::vector<TimingResult> timings(group.cases.size());
  for (const auto& track : tracks) track->report(config.seed, timings);
  for (std::size_t place = 0; place < timings.size(); ++place) {
    const std::size_t first = reference_of(group, place);
    if (group.cases[first].method() == group.cases[place].method()) continue;
    timings[place].against_first =
        Versus{method_label(config, group.cases[first].method()),
               measure::paired_ratio(timings[place].frame_ns.samples, timings[first].frame_ns.samples, config.seed)};
  }
  return timings;
}

}  // namespace clusterbench::run
