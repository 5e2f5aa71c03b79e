#pragma once
// A ball's centre against a pyramid slab and against shells, decided in exact numbers (geom/numbers/dyadic.h).

#include "geom/ball/nearest_depth.h"
#include "geom/ball/pyramid_slab.h"
#include "geom/numbers/dyadic.h"

namespace clusterbench::geom {

inline Dyadic slope_of(Side side, float low, float high) {
  return side == Side::low ? Dyadic(low) : side == Side::high ? Dyadic(high) : Dyadic();
}

// Is low <= at <= high, or is `at` beyond the given side?
inline bool is_on(Side side, const Dyadic& low, const Dyadic& at, const Dyadic& high) {
  if (side == Side::low) return at <= low;
  if (side == Side::high) return at >= high;
  return low <= at && at <= high;
}

// A centre against a slab.
class ExactSlab {
 public:
  ExactSlab(const Dyadic& x, const Dyadic& y, const Dyadic& depth, const PyramidSlab& slab)
      : x_(x), y_(y), depth_(depth), slab_(slab) {}

  // The planes on which the nearest point lies: the guess, if it is right.
  NearestDepth nearest(NearestDepth guess) const {
    if (is_nearest(guess)) return guess;
    constexpr Side k_sides[] = {Side::low, Side::between, Side::high};
    for (const Side depth : k_sides)
      for (const Side x : k_sides)
        for (const Side y : k_sides) {
          guess.x = x;
          guess.y = y;
          guess.depth = depth;
          if (is_nearest(guess)) return guess;
        }
    return guess;  // unreachable: a convex function has a minimum
  }

  // Squared distance to the nearest point <= squared_radius?
  bool is_within(const NearestDepth& nearest, const Dyadic& squared_radius) const {
    const Dyadic slope_x = slope_of(nearest.x, slab_.x0, slab_.x1), slope_y = slope_of(nearest.y, slab_.y0, slab_.y1);
    const bool has_x = nearest.x != Side::between, has_y = nearest.y != Side::between;
    if (nearest.depth != Side::between) {
      const Dyadic at = end_of(nearest.depth);
      Dyadic square = squared(at - depth_);
      if (has_x) square = square + squared(x_ - slope_x * at);
      if (has_y) square = square + squared(y_ - slope_y * at);
      return square <= squared_radius;
    }
    // The centre's distance from a line through the eye, or from a plane.
    if (has_x && has_y)
      return squared(x_ - slope_x * depth_) + squared(y_ - slope_y * depth_) + squared(x_ * slope_y - y_ * slope_x) <=
             squared_radius * (Dyadic(1.0) + squared(slope_x) + squared(slope_y));
    if (has_x) return squared(x_ - slope_x * depth_) <= squared_radius * (Dyadic(1.0) + squared(slope_x));
    if (has_y) return squared(y_ - slope_y * depth_) <= squared_radius * (Dyadic(1.0) + squared(slope_y));
    return true;
  }

  // The nearest point's depth, `depth` / `scale`, if it is between the ends. The point is the foot of the centre on the
  // plane or line on which it lies; for the line of two planes with n = (slope_x, slope_y, 1) it is centre·n / n².
  struct Foot {
    Dyadic depth, scale;
  };
  Foot foot(Side x, Side y) const {
    Foot foot{depth_, Dyadic(1.0)};
    if (x != Side::between) add(foot, slope_of(x, slab_.x0, slab_.x1), x_);
    if (y != Side::between) add(foot, slope_of(y, slab_.y0, slab_.y1), y_);
    return foot;
  }

 private:
  static void add(Foot& foot, const Dyadic& slope, const Dyadic& coordinate) {
    foot.depth = foot.depth + slope * coordinate;
    foot.scale = foot.scale + squared(slope);
  }
  Dyadic end_of(Side depth) const { return Dyadic(depth == Side::low ? slab_.near : slab_.far); }

  // A convex function has its minimum where the derivative along depth is 0, or at an end where it points out of the
  // slab.
  bool is_nearest(const NearestDepth& guess) const {
    if (guess.depth == Side::high && slab_.far == k_infinity) return false;
    if (guess.depth != Side::between) {
      const Dyadic at = end_of(guess.depth);
      if (!are_on_sides(guess, at, Dyadic(1.0))) return false;
      const Foot foot = this->foot(guess.x, guess.y);
      const int slope = (foot.scale * at - foot.depth).sign();
      return guess.depth == Side::low ? slope >= 0 : slope <= 0;
    }
    const Foot foot = this->foot(guess.x, guess.y);
    if (Dyadic(slab_.near) * foot.scale > foot.depth) return false;
    if (slab_.far < k_infinity && Dyadic(slab_.far) * foot.scale < foot.depth) return false;
    return are_on_sides(guess, foot.depth, foot.scale);
  }
  bool are_on_sides(const NearestDepth& guess, const Dyadic& depth, const Dyadic& scale) const {
    return is_on(guess.x, Dyadic(slab_.x0) * depth, x_ * scale, Dyadic(slab_.x1) * depth) &&
           is_on(guess.y, Dyadic(slab_.y0) * depth, y_ * scale, Dyadic(slab_.y1) * depth);
  }

  const Dyadic &x_, &y_, &depth_;
  const PyramidSlab& slab_;
};

// A centre against the shells of a pyramid, see view_of().
class ExactPyramid {
 public:
  ExactPyramid(const Dyadic& x, const Dyadic& y, const Dyadic& depth, const PyramidSlab& pyramid)
      : x_(x), y_(y), depth_(depth), pyramid_(pyramid), slab_(x, y, depth, pyramid_) {}

  bool is_within(const NearestDepth& guess, const Dyadic& near, const Dyadic& far, const Dyadic& squared_radius) const {
    const NearestDepth nearest = slab_.nearest(guess);
    const Dyadic excess = squared(x_) + squared(y_) + squared(depth_) - squared_radius;  // of the eye
    if (nearest.depth == Side::low) return is_near_rays(near, excess);
    const ExactSlab::Foot foot = slab_.foot(nearest.x, nearest.y);
    const Dyadic square = squared_distance(foot, nearest), scale_square = squared(foot.scale);
    if (square.sign() == 0) return is_near_rays(near, excess);
    // t² - 2 t |q| + |p|² <= r² for |q| = sqrt(square) / scale.
    const auto reaches = [&](const Dyadic& t) {
      return at_most_root((squared(t) + excess) * foot.scale, Dyadic(2.0) * t, square);
    };
    if (square < squared(near) * scale_square) return reaches(near);
    if (square > squared(far) * scale_square) return reaches(far);
    return slab_.is_within(nearest, squared_radius);
  }

  // Is t u·p <= most for all directions u of the pyramid and near <= t <= far?
  bool is_ahead_at_most(const NearestDepth& guess, const Dyadic& near, const Dyadic& far, const Dyadic& most) const {
    const NearestDepth nearest = slab_.nearest(guess);
    if (nearest.depth != Side::low) {
      const ExactSlab::Foot foot = slab_.foot(nearest.x, nearest.y);
      const Dyadic square = squared_distance(foot, nearest);
      // far |q| <= most, |q| = sqrt(square) / scale
      if (square.sign() != 0) return at_most_root(-(most * foot.scale), -far, square);
    }
    return !any_ray(pyramid_, [&](float x, float y) {
      const Dyadic slope_x(x), slope_y(y);
      const Dyadic ahead = near * (slope_x * x_ + slope_y * y_ + depth_);
      return !at_most_root(ahead, most, Dyadic(1.0) + squared(slope_x) + squared(slope_y));
    });
  }

 private:
  // The squared distance of the foot from the eye, times the square of its scale.
  Dyadic squared_distance(const ExactSlab::Foot& foot, const NearestDepth& nearest) const {
    const auto coordinate = [&](Side side, const Dyadic& of_center, float low, float high) {
      return side == Side::between ? of_center * foot.scale : slope_of(side, low, high) * foot.depth;
    };
    return squared(coordinate(nearest.x, x_, pyramid_.x0, pyramid_.x1)) +
           squared(coordinate(nearest.y, y_, pyramid_.y0, pyramid_.y1)) + squared(foot.depth);
  }

  // t² - 2 t (u·p) + |p|² <= r² for a ray u.
  bool is_near_rays(const Dyadic& t, const Dyadic& excess) const {
    const Dyadic above = squared(t) + excess, twice = Dyadic(2.0) * t;
    return any_ray(pyramid_, [&](float x, float y) {
      const Dyadic slope_x(x), slope_y(y);
      const Dyadic ahead = slope_x * x_ + slope_y * y_ + depth_;
      return at_most_root(-(twice * ahead), -above, Dyadic(1.0) + squared(slope_x) + squared(slope_y));
    });
  }

  const Dyadic &x_, &y_, &depth_;
  const PyramidSlab pyramid_;
  const ExactSlab slab_;
};

}  // namespace clusterbench::geom
