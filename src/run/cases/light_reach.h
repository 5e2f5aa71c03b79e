#pragma once
// The extent of the lights over frames: input for grids that depend on lights, and for samples.

#include <vector>

#include "view/frame.h"

namespace clusterbench::run {

// Covers lights with a finite, positive range: an infinite one has no box, and one of range 0 reaches nothing.
class LightReach {
 public:
  // `in_view`: grid::lights_in_view() of the frame.
  void add(const view::Frame& frame, const std::vector<bool>& in_view);
  void add(const LightReach& other);

  // The box around the lights' balls; a point at the origin without lights.
  const Vec3d& lo() const { return lo_; }
  const Vec3d& hi() const { return hi_; }
  // The largest distance from a frame's eye at which a light in view still reaches a point; lights behind the eye or
  // beside the view are in no cell.
  double far_m() const { return far_m_; }

 private:
  void add_box(const Vec3d& lo, const Vec3d& hi);

  Vec3d lo_{0.0}, hi_{0.0};
  double far_m_ = 0.0;
  bool is_empty_ = true;
};

}  // namespace clusterbench::run
