#include "run/timing_pass.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>

#include "run/frame_lights.h"

namespace clusterbench::run {
namespace {

using Clock = std::chrono::steady_clock;

double ns_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

// A frame with all that an assigner needs; frames with the same grid share it.
struct TimedFrame {
  std::shared_ptr<const grid::Grid> grid;
  view::Frame frame;
  FrameLights lights;
};

std::vector<TimedFrame> timed_frames(const Config& config, const GroupPlan& group, const PathFrames& path) {
  const int wanted = config.timing.frames == 0 ? path.count() : std::min(config.timing.frames, path.count());
  std::vector<TimedFrame> frames;
  GridOfFrames grids(config.grids[group.grid]);
  std::shared_ptr<const grid::Grid> grid;
  frames.reserve(static_cast<std::size_t>(wanted));
  for (int i = 0; i < wanted; ++i) {
    view::Frame frame =
        path.frame(wanted == 1 ? 0 : static_cast<int>(std::lround(i * (path.count() - 1.0) / (wanted - 1))));
    if (grids.update(path, frame)) grid = std::make_shared<grid::Grid>(grids.grid());
    FrameLights lights(config.precisions, view::lights_in(frame, grid::space_of(*grid, frame)));
    frames.push_back({grid, std::move(frame), std::move(lights)});
  }
  return frames;
}

// Memory traffic that no way of assigning can avoid: the finished lists and headers, copied once.
class WriteFloor {
 public:
  void set_bytes(const std::vector<std::size_t>& per_frame) {
    bytes_ = per_frame;
    const std::size_t most = *std::max_element(bytes_.begin(), bytes_.end());
    from_.assign(most, 1);
    to_.assign(most, 2);
  }
  void copy_once() {
    for (const std::size_t bytes : bytes_) {
      std::memcpy(to_.data(), from_.data(), bytes);
      asm volatile("" : : "r"(to_.data()) : "memory");  // the copies are wanted for themselves
    }
  }

 private:
  std::vector<std::size_t> bytes_;
  std::vector<unsigned char> from_, to_;
};

// Runs something as often as takes min_ns, the same number of times in every round.
class Repeated {
 public:
  Repeated(std::function<void()> once, double min_ns) : once_(std::move(once)), min_ns_(min_ns) {}

  // ns per run.
  double sample() {
    if (repeats_ == 0) calibrate();
    const auto start = Clock::now();
    for (int i = 0; i < repeats_; ++i) once_();
    return ns_since(start) / repeats_;
  }

 private:
  void calibrate() {
    once_();
    const auto start = Clock::now();
    once_();
    const double one_ns = std::max(1.0, ns_since(start));
    repeats_ = static_cast<int>(std::clamp(std::ceil(min_ns_ / one_ns), 1.0, 1e6));
  }

  std::function<void()> once_;
  double min_ns_;
  int repeats_ = 0;
};

// One method over the timed frames, with the storages that its cases use.
class Track {
 public:
  Track(const Config& config, const GroupPlan& group, const Method& method, const std::vector<TimedFrame>& frames)
      : frames_(frames), precision_(method.precision), min_ns_(config.timing.min_time_ms * 1e6), lists_(frames.size()) {
    const MethodRequest& assigner = config.assigners[method.assigner];
    assigner_ = assign::find_assigner(assigner.name)->make(assigner.params);
    for (std::size_t place = 0; place < group.cases.size(); ++place)
      if (group.cases[place].method() == method) add_store(config, group.cases[place], place);
    assign_once();
    prepare_floor();
  }

  void round() {
    const auto start = Clock::now();
    assigner_->build(*frames_.front().grid);
    build_ns_.push_back(ns_since(start));
    built_for_ = frames_.front().grid.get();
    assign_once();  // warms caches, and makes what an assigner makes with the first spot
    const auto frames = static_cast<double>(frames_.size());
    assign_ns_.push_back(assign_.sample() / frames);
    floor_ns_.push_back(floor_.sample() / frames);
    for (Store& store : stores_) store.convert_ns.push_back(store.convert.sample() / frames);
  }

  // Fills the timing of each of this method's cases. `first`: the group's first one, what others are compared
  // with.
  void report(const Track& first, const std::string& first_name, std::uint64_t seed,
              std::vector<TimingResult>& out) const {
    double pairs = 0.0;
    for (const assign::Lists& lists : lists_) pairs += lists.pair_count();
    TimingResult timing;
    timing.build_ns = measure::time_stats(build_ns_, seed);
    timing.assign_ns = measure::time_stats(assign_ns_, seed);
    if (pairs > 0.0) timing.ns_per_pair = timing.assign_ns.median * static_cast<double>(frames_.size()) / pairs;
    timing.write_floor_ns = measure::time_stats(floor_ns_, seed).median;
    timing.floor_ratio = measure::paired_ratio(assign_ns_, floor_ns_, seed).ratio;
    timing.frames_timed = static_cast<int>(frames_.size());
    if (this != &first) timing.vs = Versus{first_name, measure::paired_ratio(assign_ns_, first.assign_ns_, seed)};
    for (const Store& store : stores_) {
      out[store.place] = timing;
      out[store.place].convert_ns = measure::time_stats(store.convert_ns, seed);
    }
  }

 private:
  struct Store {
    std::size_t place;  // in the group's cases
    std::unique_ptr<assign::Storage> storage;
    Repeated convert;
    std::vector<double> convert_ns;
  };

  void add_store(const Config& config, const CasePlan& plan, std::size_t place) {
    const MethodRequest& method = config.storages[plan.storage];
    auto storage = assign::find_storage(method.name)->make(method.params);
    start(*storage);
    assign::Storage* const kept = storage.get();
    stores_.push_back({place, std::move(storage), Repeated([this, kept] { convert_once(*kept); }, min_ns_ / 10.0), {}});
  }

  void start(assign::Storage& storage) const {
    const TimedFrame& frame = frames_.front();
    storage.start(frame.grid->cell_count(), frame.lights.seen(precision_).points, frame.lights.seen(precision_).spots);
  }

  // All timed frames. A grid that changes between frames (fit) is built within: that is what such a method costs.
  void assign_once() {
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const grid::Grid* grid = frames_[i].grid.get();
      if (grid != built_for_) assigner_->build(*grid);
      built_for_ = grid;
      assigner_->assign(frames_[i].lights.seen(precision_), lists_[i]);
    }
  }

  void convert_once(assign::Storage& storage) const {
    for (const assign::Lists& lists : lists_) storage.store(lists);
  }

  // What the tight storage writes for these lists.
  void prepare_floor() {
    const assign::StorageRow& packed = *assign::find_storage("packed");
    const auto storage = packed.make(assign::Params(packed.params));
    start(*storage);
    std::vector<std::size_t> bytes;
    for (const assign::Lists& lists : lists_) {
      storage->store(lists);
      bytes.push_back(storage->use().upload_bytes);
    }
    write_floor_.set_bytes(bytes);
  }

  const std::vector<TimedFrame>& frames_;
  std::size_t precision_;
  double min_ns_;
  std::unique_ptr<assign::Assigner> assigner_;
  const grid::Grid* built_for_ = nullptr;
  std::vector<assign::Lists> lists_;
  std::vector<Store> stores_;
  WriteFloor write_floor_;
  std::vector<double> build_ns_, assign_ns_, floor_ns_;
  Repeated assign_{[this] { assign_once(); }, min_ns_};
  Repeated floor_{[this] { write_floor_.copy_once(); }, min_ns_ / 10.0};
};

}  // namespace

std::vector<TimingResult> timing_pass(const Config& config, const GroupPlan& group, const PathFrames& path,
                                      const std::function<void(int round)>& on_round, const std::atomic<bool>& stop) {
  const std::vector<TimedFrame> frames = timed_frames(config, group, path);
  const std::vector<Method> methods = methods_of(group);
  std::vector<std::unique_ptr<Track>> tracks;
  for (const Method& method : methods) tracks.push_back(std::make_unique<Track>(config, group, method, frames));

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
