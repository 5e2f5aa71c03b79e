#include "geom/box/box_decider.h"

#include "geom/box/clipped_box.h"

namespace clusterbench::geom {
namespace {

void add_plane(CellPlanes& planes, const Point3<double>& normal, double offset) {
  planes.all.push_back({normal, offset});
}

// depth = -z: x <= x1 * depth is x + x1 * z <= 0.
void add_pyramid(CellPlanes& planes, float x0, float x1, float y0, float y1) {
  add_plane(planes, {-1.0, 0.0, -double{x0}}, 0.0);
  add_plane(planes, {1.0, 0.0, x1}, 0.0);
  add_plane(planes, {0.0, -1.0, -double{y0}}, 0.0);
  add_plane(planes, {0.0, 1.0, y1}, 0.0);
}

CellPlanes planes_of_cell(const Box& cell) {
  CellPlanes planes{{}, {cell.lo.x, cell.lo.y, cell.lo.z}};
  add_plane(planes, {-1.0, 0.0, 0.0}, -double{cell.lo.x});
  add_plane(planes, {1.0, 0.0, 0.0}, cell.hi.x);
  add_plane(planes, {0.0, -1.0, 0.0}, -double{cell.lo.y});
  add_plane(planes, {0.0, 1.0, 0.0}, cell.hi.y);
  add_plane(planes, {0.0, 0.0, -1.0}, -double{cell.lo.z});
  add_plane(planes, {0.0, 0.0, 1.0}, cell.hi.z);
  return planes;
}

// A point is a cell, too.
CellPlanes planes_of_cell(const Vec3d& p) {
  CellPlanes planes{{}, {p.x, p.y, p.z}};
  for (const double sign : {-1.0, 1.0}) {
    add_plane(planes, {sign, 0.0, 0.0}, sign * p.x);
    add_plane(planes, {0.0, sign, 0.0}, sign * p.y);
    add_plane(planes, {0.0, 0.0, sign}, sign * p.z);
  }
  return planes;
}

CellPlanes planes_of_cell(const FrustumCell& cell) {
  if (cell.orthographic) return planes_of_cell(Box{{cell.x0, cell.y0, -cell.depth1}, {cell.x1, cell.y1, -cell.depth0}});
  const double depth = cell.depth0;
  CellPlanes planes{{}, {cell.x0 * depth, cell.y0 * depth, -depth}};  // products of floats are doubles
  add_pyramid(planes, cell.x0, cell.x1, cell.y0, cell.y1);
  add_plane(planes, {0.0, 0.0, 1.0}, -depth);
  add_plane(planes, {0.0, 0.0, -1.0}, cell.depth1);
  return planes;
}

CellPlanes planes_of_cell(const ShellCell& tile) {
  CellPlanes planes{{}, {0.0, 0.0, 0.0}};
  add_pyramid(planes, tile.x0, tile.x1, tile.y0, tile.y1);
  add_plane(planes, {0.0, 0.0, 1.0}, 0.0);
  return planes;
}

// Squares of floats are doubles.
template <class Bound>
Verdict meets_shells(const ShellCell& cell, const SquaredReach<Bound>& reach) {
  if (reach.is_empty) return Verdict::no;
  const Bound near = Bound(double{cell.distance0} * double{cell.distance0}),
              far = Bound(double{cell.distance1} * double{cell.distance1});
  if (reach.far_hi < near || reach.near_lo > far) return Verdict::no;
  return reach.far_lo >= near && reach.near_hi <= far ? Verdict::yes : Verdict::uncertain;
}

template <class Real>
std::optional<SquaredReach<typename BoundOf<Real>::Type>> reach_in(const BoxVolume& box, const ShellCell& tile) {
  ClippedBox<Real> clipped(box, planes_of_cell(tile));
  const auto reach = clipped.squared_reach();
  if (!clipped.is_certain()) return std::nullopt;
  return reach;
}

template <class AnyCell>
Verdict quick_verdict(const BoxVolume& box, const AnyCell& cell) {
  ClippedBox<Bounded> clipped(box, planes_of_cell(cell));
  const bool shares = clipped.shares_a_point();
  if (!clipped.is_certain()) return Verdict::uncertain;
  return shares ? Verdict::yes : Verdict::no;
}
Verdict quick_verdict(const BoxVolume& box, const ShellCell& cell) {
  const auto reach = reach_in<Bounded>(box, cell);
  return reach ? meets_shells(cell, *reach) : Verdict::uncertain;
}

template <class AnyCell>
bool exact_verdict(const BoxVolume& box, const AnyCell& cell) {
  return ClippedBox<Rational>(box, planes_of_cell(cell)).shares_a_point();
}
bool exact_verdict(const BoxVolume& box, const ShellCell& cell) {
  return meets_shells(cell, *reach_in<Rational>(box, cell)) == Verdict::yes;
}

}  // namespace

template <class AnyCell>
bool BoxDecider::meets_between_planes(const AnyCell& cell) const {
  const Verdict verdict = quick_verdict(box_, cell);
  if (verdict != Verdict::uncertain) return verdict == Verdict::yes;
  ++exact_decisions_;
  return exact_verdict(box_, cell);
}
template bool BoxDecider::meets_between_planes(const FrustumCell&) const;
template bool BoxDecider::meets_between_planes(const Box&) const;

bool BoxDecider::holds(const Vec3d& p) const {
  return meets_between_planes(p);
}

bool BoxDecider::meets(const Cell& cell) const {
  return std::visit([this](const auto& shape) { return meets(shape); }, cell);
}

Verdict BoxDecider::meets_quickly(const Cell& cell) const {
  return std::visit([this](const auto& shape) { return quick_verdict(box_, shape); }, cell);
}

bool BoxDecider::meets_exactly(const Cell& cell) const {
  return std::visit([this](const auto& shape) { return exact_verdict(box_, shape); }, cell);
}

BoxView BoxDecider::view_of(const ShellCell& tile) const {
  return {reach_in<Bounded>(box_, tile), std::nullopt};
}

bool BoxDecider::meets(const ShellCell& cell, const BoxView& view) const {
  if (view.reach) {
    const Verdict verdict = meets_shells(cell, *view.reach);
    if (verdict != Verdict::uncertain) return verdict == Verdict::yes;
  }
  ++exact_decisions_;
  if (!view.exact_reach) view.exact_reach = reach_in<Rational>(box_, cell);
  return meets_shells(cell, *view.exact_reach) == Verdict::yes;
}

}  // namespace clusterbench::geom
