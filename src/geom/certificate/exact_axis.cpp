#include "geom/certificate/exact_axis.h"

#include "geom/numbers/dyadic.h"
#include "geom/numbers/point3.h"
#include "geom/shapes/light_volume.h"

namespace clusterbench::geom {
namespace {

using Point = Point3<Dyadic>;

// The parameter t = top / bottom of a point a + t d, bottom > 0.
struct Parameter {
  Dyadic top, bottom;
};

bool is_before(const Parameter& a, const Parameter& b) {
  return a.top * b.bottom < b.top * a.bottom;
}

// a + t d with t >= 0 and t |d| <= range.
struct Axis {
  Point a, d;
  Dyadic square, squared_range;  // |d|², range²
};

Axis axis_of(const SpotVolume& light) {
  const Placement& apex = light.apex;
  Dyadic from_origin[3];
  for (int i = 0; i < 3; ++i) from_origin[i] = Dyadic(apex.position[i]) - Dyadic(apex.origin[i]);
  Dyadic a[3], d[3];
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const Dyadic factor(apex.rotation[column][row]);
      a[row] = a[row] + factor * from_origin[column];
      d[row] = d[row] + factor * Dyadic(light.direction[column]);
    }
  Axis axis{{a[0], a[1], a[2]}, {d[0], d[1], d[2]}, {}, squared(Dyadic(light.range))};
  axis.square = dot(axis.d, axis.d);
  return axis;
}

// The part of an axis inside some planes: from `from` to `to`, or without end.
class Span {
 public:
  explicit Span(const Axis& axis) : axis_(axis) {}

  // Removes the part beyond normal·p <= offset.
  void cut(const Point& normal, const Dyadic& offset) {
    const Dyadic slope = dot(normal, axis_.d), margin = offset - dot(normal, axis_.a);
    if (slope.sign() == 0) {
      is_empty_ = is_empty_ || margin.sign() < 0;
    } else if (slope.sign() < 0) {
      const Parameter t{-margin, -slope};
      if (is_before(from_, t)) from_ = t;
    } else if (const Parameter t{margin, slope}; !to_ || is_before(t, *to_)) {
      to_ = t;
    }
  }
  // Clips to x between x0 and x1 times the depth, likewise y; not behind the eye.
  void cut_by_tile(float x0, float x1, float y0, float y1) {
    const Dyadic none(0.0), plus(1.0), minus(-1.0);
    cut({minus, none, -Dyadic(x0)}, none);
    cut({plus, none, Dyadic(x1)}, none);
    cut({none, minus, -Dyadic(y0)}, none);
    cut({none, plus, Dyadic(y1)}, none);
    cut({none, none, plus}, none);
  }
  void cut_by_slab(int axis, float lo, float hi) {
    const Dyadic plus(1.0), minus(-1.0);
    Point up, down;
    Dyadic& ahead = axis == 0 ? up.x : axis == 1 ? up.y : up.z;
    Dyadic& behind = axis == 0 ? down.x : axis == 1 ? down.y : down.z;
    ahead = plus;
    behind = minus;
    cut(up, Dyadic(hi));
    cut(down, -Dyadic(lo));
  }

  bool is_empty() const { return is_empty_ || (to_ && is_before(*to_, from_)) || !is_in_range(from_); }
  const Parameter& from() const { return from_; }
  const std::optional<Parameter>& to() const { return to_; }
  bool holds(const Parameter& t) const { return !is_before(t, from_) && !(to_ && is_before(*to_, t)); }
  bool is_in_range(const Parameter& t) const {
    return t.top.sign() <= 0 || squared(t.top) * axis_.square <= axis_.squared_range * squared(t.bottom);
  }
  // Does it end before the range does?
  bool ends_in_range() const { return to_ && is_in_range(*to_); }

 private:
  const Axis& axis_;
  Parameter from_{Dyadic(), Dyadic(1.0)};
  std::optional<Parameter> to_;
  bool is_empty_ = false;
};

struct Meets {
  const SpotVolume& light;
  const Axis& axis;

  bool operator()(const Box& cell) const {
    Span span(axis);
    for (int i = 0; i < 3; ++i) span.cut_by_slab(i, cell.lo[i], cell.hi[i]);
    return !span.is_empty();
  }
  bool operator()(const FrustumCell& cell) const {
    if (cell.orthographic) return (*this)(Box{{cell.x0, cell.y0, -cell.depth1}, {cell.x1, cell.y1, -cell.depth0}});
    Span span(axis);
    span.cut_by_tile(cell.x0, cell.x1, cell.y0, cell.y1);
    span.cut_by_slab(2, -cell.depth1, -cell.depth0);
    return !span.is_empty();
  }
  // Distances from the eye along the axis decrease and then increase. If one point in the pyramid is not too far and
  // one is not too near, there is a point that is neither.
  bool operator()(const ShellCell& cell) const {
    Span span(axis);
    span.cut_by_tile(cell.x0, cell.x1, cell.y0, cell.y1);
    if (span.is_empty()) return false;
    const Dyadic squared_near = squared(Dyadic(cell.distance0)), squared_far = squared(Dyadic(cell.distance1));
    bool has_near = false, has_far = false;
    const auto add = [&](const Parameter& t) {
      const Point p = t.bottom * axis.a + t.top * axis.d;
      const Dyadic square = dot(p, p), scale = squared(t.bottom);
      has_near = has_near || square <= squared_far * scale;
      has_far = has_far || square >= squared_near * scale;
    };
    add(span.from());
    if (span.ends_in_range())
      add(*span.to());
    else
      add_end(squared_near, squared_far, has_near, has_far);
    const Parameter foot{-dot(axis.a, axis.d), axis.square};
    if (span.holds(foot) && span.is_in_range(foot)) add(foot);
    return has_near && has_far;
  }

  // At the end of the range, t = range / |d|: |a|² + range² + 2 range a·d / |d|.
  void add_end(const Dyadic& squared_near, const Dyadic& squared_far, bool& has_near, bool& has_far) const {
    const Dyadic known = dot(axis.a, axis.a) + axis.squared_range;
    const Dyadic change = Dyadic(2.0) * Dyadic(light.range) * dot(axis.a, axis.d);
    has_near = has_near || at_most_root((known - squared_far) * axis.square, -change, axis.square);
    has_far = has_far || at_most_root((squared_near - known) * axis.square, change, axis.square);
  }
};

}  // namespace

std::optional<bool> axis_meets(const SpotVolume& light, const Cell& cell) {
  try {
    const Axis axis = axis_of(light);
    return std::visit(Meets{light, axis}, cell);
  } catch (const TooWide&) {
    return std::nullopt;
  }
}

}  // namespace clusterbench::geom
