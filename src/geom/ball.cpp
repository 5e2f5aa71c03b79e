#include "geom/ball.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "geom/exact_ball.h"
#include "geom/exact_shell.h"
#include "geom/verdict.h"

namespace clusterbench::geom {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

// What is between four tile planes and two depths; far may be infinite.
struct Piece {
  float x0, x1, y0, y1;
  double near, far;
};

double slope_on(Side side, float low, float high) {
  return side == Side::low ? low : side == Side::high ? high : 0.0;
}

// In doubles ------------------------------------------------------------------------------------------------------

// About a number.
double about(const Bounded& number) {
  return number.value;
}
double about(const Tight& number) {
  return number.middle().hi;
}

double error_of(const Bounded& number) {
  return number.error;
}
double error_of(const Tight& number) {
  return number.radius();
}

Bounded widened(const Bounded& number, double by) {
  return {number.value, bounded::rounded_up(number.error + by)};
}
Tight widened(const Tight& number, double by) {
  return {number.middle(), (number.radius() + by) * (1.0 + 0x1p-40)};
}

// The largest of a, b and 0.
Tight largest_or_zero(const Tight& a, const Tight& b) {
  const Twofold middle = a.middle() < b.middle() ? b.middle() : a.middle();
  const double radius = std::max(a.radius(), b.radius());
  if (middle.hi > 0.0) return {middle, radius};
  return {Twofold(), -0.5 * middle.hi > radius ? 0.0 : radius};
}

// How far a centre is outside of low <= x <= high, and on which side.
template <class Number>
struct Gap {
  Number size;
  Side side;
};
template <class Number>
Gap<Number> gap_between(const Number& low, const Number& at, const Number& high) {
  const Number below = low - at, above = at - high;
  const Number size = largest_or_zero(below, above);
  if (about(size) > 0.0) return {size, about(below) > about(above) ? Side::low : Side::high};
  return {size, Side::between};
}

Side side_of(double low, double at, double high) {
  return at < low ? Side::low : at > high ? Side::high : Side::between;
}

// About where the squared distance is least, by Newton's steps, which end after two or three: between the places where
// a tile plane begins or ceases to be the nearest thing, it is a parabola.
double nearest_depth(double x, double y, double depth, const Piece& piece) {
  double at = std::clamp(depth, piece.near, piece.far);
  constexpr int k_most_steps = 8;
  for (int i = 0; i < k_most_steps; ++i) {
    const double slope_x = slope_on(side_of(piece.x0 * at, x, piece.x1 * at), piece.x0, piece.x1);
    const double slope_y = slope_on(side_of(piece.y0 * at, y, piece.y1 * at), piece.y0, piece.y1);
    const double next = std::clamp((depth + slope_x * x + slope_y * y) / (1.0 + slope_x * slope_x + slope_y * slope_y),
                                   piece.near, piece.far);
    if (next == at) break;
    at = next;
  }
  return at;
}

// Half the slope, along depth, of a gap's square. A gap whose side is not certain is below its error, and its slope
// below that times either plane's.
template <class Number>
Number half_slope(const Gap<Number>& gap, float low, float high) {
  const double slope = gap.side == Side::low ? low : gap.side == Side::high ? -static_cast<double>(high) : 0.0;
  const Number product = Number(slope) * gap.size;
  const double error = error_of(gap.size);
  return error > 0.0 ? widened(product, (std::abs(double{low}) + std::abs(double{high})) * error) : product;
}

// How large a number can be, at least 0.
double most(const Bounded& number) {
  return std::max(0.0, number.error + number.value);
}
double most(const Tight& number) {
  return number.radius() + std::max(0.0, number.middle().hi);
}

// What a piece has at a depth, as a centre sees it.
template <class Number>
struct AtDepth {
  Side x, y;
  Number square;
  double steepness;
  double x_error,
      y_error;  // how far the place on such a side can be from the nearest one, where the side is not certain

  // along: from the centre's depth.
  AtDepth(const Number& center_x, const Number& center_y, const Piece& piece, const Number& at, const Number& along,
          Side place) {
    const auto plane = [&](float slope) { return Number(double{slope}) * at; };
    const Gap<Number> gap_x = gap_between(plane(piece.x0), center_x, plane(piece.x1));
    const Gap<Number> gap_y = gap_between(plane(piece.y0), center_y, plane(piece.y1));
    x = gap_x.side;
    y = gap_y.side;
    x_error = error_of(gap_x.size);
    y_error = error_of(gap_y.size);
    square = gap_x.size * gap_x.size + gap_y.size * gap_y.size + along * along;
    // At an end only a derivative that leads away from it leads lower.
    const Number slope = half_slope(gap_x, piece.x0, piece.x1) + half_slope(gap_y, piece.y0, piece.y1) + along;
    const double falls = place != Side::high ? most(-slope) : 0.0;
    const double rises = place != Side::low ? most(slope) : 0.0;
    const double steep = std::max(falls, rises);
    steepness = steep == 0.0 ? 0.0 : bounded::rounded_up(steep);
  }
};

// Is the piece's nearest point surely as deep as the centre? Then it is looked at there, however deep that is, and the
// way to it is as exact as the coordinates across: so are touches of planes through the eye's own axes.
bool is_level(const Bounded& x, const Bounded& y, const Bounded& depth, const Piece& piece) {
  const auto is_upright = [&](float low, const Bounded& center, float high) {
    return slope_on(side_of(low * depth.value, center.value, high * depth.value), low, high) == 0.0;
  };
  const bool ends_behind = piece.far == k_infinity || (Bounded(piece.far) - depth).is_surely_above(0.0);
  return ends_behind && (depth - piece.near).is_surely_above(0.0) && is_upright(piece.x0, x, piece.x1) &&
         is_upright(piece.y0, y, piece.y1);
}

NearestDepth nearest_between(const Bounded& x, const Bounded& y, const Bounded& depth, const Piece& piece) {
  NearestDepth nearest;
  nearest.at = nearest_depth(x.value, y.value, depth.value, piece);
  nearest.depth = nearest.at == piece.near ? Side::low : nearest.at == piece.far ? Side::high : Side::between;
  nearest.is_level = depth.error > 0.0 && nearest.at == depth.value && is_level(x, y, depth, piece);
  nearest.place = nearest.is_level ? depth : Bounded(nearest.at);
  const Bounded along = nearest.is_level ? Bounded(0.0) : nearest.place - depth;
  const AtDepth<Bounded> there(x, y, piece, nearest.place, along, nearest.depth);
  nearest.x = there.x;
  nearest.y = there.y;
  nearest.square = there.square;
  nearest.steepness = there.steepness;
  return nearest;
}

// Closer to where the squared distance is least: a depth of the piece, as any is that lies between its ends.
Tight closer_depth(const Tight& x, const Tight& y, const Tight& depth, const Piece& piece, const NearestDepth& guess) {
  if (guess.depth != Side::between) return Tight(guess.at);
  const Twofold slope_x(slope_on(guess.x, piece.x0, piece.x1)), slope_y(slope_on(guess.y, piece.y0, piece.y1));
  const Twofold at = (depth.middle() + slope_x * x.middle() + slope_y * y.middle()) /
                     (Twofold(1.0) + slope_x * slope_x + slope_y * slope_y);
  return Tight(Twofold(piece.near) < at && at.hi < piece.far ? at : Twofold(guess.at));
}

// Numbers whose products Tight can bound.
bool are_usual(std::initializer_list<double> numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::abs(number) < 0x1p60; });
}
bool is_usual(const Placement& place, double radius) {
  const Vec3d &p = place.position, &o = place.origin;
  return are_usual({p.x, p.y, p.z, o.x, o.y, o.z, radius});
}
bool is_usual(const FrustumPiece& cell) {
  return are_usual({cell.x0, cell.x1, cell.y0, cell.y1, cell.depth0, cell.depth1});
}
bool is_usual(const ShellPiece& cell) {
  return are_usual({cell.x0, cell.x1, cell.y0, cell.y1, cell.distance0, cell.distance1});
}
bool is_usual(const Box& cell) {
  return are_usual({cell.lo.x, cell.lo.y, cell.lo.z, cell.hi.x, cell.hi.y, cell.hi.z});
}

// Half of the middle's leading part is less than all of it, and by more than is rounded here.
Verdict verdict_of(const Tight& excess, double undershoot) {
  const double half = 0.5 * excess.middle().hi;
  if (-half >= excess.radius()) return Verdict::yes;
  return half > undershoot + excess.radius() ? Verdict::no : Verdict::open;
}

double undershoot_of(double steepness) {
  return steepness == 0.0 ? 0.0 : bounded::rounded_up(steepness * steepness);
}

// The rays in which the tile planes of a pyramid meet: slopes of these.
template <class Take>
bool any_ray(const Piece& pyramid, Take&& take) {
  for (const float x : {pyramid.x0, pyramid.x1})
    for (const float y : {pyramid.y0, pyramid.y1})
      if (take(x, y)) return true;
  return false;
}

Piece pyramid_of(const ShellPiece& cell) {
  return {cell.x0, cell.x1, cell.y0, cell.y1, 0.0, k_infinity};
}

// How far ahead a point is in the ray that leans to it most. Rays that doubles, which lose less than 2^-48 of the
// point's size here, see farther behind than that are left out.
Tight along_rays(const Tight& x, const Tight& y, const Tight& depth, const Piece& pyramid) {
  const auto about_ahead = [&](double slope_x, double slope_y) {
    return (slope_x * about(x) + slope_y * about(y) + about(depth)) /
           std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
  };
  double most_about = -k_infinity;
  any_ray(pyramid, [&](float slope_x, float slope_y) {
    most_about = std::max(most_about, about_ahead(slope_x, slope_y));
    return false;
  });
  const double least = most_about - 0x1p-40 * (std::abs(about(x)) + std::abs(about(y)) + std::abs(about(depth)));
  std::optional<Tight> most_ahead;
  any_ray(pyramid, [&](float slope_x, float slope_y) {
    if (about_ahead(slope_x, slope_y) < least) return false;
    const Tight x_part(double{slope_x}), y_part(double{slope_y});
    const Tight ahead = (x_part * x + y_part * y + depth) / sqrt(Tight(1.0) + x_part * x_part + y_part * y_part);
    if (!most_ahead) {
      most_ahead = ahead;
    } else {
      const bool is_more = most_ahead->middle() < ahead.middle();
      most_ahead =
          Tight(is_more ? ahead.middle() : most_ahead->middle(), std::max(ahead.radius(), most_ahead->radius()));
    }
    return false;
  });
  return *most_ahead;
}

// From the centre to a gap's other end. Where the side is not certain, the gap is below its error.
Bounded across(const Gap<Bounded>& gap) {
  return gap.side == Side::high ? -gap.size : gap.size;
}

// From the centre to the nearest point of the piece, which is no farther from what was looked at along depth than half
// the derivative there.
Point3<Bounded> way_to(const NearestDepth& nearest, const Bounded& x, const Bounded& y, const Bounded& depth,
                       const Piece& piece) {
  Bounded way_x = across(gap_between(Bounded(piece.x0) * nearest.place, x, Bounded(piece.x1) * nearest.place));
  Bounded way_y = across(gap_between(Bounded(piece.y0) * nearest.place, y, Bounded(piece.y1) * nearest.place));
  Bounded way_z = nearest.is_level ? Bounded(0.0) : depth - nearest.place;
  if (nearest.steepness > 0.0) {
    const auto move = [&](Bounded& part, double slope0, double slope1) {
      part.error = bounded::rounded_up(part.error + nearest.steepness * std::max(std::abs(slope0), std::abs(slope1)));
    };
    move(way_x, piece.x0, piece.x1);
    move(way_y, piece.y0, piece.y1);
    move(way_z, 1.0, 1.0);
  }
  return {way_x, way_y, way_z};
}

// Points p of a convex set in a ball have |p - q|² <= radius² - |q - center|², q the set's nearest point to the centre.
double play_of(const Bounded& excess, double undershoot) {
  if (excess.value == 0.0 && excess.error == 0.0 && undershoot == 0.0) return 0.0;
  return bounded::rounded_up(std::sqrt(bounded::rounded_up(std::max(0.0, -excess.value) + excess.error + undershoot)));
}

// The squared distance from p to t * u (u of unit length) is t² - 2 t (u·p) + |p|²: whatever t is, the best u is the
// one with the largest u·p, and then the best t is u·p, pulled between the shells. If the pyramid's point nearest to p,
// q, is not the eye, u = q/|q|, as u·p <= |q| for every u of the pyramid (the pyramid is convex, and p - q is
// perpendicular to q and points away from it). If it is the eye, u·p <= 0 everywhere. Then u, a sum of the four rays
// (each taken of unit length) with weights that add to 1 at least, leans no less towards p in one of these rays.
//
// With half of the derivative s at q' (a point at another depth d, nearest to p there), q'·p = |q'|² - d s; so in its
// direction p is ahead by |q'| - s at least, and q, for which |p - q|² >= |p - q'|² - s², has |q| <= |q'| + |s|.
PyramidView view_from(const Bounded& of_x, const Bounded& of_y, const Bounded& of_depth, const Piece& pyramid) {
  PyramidView view{nearest_between(of_x, of_y, of_depth, pyramid), {}, false};
  const NearestDepth& nearest = view.nearest;
  view.is_behind = nearest.at == 0.0;
  if (view.is_behind) {
    view.along = -k_infinity;
    any_ray(pyramid, [&](float x, float y) {
      const Bounded ahead = Bounded(x) * of_x + Bounded(y) * of_y + of_depth;
      const double length = std::sqrt(1.0 + double{x} * double{x} + double{y} * double{y});
      const double value = ahead.value / length;
      const bool is_nothing = ahead.value == 0.0 && ahead.error == 0.0;
      const double error = is_nothing ? 0.0 : bounded::rounded_up(ahead.error / length + std::abs(value) * 0x1p-50);
      view.along = larger_of({value, error}, view.along);
      return false;
    });
  } else {
    const auto place = [&](Side side, const Bounded& of_center, float low, float high) {
      if (side == Side::between) return of_center;
      return Bounded(side == Side::low ? low : high) * nearest.place;
    };
    const Bounded x = place(nearest.x, of_x, pyramid.x0, pyramid.x1),
                  y = place(nearest.y, of_y, pyramid.y0, pyramid.y1);
    view.along = sqrt(x * x + y * y + nearest.place * nearest.place);
  }
  if (nearest.steepness > 0.0) view.along.error = bounded::rounded_up(view.along.error + nearest.steepness);
  return view;
}

// Exact numbers ---------------------------------------------------------------------------------------------------

Dyadic slope_of(Side side, float low, float high) {
  return side == Side::low ? Dyadic(low) : side == Side::high ? Dyadic(high) : Dyadic();
}

// Is low <= at <= high, or at beyond the side?
bool is_on(Side side, const Dyadic& low, const Dyadic& at, const Dyadic& high) {
  if (side == Side::low) return at <= low;
  if (side == Side::high) return at >= high;
  return low <= at && at <= high;
}

// A centre against the pieces of a pyramid of tile planes.
class ExactPiece {
 public:
  ExactPiece(const Dyadic& x, const Dyadic& y, const Dyadic& depth, const Piece& piece)
      : x_(x), y_(y), depth_(depth), piece_(piece) {}

  // Which side of which plane the nearest point is on: the guess, if it is right.
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
    return guess;  // cannot be: a convex function has a least value
  }

  // Squared distance to the nearest point <= squared_radius?
  bool is_within(const NearestDepth& nearest, const Dyadic& squared_radius) const {
    const Dyadic slope_x = slope_of(nearest.x, piece_.x0, piece_.x1),
                 slope_y = slope_of(nearest.y, piece_.y0, piece_.y1);
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

  // The nearest point, if its depth is between the ends, is `depth` / `scale` deep: that of the centre's foot on what
  // it lies on, with n = (slope_x, slope_y, 1) for the line of two planes: centre·n / n².
  struct Foot {
    Dyadic depth, scale;
  };
  Foot foot(Side x, Side y) const {
    Foot foot{depth_, Dyadic(1.0)};
    if (x != Side::between) add(foot, slope_of(x, piece_.x0, piece_.x1), x_);
    if (y != Side::between) add(foot, slope_of(y, piece_.y0, piece_.y1), y_);
    return foot;
  }

 private:
  static void add(Foot& foot, const Dyadic& slope, const Dyadic& place) {
    foot.depth = foot.depth + slope * place;
    foot.scale = foot.scale + squared(slope);
  }
  Dyadic end_of(Side depth) const { return Dyadic(depth == Side::low ? piece_.near : piece_.far); }

  // Where the derivative along depth is 0, or points out of the piece at an end, a convex function is least.
  bool is_nearest(const NearestDepth& guess) const {
    if (guess.depth == Side::high && piece_.far == k_infinity) return false;
    if (guess.depth != Side::between) {
      const Dyadic at = end_of(guess.depth);
      if (!are_on_sides(guess, at, Dyadic(1.0))) return false;
      const Foot foot = this->foot(guess.x, guess.y);
      const int slope = (foot.scale * at - foot.depth).sign();
      return guess.depth == Side::low ? slope >= 0 : slope <= 0;
    }
    const Foot foot = this->foot(guess.x, guess.y);
    if (Dyadic(piece_.near) * foot.scale > foot.depth) return false;
    if (piece_.far < k_infinity && Dyadic(piece_.far) * foot.scale < foot.depth) return false;
    return are_on_sides(guess, foot.depth, foot.scale);
  }
  bool are_on_sides(const NearestDepth& guess, const Dyadic& depth, const Dyadic& scale) const {
    return is_on(guess.x, Dyadic(piece_.x0) * depth, x_ * scale, Dyadic(piece_.x1) * depth) &&
           is_on(guess.y, Dyadic(piece_.y0) * depth, y_ * scale, Dyadic(piece_.y1) * depth);
  }

  const Dyadic &x_, &y_, &depth_;
  const Piece& piece_;
};

// A centre against the shells of a pyramid, see view_of().
class ExactPyramid {
 public:
  ExactPyramid(const Dyadic& x, const Dyadic& y, const Dyadic& depth, const Piece& pyramid)
      : x_(x), y_(y), depth_(depth), pyramid_(pyramid), piece_(x, y, depth, pyramid_) {}

  bool is_within(const NearestDepth& guess, const Dyadic& near, const Dyadic& far, const Dyadic& squared_radius) const {
    const NearestDepth nearest = piece_.nearest(guess);
    const Dyadic excess = squared(x_) + squared(y_) + squared(depth_) - squared_radius;  // of the eye
    if (nearest.depth == Side::low) return is_near_rays(near, excess);
    const ExactPiece::Foot foot = piece_.foot(nearest.x, nearest.y);
    const Dyadic square = squared_distance(foot, nearest), scale_square = squared(foot.scale);
    if (square.sign() == 0) return is_near_rays(near, excess);
    // t² - 2 t |q| + |p|² <= r² for |q| = sqrt(square) / scale.
    const auto reaches = [&](const Dyadic& t) {
      return at_most_root((squared(t) + excess) * foot.scale, Dyadic(2.0) * t, square);
    };
    if (square < squared(near) * scale_square) return reaches(near);
    if (square > squared(far) * scale_square) return reaches(far);
    return piece_.is_within(nearest, squared_radius);
  }

  // Is t u·p <= most for all directions u of the pyramid and near <= t <= far?
  bool is_ahead_at_most(const NearestDepth& guess, const Dyadic& near, const Dyadic& far, const Dyadic& most) const {
    const NearestDepth nearest = piece_.nearest(guess);
    if (nearest.depth != Side::low) {
      const ExactPiece::Foot foot = piece_.foot(nearest.x, nearest.y);
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
  // The foot's from the eye, times the square of its scale.
  Dyadic squared_distance(const ExactPiece::Foot& foot, const NearestDepth& nearest) const {
    const auto place = [&](Side side, const Dyadic& of_center, float low, float high) {
      return side == Side::between ? of_center * foot.scale : slope_of(side, low, high) * foot.depth;
    };
    return squared(place(nearest.x, x_, pyramid_.x0, pyramid_.x1)) +
           squared(place(nearest.y, y_, pyramid_.y0, pyramid_.y1)) + squared(foot.depth);
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
  const Piece pyramid_;
  const ExactPiece piece_;
};

}  // namespace

BallDecider::BallDecider(const Placement& center, double radius)
    : placement_(center), radius_(radius), squared_radius_(Bounded(radius) * radius) {
  assert(radius >= 0.0 && std::isfinite(radius));
  Bounded from_origin[3], local[3];
  for (int i = 0; i < 3; ++i) from_origin[i] = Bounded(center.position[i]) - center.origin[i];
  for (int row = 0; row < 3; ++row)
    local[row] = Bounded(center.rotation[0][row]) * from_origin[0] + Bounded(center.rotation[1][row]) * from_origin[1] +
                 Bounded(center.rotation[2][row]) * from_origin[2];
  x_ = local[0];
  y_ = local[1];
  depth_ = -local[2];
  center_ = {local[0], local[1], local[2]};
}

const BallDecider::Closely& BallDecider::closely() const {
  if (closely_) return *closely_;
  Tight from_origin[3];
  for (int i = 0; i < 3; ++i) from_origin[i] = Tight(placement_.position[i]) - Tight(placement_.origin[i]);
  const auto coordinate = [&](int row) {
    return Tight(placement_.rotation[0][row]) * from_origin[0] + Tight(placement_.rotation[1][row]) * from_origin[1] +
           Tight(placement_.rotation[2][row]) * from_origin[2];
  };
  const Tight radius(radius_);
  closely_.emplace(Closely{coordinate(0), coordinate(1), -coordinate(2), radius * radius});
  return *closely_;
}

const BallDecider::Exactly& BallDecider::exactly() const {
  if (exactly_) return *exactly_;
  Dyadic from_origin[3];
  for (int i = 0; i < 3; ++i) from_origin[i] = Dyadic(placement_.position[i]) - Dyadic(placement_.origin[i]);
  const auto coordinate = [&](int row) {
    return Dyadic(placement_.rotation[0][row]) * from_origin[0] + Dyadic(placement_.rotation[1][row]) * from_origin[1] +
           Dyadic(placement_.rotation[2][row]) * from_origin[2];
  };
  exactly_.emplace(Exactly{coordinate(0), coordinate(1), -coordinate(2), squared(Dyadic(radius_))});
  return *exactly_;
}

template <class AnyCell, class Close, class Exact>
bool BallDecider::decided(const AnyCell& cell, Close&& close, Exact&& exact) const {
  ++exact_decisions_;
  if (is_usual(placement_, radius_) && is_usual(cell)) {
    const Verdict verdict = close(closely());
    if (verdict != Verdict::open) return verdict == Verdict::yes;
  }
  try {
    return exact(exactly());
  } catch (const TooWide&) {
    return ball_meets_exactly(placement_, radius_, cell);
  }
}

bool BallDecider::meets(const Box& cell) const {
  const auto square = [](const Bounded& lo, const Bounded& at, const Bounded& hi) {
    const Bounded gap = gap_between(lo, at, hi).size;
    return gap * gap;
  };
  const Bounded excess = square(cell.lo.x, x_, cell.hi.x) + square(cell.lo.y, y_, cell.hi.y) +
                         square(-cell.hi.z, depth_, -cell.lo.z) - squared_radius_;
  if (excess.is_surely_not_above(0.0)) return true;
  if (excess.is_surely_above(0.0)) return false;
  const auto close = [&](const Closely& ball) {
    const auto close_square = [](double lo, const Tight& at, double hi) {
      const Tight gap = gap_between(Tight(lo), at, Tight(hi)).size;
      return gap * gap;
    };
    return verdict_of(close_square(cell.lo.x, ball.x, cell.hi.x) + close_square(cell.lo.y, ball.y, cell.hi.y) +
                          close_square(-cell.hi.z, ball.depth, -cell.lo.z) - ball.squared_radius,
                      0.0);
  };
  return decided(cell, close, [&](const Exactly& ball) {
    const auto exact_square = [](double lo, const Dyadic& at, double hi) {
      if (at < Dyadic(lo)) return squared(Dyadic(lo) - at);
      return at > Dyadic(hi) ? squared(at - Dyadic(hi)) : Dyadic();
    };
    return exact_square(cell.lo.x, ball.x, cell.hi.x) + exact_square(cell.lo.y, ball.y, cell.hi.y) +
               exact_square(-cell.hi.z, ball.depth, -cell.lo.z) <=
           ball.squared_radius;
  });
}

bool BallDecider::meets(const FrustumPiece& cell) const {
  if (cell.orthographic) return meets(Box{{cell.x0, cell.y0, -cell.depth1}, {cell.x1, cell.y1, -cell.depth0}});
  const Piece piece{cell.x0, cell.x1, cell.y0, cell.y1, cell.depth0, cell.depth1};
  const NearestDepth nearest = nearest_between(x_, y_, depth_, piece);
  const Bounded excess = nearest.square - squared_radius_;
  if (excess.is_surely_not_above(0.0)) return true;
  if (excess.is_surely_above(nearest.undershoot())) return false;
  const auto close = [&](const Closely& ball) {
    const Tight at = closer_depth(ball.x, ball.y, ball.depth, piece, nearest);
    const AtDepth<Tight> there(ball.x, ball.y, piece, at, at - ball.depth, nearest.depth);
    return verdict_of(there.square - ball.squared_radius, undershoot_of(there.steepness));
  };
  return decided(cell, close, [&](const Exactly& ball) {
    const ExactPiece exact(ball.x, ball.y, ball.depth, piece);
    return exact.is_within(exact.nearest(nearest), ball.squared_radius);
  });
}

PyramidView BallDecider::view_of(const ShellPiece& cell) const {
  return view_from(x_, y_, depth_, pyramid_of(cell));
}

bool BallDecider::meets(const ShellPiece& cell, const PyramidView& view) const {
  const Bounded near(cell.distance0), far(cell.distance1);
  Bounded further;
  if (view.is_behind) {
    further = near * near - Bounded(2.0) * near * view.along;
  } else {
    const Bounded gap = gap_between(near, view.along, far).size;
    further = gap * gap;
  }
  const Bounded excess = view.nearest.square + further - squared_radius_;
  if (excess.is_surely_not_above(0.0)) return true;
  if (excess.is_surely_above(view.nearest.undershoot())) return false;
  const auto close = [&](const Closely& ball) {
    const Piece pyramid = pyramid_of(cell);
    if (view.is_behind) {
      const AtDepth<Tight> at_eye(ball.x, ball.y, pyramid, Tight(0.0), -ball.depth, Side::low);
      const Tight t(double{cell.distance0});
      const Tight along = widened(along_rays(ball.x, ball.y, ball.depth, pyramid), at_eye.steepness);
      return verdict_of(at_eye.square + t * t - Tight(2.0) * t * along - ball.squared_radius,
                        undershoot_of(at_eye.steepness));
    }
    const Tight at = closer_depth(ball.x, ball.y, ball.depth, pyramid, view.nearest);
    const AtDepth<Tight> there(ball.x, ball.y, pyramid, at, at - ball.depth, view.nearest.depth);
    const auto place = [&](Side side, const Tight& of_center, float low, float high, double error) {
      return widened(side == Side::between ? of_center : Tight(double{side == Side::low ? low : high}) * at, error);
    };
    const Tight x = place(there.x, ball.x, cell.x0, cell.x1, there.x_error);
    const Tight y = place(there.y, ball.y, cell.y0, cell.y1, there.y_error);
    const Tight along = widened(sqrt(x * x + y * y + at * at), there.steepness);
    const Tight gap = gap_between(Tight(double{cell.distance0}), along, Tight(double{cell.distance1})).size;
    return verdict_of(there.square + gap * gap - ball.squared_radius, undershoot_of(there.steepness));
  };
  return decided(cell, close, [&](const Exactly& ball) {
    return ExactPyramid(ball.x, ball.y, ball.depth, pyramid_of(cell))
        .is_within(view.nearest, Dyadic(cell.distance0), Dyadic(cell.distance1), ball.squared_radius);
  });
}

bool BallDecider::has_corners_in_front(const Point3<double>& normal, const Corners& corners) const {
  try {
    const Exactly& ball = exactly();
    const Dyadic x(normal.x), y(normal.y), z(normal.z), least = x * ball.x + y * ball.y - z * ball.depth;
    return std::all_of(corners.begin(), corners.end(), [&](const Point3<double>& p) {
      return x * Dyadic(p.x) + y * Dyadic(p.y) + z * Dyadic(p.z) >= least;
    });
  } catch (const TooWide&) {
    return false;
  }
}

bool BallDecider::has_in_front(const Point3<double>& normal, const FrustumPiece& cell) const {
  return has_corners_in_front(normal, exact_corners(cell));
}

bool BallDecider::has_in_front(const Point3<double>& normal, const Box& cell) const {
  return has_corners_in_front(normal, exact_corners(cell));
}

// Over t u for t between the shells and u a direction of the pyramid, normal·(t u) is least where u leans most towards
// the opposite of the normal: far |q| below 0 for a point q of the pyramid (see view_from), or in a ray.
bool BallDecider::has_in_front(const Point3<double>& normal, const ShellPiece& cell) const {
  try {
    const Exactly& ball = exactly();
    const Dyadic x(-normal.x), y(-normal.y), depth(normal.z);
    const NearestDepth guess = view_from(-normal.x, -normal.y, normal.z, pyramid_of(cell)).nearest;
    return ExactPyramid(x, y, depth, pyramid_of(cell))
        .is_ahead_at_most(guess, Dyadic(cell.distance0), Dyadic(cell.distance1),
                          x * ball.x + y * ball.y + depth * ball.depth);
  } catch (const TooWide&) {
    return false;
  }
}

Bounded farthest_ahead(const Point3<Bounded>& direction, const ShellPiece& tile) {
  return view_from(direction.x, direction.y, -direction.z, pyramid_of(tile)).along;
}

std::optional<NearestPoint> BallDecider::nearest_point(const Box& cell) const {
  const auto gap = [](float low, const Bounded& at, float high) {
    return gap_between(Bounded(low), at, Bounded(high));
  };
  const Gap<Bounded> x = gap(cell.lo.x, x_, cell.hi.x), y = gap(cell.lo.y, y_, cell.hi.y),
                     z = gap(cell.lo.z, -depth_, cell.hi.z);
  const Bounded excess = x.size * x.size + y.size * y.size + z.size * z.size - squared_radius_;
  return NearestPoint{{across(x), across(y), across(z)}, play_of(excess, 0.0)};
}

std::optional<NearestPoint> BallDecider::nearest_point(const FrustumPiece& cell) const {
  if (cell.orthographic) return nearest_point(Box{{cell.x0, cell.y0, -cell.depth1}, {cell.x1, cell.y1, -cell.depth0}});
  const Piece piece{cell.x0, cell.x1, cell.y0, cell.y1, cell.depth0, cell.depth1};
  const NearestDepth nearest = nearest_between(x_, y_, depth_, piece);
  return NearestPoint{way_to(nearest, x_, y_, depth_, piece),
                      play_of(nearest.square - squared_radius_, nearest.undershoot())};
}

Point3<Bounded> foot_on_pyramid(const Point3<Bounded>& point, const ShellPiece& tile) {
  const Piece pyramid = pyramid_of(tile);
  const NearestDepth nearest = nearest_between(point.x, point.y, -point.z, pyramid);
  return point + way_to(nearest, point.x, point.y, -point.z, pyramid);
}

// Seen from behind, the corner on the near shell whose ray leans to the centre most, if that is certain.
std::optional<NearestPoint> BallDecider::nearest_ray(const PyramidView& view, const ShellPiece& cell) const {
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

// Not behind, see view_of(). If t, the distance of the nearest point from the eye, is not cut off by the near shell,
// the pyramid up to the far shell is the convex set. Else points p = s u, s >= near = t, are at least as far from the
// centre c as from its foot a u* on the nearest ray, aside of which it is: |p - c|² >= |p - a u*|² + |c|² - a². With e
// = radius² - |c|² + a² - (near - a)² that leaves |p - near u*|² <= e near / a.
std::optional<NearestPoint> BallDecider::nearest_point(const ShellPiece& cell) const {
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
  // From the foot on further along the ray.
  const Bounded further = across(gap) / view.along;
  return NearestPoint{way + further * (center_ + way), play};
}

bool BallDecider::meets(const Cell& cell) const {
  return std::visit([&](const auto& shape) { return meets(shape); }, cell);
}

}  // namespace clusterbench::geom
