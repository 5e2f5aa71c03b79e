#pragma once
// Frames that do not depend on each other: whichever thread is free rates the next one.

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "search/best_frames.h"
#include "search/frame_rater.h"

namespace clusterbench::search {

class FramesInTurn {
 public:
  // `frame_of(i)` must give the same frame from any thread.
  FramesInTurn(int count, std::function<RatedFrame(int)> frame_of)
      : frame_of_(std::move(frame_of)), values_(static_cast<std::size_t>(count)) {}

  // A frame that no thread has taken yet.
  std::optional<int> next() {
    const int frame = next_++;
    return frame < static_cast<int>(values_.size()) ? std::optional(frame) : std::nullopt;
  }
  void rate(int frame, FrameRater& rater) {
    values_[static_cast<std::size_t>(frame)] = rater.rate(frame_of_(frame).choice);
  }

  // These are for the time after the threads' end. Frames that were not rated are left out.
  int rated() const;
  double sum() const;
  void add_to(BestFrames& best) const;  // in their order

 private:
  std::function<RatedFrame(int)> frame_of_;
  std::vector<std::optional<double>> values_;
  std::atomic<int> next_{0};
};

}  // namespace clusterbench::search
