#pragma once
// The best frames among many, without near duplicates.

#include <vector>

#include "search/path_scene.h"

namespace clusterbench::search {

struct RatedFrame {
  double value = 0.0;
  std::vector<double> point;  // of the search's cube
  FrameChoice choice;
};

class BestFrames {
 public:
  // Near duplicates: eyes closer than `near_m`, directions within 30 degrees, and the same moment. Only the best of
  // them is kept, and the first of equal ones.
  BestFrames(std::size_t most, double near_m) : most_(most), near_m_(near_m) {}

  void add(const RatedFrame& frame);
  void add_all(const BestFrames& others);
  // Best first; of equal ones the first that was added.
  const std::vector<RatedFrame>& frames() const { return frames_; }
  // Whether a frame of that value could enter the list.
  bool can_enter(double value) const { return frames_.size() < most_ || value > frames_.back().value; }

 private:
  bool are_near(const FrameChoice& a, const FrameChoice& b) const;

  std::size_t most_;
  double near_m_;
  std::vector<RatedFrame> frames_;
};

}  // namespace clusterbench::search
