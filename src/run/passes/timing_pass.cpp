#include "run/passes/timing_pass.h"

#include <cstring>
#include <memory>

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

// One method with the times of its rounds.
class TimingTrack {
 public:
  TimingTrack(const config::Config& config, const GroupPlan& group, const Method& method,
              const std::vector<TimedFrame>& frames)
      : min_ns_(config.timing.min_time_ms * 1e6), work_(config, group, method, frames) {
    if (work_.converts())
      for (std::size_t store = 0; store < work_.places().size(); ++store)
        stores_.push_back({Repeated([this, store] { work_.convert(store); }, min_ns_ / 10.0), {}});
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
    for (Store& store : stores_) store.convert_ns.push_back(store.convert.sample() / frames);
  }

  // Fills the timing of each of this method's cases. `first`: the group's first one, what others are compared
  // with.
  void report(const TimingTrack& first, const std::string& first_name, std::uint64_t seed,
              std::vector<TimingResult>& out) const {
    double pairs = 0.0;
    for (const assign::Lists& lists : work_.lists()) pairs += lists.pair_count();
    TimingResult timing;
    timing.build_ns = measure::time_stats(build_ns_, seed);
    timing.assign_ns = measure::time_stats(assign_ns_, seed);
    if (pairs > 0.0) timing.ns_per_pair = timing.assign_ns.median * static_cast<double>(work_.frame_count()) / pairs;
    timing.write_floor_ns = measure::time_stats(floor_ns_, seed).median;
    timing.floor_ratio = measure::paired_ratio(assign_ns_, floor_ns_, seed).ratio;
    timing.frames_timed = static_cast<int>(work_.frame_count());
    if (this != &first) timing.vs = Versus{first_name, measure::paired_ratio(assign_ns_, first.assign_ns_, seed)};
    for (std::size_t i = 0; i < work_.places().size(); ++i) {
      TimingResult& one = out[work_.places()[i]];
      one = timing;
      if (work_.converts()) one.convert_ns = measure::time_stats(stores_[i].convert_ns, seed);
    }
  }

 private:
  struct Store {
    Repeated convert;
    std::vector<double> convert_ns;
  };

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
  std::vector<Store> stores_;  // in the order of the work's cases
  WriteFloor write_floor_;
  std::vector<double> build_ns_, assign_ns_, floor_ns_;
  Repeated assign_{[this] { work_.assign(); }, min_ns_};
  Repeated floor_{[this] { write_floor_.copy_once(); }, min_ns_ / 10.0};
};

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
  const std::string first_name = method_label(config, methods.front());
  for (const auto& track : tracks) track->report(*tracks.front(), first_name, config.seed, timings);
  return timings;
}

}  // namespace clusterbench::run
