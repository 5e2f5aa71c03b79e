#pragma once
// Finds the true cells of one light among cells of any kind: a filter decides most of them, an exact test the rest.
// Counts the decisions of both.

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "geom/ball/ball_decider.h"
#include "geom/box/box_decider.h"
#include "geom/box/quick_box.h"
#include "geom/shapes/ball_and_cone.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"
#include "geom/spot/spot_decider.h"
#include "grid/broad_phase.h"

namespace clusterbench::measure {

// A spot in double precision, for tests that decide most cells at once.
struct QuickCone {
  Vec3d apex, axis;
  double range, cos_angle, sin_angle, slack;

  QuickCone(const geom::SpotVolume& spot, const Vec3d& apex_at);

  // Whether a ball is outside of the cone's side, behind its apex or beyond its range.
  bool surely_misses(const geom::Ball& around) const {
    const Vec3d v = Vec3d(around.center) - apex;
    const double along = glm::dot(v, axis);
    const double reach = around.radius * (1.0 + 0x1p-30) + 0x1p-30 * glm::length(v) + slack;
    if (along < -reach || glm::length(v) > range + reach) return true;
    return cos_angle * glm::length(v - along * axis) - sin_angle * along > reach;
  }
  bool surely_holds(const Vec3d& p) const {
    const Vec3d v = p - apex;
    const double along = glm::dot(v, axis), size = glm::length(v), rounding = 0x1p-30 * size + slack;
    return size < range - rounding && sin_angle * along - cos_angle * glm::length(v - along * axis) > rounding;
  }
};

// The true cells of one light, in runs of consecutive cells.
struct LightCells {
  struct Run {
    std::uint32_t first_cell, count;
  };
  std::vector<Run> runs;
  std::uint64_t filter_decided = 0, exact_decided = 0, undecided = 0;

  void add(std::uint32_t first_cell, std::uint32_t count = 1) {
    if (!runs.empty() && runs.back().first_cell + runs.back().count == first_cell)
      runs.back().count += count;
    else
      runs.push_back({first_cell, count});
  }
};

class LightSearch {
 public:
  explicit LightSearch(const geom::LightVolume& light);

  bool is_spot() const { return spot_.has_value(); }
  bool is_box() const { return box_.has_value(); }
  bool is_endless() const { return std::isinf(ball_.radius); }
  const grid::BallInSpace& ball() const { return ball_; }
  const geom::BallDecider& ball_decider() const { return decider_; }  // of a point with an end
  const geom::SpotDecider& spot_decider() const { return *spot_; }    // of a spot
  const geom::BoxDecider& box_decider() const { return *box_; }       // of a box

  // The filter's verdict on a cell, or on a part of one. `around`: a ball around it, used for spots and boxes only.
  template <class Shape>
  geom::Verdict filtered(const Shape& shape, const geom::Ball& around) const {
    if (box_) {
      if (quick_box_->surely_misses(Vec3d(around.center), around.radius)) return geom::Verdict::no;
      const Vec3d middle(around.center);
      return quick_box_->surely_holds(middle) && is_well_inside(shape, middle) ? geom::Verdict::yes
                                                                               : geom::Verdict::uncertain;
    }
    if (!spot_) return is_endless() ? geom::Verdict::yes : geom::Verdict::uncertain;
    if (cone_->surely_misses(around)) return geom::Verdict::no;
    const Vec3d middle(around.center);
    return cone_->surely_holds(middle) && is_well_inside(shape, middle) ? geom::Verdict::yes : geom::Verdict::uncertain;
  }
  // The exact verdict, for cells that the filter left uncertain. Uncertain: undecided.
  template <class Shape>
  geom::Verdict decided(const Shape& shape) const {
    if (spot_) return spot_->meets(shape);
    if (box_) return box_->meets(shape) ? geom::Verdict::yes : geom::Verdict::no;
    return decider_.meets(shape) ? geom::Verdict::yes : geom::Verdict::no;
  }

  // Adds a cell unless test(), which filters and decides, returns no; counts the kind of decision.
  template <class Test>
  void decide(std::uint32_t cell, Test&& test) {
    const std::uint64_t before = exact_decisions();
    const geom::Verdict verdict = test();
    ++(verdict == geom::Verdict::uncertain ? found_.undecided
       : exact_decisions() != before       ? found_.exact_decided
                                           : found_.filter_decided);
    if (verdict != geom::Verdict::no) found_.add(cell);
  }
  // Adds cells that are touched for certain.
  void add_touched(std::uint32_t first_cell, std::uint32_t count) {
    found_.filter_decided += count;
    found_.add(first_cell, count);
  }

  LightCells&& found() && { return std::move(found_); }

 private:
  static bool is_well_inside(const geom::Cell& cell, const Vec3d& p);
  std::uint64_t exact_decisions() const {
    return decider_.exact_decisions() + (spot_ ? spot_->exact_decisions() : 0) + (box_ ? box_->exact_decisions() : 0);
  }

  grid::BallInSpace ball_;
  geom::BallDecider decider_;
  std::optional<geom::SpotDecider> spot_;  // this and the cone: for spots
  std::optional<QuickCone> cone_;
  std::optional<geom::BoxDecider> box_;  // this and the quick one: for boxes
  std::optional<geom::QuickBox> quick_box_;
  LightCells found_;
};

}  // namespace clusterbench::measure
