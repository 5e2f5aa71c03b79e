#pragma once
// The frames of a pass on several threads: the next ones are prepared while methods work on those before. Each method
// gets all frames in the path's order, so that results are the same for any number of threads.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include "core/stop.h"
#include "core/work_in_order.h"
#include "run/passes/frame_lanes.h"
#include "run/passes/frame_work.h"

namespace clusterbench::run {

// Frames that one pass keeps in memory take at most this much, or there is only one.
inline constexpr std::size_t k_most_bytes_ahead = std::size_t{64} << 20;

template <class Frame>
class FramePipeline {
 public:
  FramePipeline(const FrameWork<Frame>& work, int frames, int threads, const Stop& stop)
      : work_(work), frames_(frames), threads_(threads), stop_(stop), pool_(threads) {}

  // False if stopped before the end. Throws what one thread would throw: of the work that throws, the first by frame,
  // then by user.
  bool run() {
    while (begun_ < frames_ && !stop_) {
      Block block = prepared_block();
      if (stop_) break;
      if (begun_ == 1 && !unready_ && overlaps()) return run_overlapping(std::move(block.front()));
      use(block);
      if (unready_) std::rethrow_exception(unready_);
    }
    return !stop_;
  }

 private:
  using Block = std::vector<std::unique_ptr<Frame>>;

  // The size of the first frame tells how many may wait. If it is one, all threads share its preparation.
  bool overlaps() const { return threads_ > 1 && work_.users_apart && !work_.after && most_frames() > 1; }
  std::size_t most_frames() const {
    constexpr std::size_t k_frames_of_thread = 4;
    const std::size_t wanted =
        threads_ == 1 || work_.after ? 1 : k_frames_of_thread * static_cast<std::size_t>(threads_);
    return std::clamp(k_most_bytes_ahead / most_bytes_, std::size_t{1}, wanted);
  }

  bool run_overlapping(std::unique_ptr<Frame> first) {
    FrameLanes<Frame> lanes(work_, frames_, most_frames(), stop_);
    lanes.add(std::move(first));
    return lanes.run(pool_);
  }

  // The first block is one frame.
  Block prepared_block() {
    Block block;
    const std::size_t size = begun_ == 0 ? 1 : most_frames();
    try {
      for (; begun_ < frames_ && block.size() < size && !stop_; ++begun_) block.push_back(work_.begin(begun_));
    } catch (...) {
      unready_ = std::current_exception();
    }
    std::vector<std::exception_ptr> failures(block.size());
    each_in_order(pool_, block.size(), [&](std::size_t i) { failures[i] = failure_of_preparing(*block[i]); });
    keep_prepared(block, failures);
    return block;
  }
  std::exception_ptr failure_of_preparing(Frame& frame) const {
    try {
      if (!stop_) work_.prepare(frame);
      return nullptr;
    } catch (...) {
      return std::current_exception();
    }
  }
  void keep_prepared(Block& block, const std::vector<std::exception_ptr>& failures) {
    const auto failed = std::ranges::find_if(failures, [](const auto& failure) { return failure != nullptr; });
    if (failed != failures.end()) unready_ = *failed;
    block.resize(static_cast<std::size_t>(failed - failures.begin()));
    if (stop_) return;
    for (const std::unique_ptr<Frame>& frame : block) most_bytes_ = std::max(most_bytes_, work_.bytes(*frame));
  }

  void use(const Block& block) {
    for (const std::unique_ptr<Frame>& frame : block) {
      if (work_.users_apart)
        use_apart(*frame);
      else
        for (const FrameUser<Frame>& user : work_.users) use(user, *frame);
      if (work_.after && !stop_) work_.after(*frame);
    }
  }
  // Leaders first.
  void use_apart(const Frame& frame) {
    for (const bool is_led : {false, true})
      each_in_order(pool_, work_.users.size(), [&](std::size_t i) {
        const FrameUser<Frame>& user = work_.users[i];
        if ((user.leader != FrameUser<Frame>::k_none) == is_led) use(user, frame);
      });
  }
  void use(const FrameUser<Frame>& user, const Frame& frame) {
    if (!stop_) user.use(frame);
  }

  const FrameWork<Frame>& work_;
  int frames_, begun_ = 0;
  int threads_;
  Stop stop_;
  ThreadPool pool_;
  std::size_t most_bytes_ = 1;
  std::exception_ptr unready_;  // why there is no frame behind those of the block
};

}  // namespace clusterbench::run
