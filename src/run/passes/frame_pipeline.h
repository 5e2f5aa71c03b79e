#pragma once
// The frames of a pass on several threads: the next ones are prepared while methods work on those before. Each method
// gets all frames in the path's order, so that results are the same for any number of threads.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/stop.h"
#include "core/work_in_order.h"

namespace clusterbench::run {

// Frames that one pass keeps ahead take at most this much memory, or there is only one.
inline constexpr std::size_t k_most_bytes_ahead = std::size_t{64} << 20;

// Work on the frames of a pass.
template <class Frame>
struct FrameWork {
  // Makes a frame: on the calling thread, in the path's order.
  std::function<std::unique_ptr<Frame>(int index)> begin;
  // The rest of the frame, which does not depend on other frames: on any thread.
  std::function<void(Frame&)> prepare;
  // The size of a prepared frame.
  std::function<std::size_t(const Frame&)> bytes;
  // Each gets all frames in order. Different users work at the same time, on any thread.
  std::vector<std::function<void(const Frame&)>> users = {};
  // After all users of a frame, on the calling thread. If it is set, no user is ahead of the others.
  std::function<void(const Frame&)> after = {};
  // False: the users are called by the calling thread, one after the other.
  bool users_apart = true;
};

template <class Frame>
class FramePipeline {
 public:
  FramePipeline(const FrameWork<Frame>& work, int frames, int threads, const Stop& stop)
      : work_(work), frames_(frames), threads_(threads), stop_(stop), pool_(threads) {}

  // False if stopped before the end. Throws what one thread would throw: of the work that throws, the first by frame,
  // then by user.
  bool run() {
    Block ready;
    while (begun_ < frames_ || !ready.empty()) {
      Block next = begun_block();
      work_on(ready, next);
      if (!overlaps()) use(next);
      if (stop_) return false;
      ready = overlaps() ? std::move(next) : Block{};
    }
    if (unready_) std::rethrow_exception(unready_);
    return true;
  }

 private:
  using Block = std::vector<std::unique_ptr<Frame>>;

  // What users of a block throw: the first by frame, then by user.
  struct Failures {
    std::mutex adding;
    std::pair<std::size_t, std::size_t> first{};  // frame of the block, user
    std::exception_ptr failure;

    void add(std::size_t frame, std::size_t user) {
      const std::lock_guard lock(adding);
      if (failure && first < std::pair(frame, user)) return;
      first = {frame, user};
      failure = std::current_exception();
    }
  };

  bool overlaps() const { return threads_ > 1 && work_.users_apart && !work_.after; }

  Block begun_block() {
    Block block;
    try {
      for (; begun_ < frames_ && block.size() < block_size_ && !stop_; ++begun_) block.push_back(work_.begin(begun_));
    } catch (...) {
      end_with(std::current_exception());
    }
    return block;
  }
  // No frame comes after those that are ready: users of these may throw before.
  void end_with(std::exception_ptr failure) {
    unready_ = std::move(failure);
    begun_ = frames_;
  }

  // All users of the ready frames, and the preparation of the next ones. A user has more to do than the preparation of
  // one frame, so users begin first.
  void work_on(const Block& ready, Block& next) {
    const std::size_t users = ready.empty() ? 0 : work_.users.size();
    Failures failures;
    std::vector<std::exception_ptr> unprepared(next.size());
    each_in_order(pool_, users + next.size(), [&](std::size_t i) {
      if (i < users)
        use_all(ready, i, failures);
      else if (!stop_)
        unprepared[i - users] = prepare(*next[i - users]);
    });
    if (failures.failure) std::rethrow_exception(failures.failure);
    const auto failed = std::ranges::find_if(unprepared, [](const auto& failure) { return failure != nullptr; });
    if (failed != unprepared.end()) {
      next.resize(static_cast<std::size_t>(failed - unprepared.begin()));
      end_with(*failed);
    }
    if (!stop_) size_next_block(next);
  }
  std::exception_ptr prepare(Frame& frame) const {
    try {
      work_.prepare(frame);
      return nullptr;
    } catch (...) {
      return std::current_exception();
    }
  }
  void use_all(const Block& ready, std::size_t user, Failures& failures) {
    for (std::size_t frame = 0; frame < ready.size(); ++frame) try {
        use(user, *ready[frame]);
      } catch (...) {
        return failures.add(frame, user);
      }
  }

  void use(const Block& block) {
    for (const std::unique_ptr<Frame>& frame : block) {
      each_user([&](std::size_t user) { use(user, *frame); });
      if (work_.after && !stop_) work_.after(*frame);
    }
  }
  template <class Work>
  void each_user(const Work& work) {
    if (work_.users_apart) return each_in_order(pool_, work_.users.size(), work);
    for (std::size_t user = 0; user < work_.users.size(); ++user) work(user);
  }
  void use(std::size_t user, const Frame& frame) {
    if (!stop_) work_.users[user](frame);
  }

  // The first block is one frame, whose size tells how many may wait.
  void size_next_block(const Block& prepared) {
    for (const std::unique_ptr<Frame>& frame : prepared) most_bytes_ = std::max(most_bytes_, work_.bytes(*frame));
    constexpr std::size_t k_frames_of_thread = 4, k_blocks = 2;
    const bool is_single = threads_ == 1 || work_.after;
    const std::size_t wanted = is_single ? 1 : k_frames_of_thread * static_cast<std::size_t>(threads_);
    block_size_ = std::clamp(k_most_bytes_ahead / (k_blocks * most_bytes_), std::size_t{1}, wanted);
  }

  const FrameWork<Frame>& work_;
  int frames_, begun_ = 0;
  int threads_;
  Stop stop_;
  ThreadPool pool_;
  std::size_t block_size_ = 1, most_bytes_ = 1;
  std::exception_ptr unready_;  // why there is no frame behind those that are ready
};

}  // namespace clusterbench::run
