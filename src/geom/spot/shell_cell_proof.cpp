#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geom/numbers/wide_enclosure.h"
#include "geom/numbers/wide_float.h"
#include "geom/search/eye_distances.h"
#include "geom/spot/proof_by_search.h"
#include "geom/spot/proof_steps.h"

namespace clusterbench::geom {
namespace {

// Points of pyramid ∩ spot on both sides of a shell cell, or in it: the set is convex, so its distances from the eye
// are an interval, and if one point is not too far and one not too near, there is a point that is neither.
class ShellWitness {
 public:
  ShellWitness(const ExactSpot& spot, const ShellCell& cell)
      : spot_(spot),
        planes_(planes_of(cell)),
        squared_near_(squared(exact(cell.distance0))),
        squared_far_(squared(exact(cell.distance1))) {}

  const Planes& planes() const { return planes_; }
  bool is_found() const { return has_near_ && has_far_; }

  void offer(const RationalPoint& p) {
    const Rational square = dot(p, p);
    const bool is_near = square <= squared_far_, is_far = square >= squared_near_;
    if ((has_near_ || !is_near) && (has_far_ || !is_far)) return;
    if (!all_hold(planes_, p) || !surely_holds(spot_, p)) return;
    has_near_ = has_near_ || is_near;
    has_far_ = has_far_ || is_far;
  }

 private:
  const ExactSpot& spot_;
  const Planes planes_;
  const Rational squared_near_, squared_far_;
  bool has_near_ = false, has_far_ = false;
};

// A point of the shell cell at a distance from the eye, in the direction of a vector of the pyramid, is not rational if
// the vector's length is not. Does it certainly lie in the spot's volume?
bool surely_holds(const ExactSpot& spot, const NearestOnShells& on_shell) {
  if (!reaches(spot.apex, spot.range, on_shell)) return false;
  if (!on_shell.distance) return surely_leans(spot, on_shell.towards - spot.apex);
  const Enclosure1024 length = sqrt(Enclosure1024::of(dot(on_shell.towards, on_shell.towards)));
  const Point3<Enclosure1024> p =
      (Enclosure1024::of(*on_shell.distance) / length) * enclosed<Enclosure1024>(on_shell.towards);
  const Point3<Enclosure1024> v = p - enclosed<Enclosure1024>(spot.apex),
                              axis = enclosed<Enclosure1024>(spot.direction);
  const Enclosure1024 along = dot(v, axis), cosine = Enclosure1024::of(spot.half_angle.cosine);
  return along > Enclosure1024(0.0) && along * along > cosine * cosine * dot(v, v) * dot(axis, axis);
}

// Does the volume certainly contain the shell cell's point nearest to the apex, or a corner on the near shell (several
// corners can be equally near)?
bool nearest_surely_meets(const ExactSpot& spot, const ShellCell& cell, const NearestOnShells& nearest) {
  if (nearest.distance && nearest.distance->sign() == 0) return surely_holds(spot, RationalPoint{0, 0, 0});
  if (surely_holds(spot, nearest)) return true;
  const std::array<RationalPoint, 4> rays = rays_of(cell);
  return std::any_of(rays.begin(), rays.end(), [&](const RationalPoint& ray) {
    return surely_holds(spot, NearestOnShells{ray, exact(cell.distance0)});
  });
}

// Adds points of the axis in the pyramid to the witness: first, last and nearest to the eye.
void offer_axis(const ExactSpot& spot, ShellWitness& witness) {
  const std::optional<Span> span = span_within(witness.planes(), spot.apex, spot.direction);
  if (!span) return;
  const Rational square = dot(spot.direction, spot.direction);
  Rational last = spot.range / root_above(square);
  if (span->to) last = std::min(last, *span->to);
  const Rational foot = -dot(spot.apex, spot.direction) / square;
  witness.offer(at(spot, span->from));
  witness.offer(at(spot, std::max(last, span->from)));
  witness.offer(at(spot, std::min(std::max(foot, span->from), std::max(last, span->from))));
}

// Offers the points that a search in Real finds.
template <class Real, class Offer>
void offer_found(const SpotVolume& light, const ShellCell& cell, Offer&& offer) {
  const Volume<Real> volume = volume_of<Real>(light);
  const PyramidReach<Real> reach = pyramid_reach(volume, pyramid_of<Real>(cell.x0, cell.x1, cell.y0, cell.y1));
  if (reach.is_empty || !(reach.inside.margin > reach.tolerance)) return;
  offer(reach.inside.at);
  for (const Point3<Real>& extreme : {reach.nearest, reach.farthest}) {
    // Moved inside far enough to make up for the tolerance.
    const Real share = Real(2) * reach.tolerance / reach.inside.margin;
    if (share < Real(1)) offer(extreme + share * (reach.inside.at - extreme));
  }
}

// The same between bounds of 106 bits.
template <class Real>
bool meets_in_106_bits(const SpotVolume& light, const ShellCell& cell, const Spot106& spot) {
  const Enclosure106 near(cell.distance0), far(cell.distance1);
  bool has_near = false, has_far = false;
  offer_found<Real>(light, cell, [&](const Point3<Real>& found) {
    const Point106 p = point_106(found);
    const Enclosure106 square = dot(p, p);
    const bool is_near = square < far * far, is_far = near * near < square;
    if ((has_near || !is_near) && (has_far || !is_far)) return;
    if (!surely_in_tile(cell.x0, cell.x1, cell.y0, cell.y1, p) || !spot.surely_holds(p)) return;
    has_near = has_near || is_near;
    has_far = has_far || is_far;
  });
  return has_near && has_far;
}

// Does the spot certainly end before it comes as near to the eye as the far shell? On lattices the generator on the
// eye's side often touches the far shell up to rounding: then a plane along this generator, turned by a tiny angle,
// lies between; or a plane across the vector to the generator's end.
bool is_surely_beyond(const ShellCell& cell, const Spot106& spot) {
  const Point106 axis = (Enclosure106(1.0) / sqrt(dot(spot.direction, spot.direction))) * spot.direction;
  const Point106 part = dot(spot.apex, axis) * axis - spot.apex;
  const Enclosure106 size = sqrt(dot(part, part));
  if (!(Enclosure106(0.0) < size)) return false;
  const Point106 across = (Enclosure106(1.0) / size) * part;
  const Point106 generator = spot.cosine * axis + spot.sine * across;
  const Enclosure106 far(cell.distance1), to_nearest = -dot(spot.apex, generator);
  if (!(Enclosure106(0.0) < to_nearest)) return false;
  if (spot.range < to_nearest)
    return spot.surely_separated(Enclosure106(-1.0) * (spot.apex + spot.range * generator), far);
  return spot.surely_separated(spot.cosine * across - (spot.sine + Enclosure106(0x1p-75)) * axis, far);
}

// The whole pyramid, cut where the shell ends.
FrustumCell pyramid_to_far(const ShellCell& cell) {
  return {cell.x0, cell.x1, cell.y0, cell.y1, 0.0f, cell.distance1, false};
}

// Is there a plane between the spot and that pyramid?
template <class Real>
bool is_surely_beside(const SpotVolume& light, const ShellCell& cell, const Spot106& spot) {
  const FrustumCell whole = pyramid_to_far(cell);
  const Polytope<Real> polytope = polytope_of<Real>(whole);
  const Setting<Real> setting(volume_of<Real>(light), polytope);
  const Separation<Real> separation = find_separation(setting);
  if (!(separation.gap > Real(0))) return false;
  std::array<Point106, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) corners[i] = corner_of(whole, i);
  return spot.surely_separated(point_106(separation.normal), corners);
}
template <class Real>
bool is_exactly_beside(const SpotVolume& light, const ShellCell& cell, const ExactSpot& spot) {
  const FrustumCell whole = pyramid_to_far(cell);
  const Polytope<Real> polytope = polytope_of<Real>(whole);
  const Setting<Real> setting(volume_of<Real>(light), polytope);
  const Separation<Real> separation = find_separation(setting);
  return separation.gap > Real(0) && surely_separates(exact(separation.normal), spot, corners_of(whole));
}

// A volume that contains the spot's, larger by about 2^-bits, and turned and moved by as much in directions that are
// unrelated to scene and cell. Directions that are parallel, tangent or zero for the spot are not so for this volume,
// so no formula divides by 0.
template <class Interval>
Volume<Interval> slightly_larger(const ExactSpot& spot, unsigned bits, unsigned angle_bits) {
  const Rational delta = Rational(1) / Rational(Integer(1) << bits);
  const RationalPoint sideways{exact(0.618), exact(-0.382), exact(0.732)},
      back{exact(-0.271), exact(0.828), exact(0.577)};
  // Of length above 1: then adding delta * sideways turns it by less than 3 delta.
  const Rational largest =
      std::max({Rational(abs(spot.direction.x)), Rational(abs(spot.direction.y)), Rational(abs(spot.direction.z))});
  const RationalPoint direction = (1 / largest) * spot.direction + delta * sideways;
  // Moved back by a vector whose angle to the axis is below the half-angle: the cone that starts there contains the old
  // one.
  const Rational lean = spot.half_angle_rad > exact(0x1p-18) ? exact(0x1p-20) : delta;
  const Rational step = delta * (norm_1(spot.apex) + spot.range);
  const RationalPoint apex = spot.apex - step * (direction + lean * back);

  Volume<Interval> volume;
  volume.is_cone = true;
  volume.apex = enclosed<Interval>(apex);
  const Point3<Interval> axis = enclosed<Interval>(direction);
  volume.axis = (Interval(1.0) / length(axis)) * axis;
  volume.range = Interval::of(Rational(spot.range + 4 * step));
  const AngleBounds angle = bounds_of_angle(spot.half_angle_rad + 4 * delta, angle_bits);
  volume.cos_angle = Interval::of(angle.cosine);
  volume.sin_angle = Interval::of(angle.sine);
  return volume;
}

// The same in 106 bits, larger by about 2^-90.
Volume<Enclosure106> slightly_larger(const SpotVolume& light, const Spot106& spot) {
  const Enclosure106 delta(0x1p-90);
  const Point106 sideways = point_106(Point3<double>{0.618, -0.382, 0.732});
  const Point106 back = point_106(Point3<double>{-0.271, 0.828, 0.577});
  const Point106& given = spot.direction;
  const double largest =
      std::max({std::abs(given.x.middle().hi), std::abs(given.y.middle().hi), std::abs(given.z.middle().hi)});
  const Point106 direction = (Enclosure106(1.0) / Enclosure106(largest * (1.0 - 0x1p-40))) * given + delta * sideways;
  const Enclosure106 lean = light.half_angle_rad > 0x1p-18 ? Enclosure106(0x1p-20) : delta;
  const Point106& a = spot.apex;
  const double size = std::abs(a.x.middle().hi) + std::abs(a.y.middle().hi) + std::abs(a.z.middle().hi);
  const Enclosure106 step = delta * Enclosure106(1.01 * (size + spot.range.middle().hi));

  Volume<Enclosure106> volume;
  volume.is_cone = true;
  volume.apex = spot.apex - step * (direction + lean * back);
  volume.axis = (Enclosure106(1.0) / length(direction)) * direction;
  volume.range = spot.range + Enclosure106(4.0) * step;
  const Angle106 angle =
      angle_106(Enclosure106(std::min(light.half_angle_rad, std::numbers::pi / 2.0)) + Enclosure106(4.0) * delta);
  volume.cos_angle = angle.cosine;
  volume.sin_angle = angle.sine;
  return volume;
}

template <class Real>
bool is_surely_outside(const Volume<Real>& volume, const Pyramid<Real>& pyramid, const Point3<Real>& p) {
  const Real zero(0.0);
  for (const HalfSpace<Real>& face : pyramid.faces)
    if (face.margin(p) < zero) return true;
  const Point3<Real> v = p - volume.apex;
  if (dot(v, v) > volume.range * volume.range) return true;
  const Real along = dot(v, volume.axis);
  return along < zero || volume.sin_angle * along < volume.cos_angle * length(v - along * volume.axis);
}

// Does the volume certainly end before it reaches a face?
template <class Real>
bool surely_ends_before(const Volume<Real>& volume, const HalfSpace<Real>& face) {
  const Real margin = face.margin(volume.apex), along = dot(face.normal, volume.axis);
  if (!(margin > Real(0.0))) return false;
  if (!(along < volume.cos_angle)) return volume.range < margin;
  const Real across = length(face.normal - along * volume.axis);
  return volume.range * (volume.cos_angle * along + volume.sin_angle * across) < margin;
}

// The largest and the smallest distance from the eye over pyramid ∩ volume are among the candidates' distances. If all
// candidates that may lie in the set are too near, or all too far, so is the set; without candidates it is empty.
template <class Real>
bool surely_misses(const Volume<Real>& volume, const ShellCell& cell) {
  const Pyramid<Real> pyramid = pyramid_of<Real>(cell.x0, cell.x1, cell.y0, cell.y1);
  const Real near(cell.distance0), far(cell.distance1);
  std::array<bool, 4> reached;
  for (std::size_t i = 0; i < 4; ++i) reached[i] = !surely_ends_before(volume, pyramid.faces[i]);
  bool all_near = true, all_far = true;
  pyramid_candidates(volume, pyramid, reached, Precision<Real>::k_root_bits, [&](const Point3<Real>& p) {
    if ((!all_near && !all_far) || is_surely_outside(volume, pyramid, p)) return;
    const Real square = dot(p, p);
    all_near = all_near && square < near * near;
    all_far = all_far && square > far * far;
  });
  return all_near || all_far;
}

// Does a search in Real find points that prove that the spot meets the shell cell?
template <class Real>
bool meets_by_search(const SpotVolume& light, const ShellCell& cell, const ExactSpot& spot) {
  ShellWitness witness(spot, cell);
  witness.offer(spot.apex);
  offer_axis(spot, witness);
  offer_found<Real>(light, cell, [&](const Point3<Real>& p) { witness.offer(exact(p)); });
  return witness.is_found();
}

// The apex is not in the cell.
template <class Real>
Verdict proven_by_search(const SpotVolume& light, const ShellCell& cell, const ExactSpot& spot) {
  if (surely_leans_away(spot, planes_of(cell))) return Verdict::no;
  if (meets_by_search<Real>(light, cell, spot)) return Verdict::yes;
  return is_exactly_beside<Real>(light, cell, spot) ? Verdict::no : Verdict::uncertain;
}

// For pairs that differ from touching by less than 1024 bits can resolve.
Verdict proven_at_last(const SpotVolume& light, const ShellCell& cell) {
  const ExactSpot spot = exact_spot(light, angle_bits_for<Float3072>());
  const Verdict verdict = proven_by_search<Float3072>(light, cell, spot);
  if (verdict != Verdict::uncertain) return verdict;
  return surely_misses(slightly_larger<Enclosure3072>(spot, 900, 3090), cell) ? Verdict::no : Verdict::uncertain;
}

// A spot at the eye extends equally far in all its directions. Any flat section of the pyramid shows whether one of
// these directions is in the pyramid.
Verdict decide_at_eye(const SpotVolume& light, const ExactSpot& spot, const ShellCell& cell) {
  if (spot.range < exact(cell.distance0)) return Verdict::no;
  if (cell.distance0 == 0.0f) return Verdict::yes;
  SpotVolume endless = light;
  endless.range = std::numeric_limits<double>::infinity();
  return decide_spot(endless, FrustumCell{cell.x0, cell.x1, cell.y0, cell.y1, 1.0f, 2.0f, false});
}

}  // namespace

Verdict decide_spot(const SpotVolume& given, const ShellCell& cell) {
  const SpotVolume light = limited(given, cell.distance1);
  const Spot106 spot_106(light, light.range);
  if (is_surely_beyond(cell, spot_106)) return Verdict::no;
  if (meets_in_106_bits<double>(light, cell, spot_106)) return Verdict::yes;
  if (is_surely_beside<double>(light, cell, spot_106)) return Verdict::no;
  if (is_apart_where_nearest(light, pyramid_to_far(cell), spot_106)) return Verdict::no;
  if (meets_in_106_bits<DoubleDouble>(light, cell, spot_106)) return Verdict::yes;
  if (is_surely_beside<DoubleDouble>(light, cell, spot_106)) return Verdict::no;
  if (surely_misses(slightly_larger(light, spot_106), cell)) return Verdict::no;

  const ExactSpot spot = exact_spot(light, angle_bits_for<Float256>());
  if (spot.apex == RationalPoint{0, 0, 0}) return decide_at_eye(light, spot, cell);
  const NearestOnShells nearest = nearest_point(cell, spot.apex);
  if (!reaches(spot.apex, spot.range, nearest)) return Verdict::no;
  if (nearest_surely_meets(spot, cell, nearest)) return Verdict::yes;
  if (surely_leans_away(spot, planes_of(cell))) return Verdict::no;
  if (meets_by_search<Float256>(light, cell, spot)) return Verdict::yes;
  if (surely_misses(slightly_larger<Enclosure1024>(spot, 160, 1040), cell)) return Verdict::no;
  const Verdict verdict = proven_by_search<Float1024>(light, cell, exact_spot(light, angle_bits_for<Float1024>()));
  return verdict == Verdict::uncertain ? proven_at_last(light, cell) : verdict;
}

}  // namespace clusterbench::geom
