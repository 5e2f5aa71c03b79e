#include "depth/texel_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "depth/shadow_map.h"

namespace clusterbench::depth {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_more = 1.0 + 1e-9;  // larger than all roundoffs of a distance

// A convex set of directions by its corners, in order. Not of unit length.
using Directions = std::vector<Vec3d>;

// The directions in which a triangle is seen: those between three planes through the light.
struct Wedge {
  std::array<Vec3d, 3> inward;  // unit normals
  Vec3d normal;                 // of the triangle's plane
  double offset;                // normal·p of its points

  explicit Wedge(const std::array<Vec3d, 3>& corners)
      : normal(glm::cross(corners[1] - corners[0], corners[2] - corners[0])), offset(glm::dot(normal, corners[0])) {
    const double turn = offset < 0.0 ? -1.0 : 1.0;
    for (std::size_t i = 0; i < 3; ++i) inward[i] = turn * glm::normalize(glm::cross(corners[i], corners[(i + 1) % 3]));
  }

  // False if seen edge on: then it covers nothing.
  bool is_open() const {
    const auto is_unit = [](const Vec3d& side) { return std::isfinite(glm::length(side)); };
    return offset != 0.0 && std::ranges::all_of(inward, is_unit);
  }
  // Distance to the triangle's plane. Directions parallel to it give none, or any.
  double distance(const Vec3d& along) const {
    const double t = offset / glm::dot(normal, along);
    return t > 0.0 ? t * glm::length(along) : k_infinity;
  }
  // No point of the plane in these directions is nearer.
  double least_distance(const Directions& piece) const {
    const double upright = std::abs(offset) / glm::length(normal);
    double nearest = k_infinity, apart = 0.0;
    const auto point = [&](const Vec3d& along) { return offset / glm::dot(normal, along) * along; };
    for (const Vec3d& along : piece) {
      nearest = std::min(nearest, distance(along));
      apart = std::max(apart, glm::length(point(along) - point(piece.front())));
    }
    return std::max(upright, nearest - 2.0 * apart);
  }
};

struct Halves {
  Directions in, out;
};
// Cuts by a plane through the light. A part outside by less than the narrowest gap counts as inside.
Halves cut(const Directions& piece, const Vec3d& inward) {
  const auto margin = [&](const Vec3d& along) { return glm::dot(inward, along); };
  const bool sticks_out = std::ranges::any_of(
      piece, [&](const Vec3d& along) { return margin(along) < -k_narrowest_gap * glm::length(along); });
  if (!sticks_out) return {piece, {}};
  Halves halves;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3d &now = piece[i], &next = piece[(i + 1) % piece.size()];
    const double here = margin(now), there = margin(next);
    (here >= 0.0 ? halves.in : halves.out).push_back(now);
    if ((here >= 0.0) == (there >= 0.0)) continue;
    const Vec3d between = now + here / (here - there) * (next - now);
    halves.in.push_back(between);
    halves.out.push_back(between);
  }
  if (halves.in.size() < 3) halves.in.clear();
  return halves;
}

Vec3d middle_of(const Directions& piece) {
  Vec3d sum(0.0);
  for (const Vec3d& along : piece) sum += along;
  return glm::normalize(sum);
}

// The uncovered rest of a texel, and the largest distance of the surfaces that cover the other part.
class Cover {
 public:
  Cover(Directions texel, double near_m) : left_{std::move(texel)}, near_m_(near_m) {}

  bool is_whole() const { return left_.empty(); }
  const Directions& a_gap() const { return left_.back(); }
  double farthest() const { return farthest_; }

  void add(const SurfaceHit& hit) {
    const Wedge wedge(hit.corners);
    if (!wedge.is_open()) return;
    std::vector<Directions> before = std::move(left_);
    left_.clear();
    for (Directions& piece : before) subtract(std::move(piece), wedge);
  }

 private:
  void subtract(Directions piece, const Wedge& wedge) {
    const Directions whole = piece;
    std::vector<Directions> outside;
    for (const Vec3d& inward : wedge.inward) {
      Halves halves = cut(piece, inward);
      if (halves.out.size() >= 3) outside.push_back(std::move(halves.out));
      piece = std::move(halves.in);
      if (piece.empty()) break;
    }
    if (piece.empty() || wedge.least_distance(piece) < near_m_) {
      left_.push_back(whole);
      return;
    }
    for (const Vec3d& along : piece) farthest_ = std::max(farthest_, k_more * wedge.distance(along));
    for (Directions& part : outside) left_.push_back(std::move(part));
  }

  std::vector<Directions> left_;
  double near_m_, farthest_ = 0.0;
};

}  // namespace

double covered_distance(const std::array<Vec3d, 4>& corners, std::span<const SurfaceHit> found, const CastRay& cast,
                        double near_m) {
  constexpr int k_most_rays = 24;
  Cover cover(Directions(corners.begin(), corners.end()), near_m);
  for (const SurfaceHit& hit : found)
    if (!cover.is_whole()) cover.add(hit);
  for (int rays = 0; !cover.is_whole(); ++rays) {
    if (rays == k_most_rays) return k_infinity;
    const std::optional<SurfaceHit> hit = cast(middle_of(cover.a_gap()));
    if (!hit) return k_infinity;
    cover.add(*hit);
  }
  return cover.farthest();
}

}  // namespace clusterbench::depth
