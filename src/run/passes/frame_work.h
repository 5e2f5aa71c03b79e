#pragma once
// What a pass does with each of its frames.

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace clusterbench::run {

template <class Frame>
struct FrameWork {
  // Makes a frame: one at a time, in the path's order.
  std::function<std::unique_ptr<Frame>(int index)> begin;
  // The rest of the frame, which does not depend on other frames: on any thread.
  std::function<void(Frame&)> prepare;
  // The size of a prepared frame.
  std::function<std::size_t(const Frame&)> bytes;
  // Each gets all frames in order. Different users work at the same time, on any thread.
  std::vector<std::function<void(const Frame&)>> users = {};
  // After all users of a frame, on the calling thread. If it is set, no user is ahead of the others.
  std::function<void(const Frame&)> after = {};
  // False: begin and the users are called by the calling thread, one after the other.
  bool users_apart = true;
};

}  // namespace clusterbench::run
