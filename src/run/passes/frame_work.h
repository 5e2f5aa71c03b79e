#pragma once
// What a pass does with each of its frames.

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace clusterbench::run {

// Gets all frames of a pass in order, on any thread.
template <class Frame>
struct FrameUser {
  static constexpr std::size_t k_none = static_cast<std::size_t>(-1);

  std::function<void(const Frame&)> use;
  std::size_t leader = k_none;  // an earlier user, which has each frame before this one
  // A leader is at most this many frames ahead of the users behind it: what it leaves for them has so many places.
  int most_ahead = 2;
  // May work on several frames at once; begins them in order.
  bool is_concurrent = false;
};

template <class Frame>
struct FrameWork {
  // Makes a frame: one at a time, in the path's order.
  std::function<std::unique_ptr<Frame>(int index)> begin;
  // The rest of the frame, which does not depend on other frames: on any thread.
  std::function<void(Frame&)> prepare;
  // The size of a prepared frame.
  std::function<std::size_t(const Frame&)> bytes;
  // Different users work at the same time.
  std::vector<FrameUser<Frame>> users = {};
  // After all users of a frame, on the calling thread. If it is set, no user is ahead of the others.
  std::function<void(const Frame&)> after = {};
  // False: begin and the users are called by the calling thread, one after the other.
  bool users_apart = true;
};

}  // namespace clusterbench::run
