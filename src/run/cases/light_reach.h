#pragma once
// Where the lights of frames are: what grids that go by them, and samples, are made with.

#include "view/frame.h"

namespace clusterbench::run {

// Of lights that have an end and reach something: one without an end has no box, and one of range 0 reaches nothing.
class LightReach {
 public:
  void add(const view::Frame& frame);

  // The box around their balls; without extent at the origin where there are none.
  const Vec3d& lo() const { return lo_; }
  const Vec3d& hi() const { return hi_; }
  // How far those in view of a frame reach at most from its eye: what is behind it, or beside its view, is in no cell.
  double far_m() const { return far_m_; }

 private:
  Vec3d lo_{0.0}, hi_{0.0};
  double far_m_ = 0.0;
  bool is_empty_ = true;
};

}  // namespace clusterbench::run
