#include <algorithm>
#include <cmath>

#include "geom/ball/axis_gap.h"
#include "geom/ball/ball_decider.h"
#include "geom/ball/nearest_depth.h"

namespace clusterbench::geom {
namespace {

// Points p of a convex set in a ball satisfy |p - q|² <= radius² - |q - center|², where q is the set's nearest point to
// the centre.
double play_of(const Bounded& excess, double undershoot) {
  if (excess.value == 0.0 && excess.error == 0.0 && undershoot == 0.0) return 0.0;
  return bounded::rounded_up(std::sqrt(bounded::rounded_up(std::max(0.0, -excess.value) + excess.error + undershoot)));
}

}  // namespace

std::optional<NearestPoint> BallDecider::nearest_point(const Box& cell) const {
  const auto gap = [](float low, const Bounded& at, float high) {
    return gap_between(Bounded(low), at, Bounded(high));
  };
  const Gap<Bounded> x = gap(cell.lo.x, x_, cell.hi.x), y = gap(cell.lo.y, y_, cell.hi.y),
                     z = gap(cell.lo.z, -depth_, cell.hi.z);
  const Bounded excess = x.size * x.size + y.size * y.size + z.size * z.size - squared_radius_;
  return NearestPoint{{across(x), across(y), across(z)}, play_of(excess, 0.0)};
}

std::optional<NearestPoint> BallDecider::nearest_point(const FrustumCell& cell) const {
  if (cell.orthographic) return nearest_point(Box{{cell.x0, cell.y0, -cell.depth1}, {cell.x1, cell.y1, -cell.depth0}});
  const PyramidSlab slab{cell.x0, cell.x1, cell.y0, cell.y1, cell.depth0, cell.depth1};
  const NearestDepth nearest = nearest_between(x_, y_, depth_, slab);
  return NearestPoint{way_to(nearest, x_, y_, depth_, slab),
                      play_of(nearest.square - squared_radius_, nearest.undershoot())};
}

// For a centre behind the eye: the corner on the near shell whose ray leans most towards the centre, if that is
// certain.
std::optional<NearestPoint> BallDecider::nearest_ray(const PyramidView& view, const ShellCell& cell) const {
  if (view.nearest.steepness > 0.0 && !(-view.along).is_surely_above(0.0)) return std::nullopt;
  std::optional<NearestPoint> nearest;
  Bounded most_ahead;
  bool is_certain = true;
  any_ray(pyramid_of(cell), [&](float x, float y) {
    const Point3<Bounded> ray{x, y, -1.0};
    const Bounded length = sqrt(dot(ray, ray)), ahead = dot(ray, center_) / length;
    const bool is_next = !nearest || ahead.value > most_ahead.value;
    if (nearest) {
      const Bounded less = is_next ? ahead - most_ahead : most_ahead - ahead;
      is_certain = is_certain && (-less).is_surely_not_above(0.0);
    }
    if (!is_next) return false;
    most_ahead = ahead;
    nearest = NearestPoint{(Bounded(cell.distance0) / length) * ray - center_, k_infinity};
    return false;
  });
  return is_certain ? nearest : std::nullopt;
}

// For a centre that is not behind, see view_of(). If the near shell does not cut off t, the distance of the nearest
// point from the eye, the pyramid up to the far shell is the convex set. Otherwise points p = s u, s >= near = t, are
// at least as far from the centre c as from c's foot a u* on the nearest ray, beside which c lies: |p - c|² >= |p - a
// u*|² + |c|² - a². With e = radius² - |c|² + a² - (near - a)² that leaves |p - near u*|² <= e near / a.
std::optional<NearestPoint> BallDecider::nearest_point(const ShellCell& cell) const {
  const PyramidView view = view_of(cell);
  const Bounded near(cell.distance0), far(cell.distance1);
  if (view.is_behind) return nearest_ray(view, cell);
  if (!view.along.is_surely_above(0.0)) return std::nullopt;
  const Point3<Bounded> way = way_to(view.nearest, x_, y_, depth_, pyramid_of(cell));
  const Gap<Bounded> gap = gap_between(near, view.along, far);
  const Bounded excess = view.nearest.square + gap.size * gap.size - squared_radius_;
  double play = play_of(excess, view.nearest.undershoot());
  if (gap.side == Side::between && gap.size.error == 0.0) return NearestPoint{way, play};
  if (gap.side == Side::low || gap.size.error > 0.0) {
    const double factor = view.along.value - view.along.error;
    if (play > 0.0)
      play = factor > 0.0 ? bounded::rounded_up(play * std::sqrt(std::max(1.0, near.value / factor))) : k_infinity;
  }
  // From the foot further along the ray.
  const Bounded further = across(gap) / view.along;
  return NearestPoint{way + further * (center_ + way), play};
}

}  // namespace clusterbench::geom
