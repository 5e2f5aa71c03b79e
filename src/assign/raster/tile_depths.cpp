#include "assign/raster/tile_depths.h"

#include <array>
#include <cmath>

#include "core/arrays.h"
#include "grid/index_range.h"

namespace clusterbench::assign {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_roundoff = 0x1p-53;
// The error of the vertices from light_mesh.cpp, relative to the largest of them.
constexpr double k_vertex_roundoffs = 32.0;

// |x| + |y| + |z|: the size to which roundoffs of sums of a point's products are relative.
double size_of(const Vec3d& p) {
  return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z);
}

// A number with an error bound.
struct Rounded {
  double value, error;
};

// All possible quotients a / b; the whole line if b may be 0 or less.
Extent quotients(Rounded a, Rounded b) {
  const double least = b.value - b.error, most = b.value + b.error;
  if (!(least > 0.0)) return {-k_infinity, k_infinity};
  const double from = a.value - a.error, to = a.value + a.error;
  const double lo = from / (from < 0.0 ? least : most), hi = to / (to > 0.0 ? least : most);
  return {lo - 4.0 * k_roundoff * std::fabs(lo), hi + 4.0 * k_roundoff * std::fabs(hi)};
}

// The slope coordinate / depth of a point; in an orthographic picture the coordinate.
Extent place_of(Rounded coordinate, Rounded depth, bool orthographic) {
  if (orthographic) return {coordinate.value - coordinate.error, coordinate.value + coordinate.error};
  return quotients(coordinate, depth);
}

// An upper bound of coordinate - plane * depth, or of its negative (`sign`): the product and the difference are off by
// a roundoff each.
double beyond(double coordinate, double depth, double plane, double sign, bool orthographic) {
  const double offset = orthographic ? plane : plane * depth;
  return sign * (coordinate - offset) + 4.0 * k_roundoff * (std::fabs(coordinate) + std::fabs(offset));
}

// A part of an edge, from its first vertex (0) to its second (1).
struct Part {
  double begin = 0.0, end = 1.0;

  bool empty() const { return !(begin <= end); }
  // Clips the part to where a linear function, which is no more than these values at the edge's ends, is not negative.
  // The quotient is correct to three roundoffs, since nothing cancels in it.
  void cut(double at_first, double at_second) {
    if (at_first >= 0.0 && at_second >= 0.0) return;
    if (at_first < 0.0 && at_second < 0.0) {
      end = -1.0;
      return;
    }
    const double share = at_first / (at_first - at_second);
    if (at_first < 0.0)
      begin = std::max(begin, share * (1.0 - 4.0 * k_roundoff));
    else
      end = std::min(end, share * (1.0 + 4.0 * k_roundoff));
  }
  // Clips it to the region between two tile planes.
  void cut_between(double first, double first_depth, double second, double second_depth, double low, double high,
                   bool orthographic) {
    cut(beyond(first, first_depth, low, 1.0, orthographic), beyond(second, second_depth, low, 1.0, orthographic));
    cut(beyond(first, first_depth, high, -1.0, orthographic), beyond(second, second_depth, high, -1.0, orthographic));
  }
};

// A coordinate of the point at `share` of an edge: difference, product and sum are off by a roundoff each.
Rounded along_edge(double first, double second, double share) {
  return {first + share * (second - first), 4.0 * k_roundoff * (std::fabs(first) + std::fabs(second))};
}

Extent hull(const Extent& a, const Extent& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

// The range of positions in the picture of a part of an edge.
Extent places_along(double first, double second, double first_depth, double second_depth, const Part& part,
                    bool orthographic) {
  const auto place = [&](double share) {
    return place_of(along_edge(first, second, share), along_edge(first_depth, second_depth, share), orthographic);
  };
  return hull(place(part.begin), place(part.end));
}

}  // namespace

// A triangle against a ray through (x, y) of the picture: three linear functions of x and y that have the same sign if
// the ray pierces the triangle, and the depth there.
struct TileDepths::Triangle {
  struct Side {
    double x, y, constant;
    double error;  // of the function, for each unit of |x| + |y| + `base`
    double base;

    Rounded at(double px, double py) const {
      return {x * px + y * py + constant, error * (std::fabs(px) + std::fabs(py) + base)};
    }
  };

  Triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, bool is_orthographic)
      : sides{side(a, b, is_orthographic), side(b, c, is_orthographic), side(c, a, is_orthographic)},
        normal(glm::cross(b - a, c - a)),
        corner(a),
        normal_size(size_of(b - a) * size_of(c - a)),
        longest(size_of(b - a) + size_of(c - a)),
        orthographic(is_orthographic) {
    for (const Vec3d& vertex : {a, b, c}) {
      depths.add(vertex.z, vertex.z);
      const Extent x = place_of({vertex.x, 0.0}, {vertex.z, 0.0}, orthographic);
      const Extent y = place_of({vertex.y, 0.0}, {vertex.z, 0.0}, orthographic);
      places_x = hull(places_x, x);
      places_y = hull(places_y, y);
    }
  }

  // Through the eye, d · (a x b) = d · (a x e) for a ray along d = (x, y, 1) and the edge e from a to b; along the view
  // axis through (x, y), the cross product of e and the vector from a to (x, y). Roundoffs: one for e, two for each
  // component of the cross product, three for the sum, of |a| |e| |d|: eight cover them.
  static Side side(const Vec3d& a, const Vec3d& b, bool is_orthographic) {
    const Vec3d e = b - a;
    const double error = 8.0 * k_roundoff * size_of(e);
    if (is_orthographic) return {-e.y, e.x, e.y * a.x - e.x * a.y, error, size_of(a)};
    const Vec3d across = glm::cross(a, e);
    return {across.x, across.y, across.z, error * size_of(a), 1.0};
  }

  // May the ray pierce it?
  bool may_hold(double x, double y) const {
    bool may_be_left = true, may_be_right = true;
    for (const Side& each : sides) {
      const Rounded on = each.at(x, y);
      may_be_left = may_be_left && on.value >= -on.error;
      may_be_right = may_be_right && on.value <= on.error;
    }
    return may_be_left || may_be_right;
  }

  // If the ray pierces it: the possible depths of the triangle's plane there, limited to the triangle's own depths.
  // Roundoffs: four for the normal, three for the sum of its products with the ray or the corner.
  Extent depths_at(double x, double y) const {
    const double error = 8.0 * k_roundoff * normal_size;
    Rounded to_plane{}, along_ray{};
    if (orthographic) {
      const Vec3d from_ray = corner - Vec3d{x, y, 0.0};
      to_plane = {glm::dot(normal, from_ray), error * (size_of(corner) + std::fabs(x) + std::fabs(y))};
      along_ray = {normal.z, error};
    } else {
      to_plane = {glm::dot(normal, corner), error * size_of(corner)};
      along_ray = {normal.x * x + normal.y * y + normal.z, error * (std::fabs(x) + std::fabs(y) + 1.0)};
    }
    if (along_ray.value < 0.0) {
      to_plane.value = -to_plane.value;
      along_ray.value = -along_ray.value;
    }
    const Extent plane = quotients(to_plane, along_ray);
    return {std::clamp(plane.lo, depths.lo, depths.hi), std::clamp(plane.hi, depths.lo, depths.hi)};
  }

  // May the eye be behind its plane, as seen from outside of a mesh that is convex up to `off`, the error of its
  // vertices? These errors tilt the plane by twice `off` over the triangle's height, which is the normal over its
  // longest side; so planes of slivers exclude nothing.
  bool may_have_eye_behind(double off) const {
    const double size = size_of(corner);
    const double tilted = off * (glm::length(normal) + 2.0 * size * longest);
    return glm::dot(normal, corner) >= -8.0 * k_roundoff * normal_size * size - 2.0 * tilted;
  }

  std::array<Side, 3> sides;
  Vec3d normal, corner;
  double normal_size;  // the size to which roundoffs of the normal are relative
  double longest;      // length of the longest side
  bool orthographic;
  Extent depths, places_x, places_y;
};

void TileDepths::build(const grid::ScreenGrid& grid) {
  tiles_ = &grid.tiles;
  ranges_.reserve(static_cast<std::size_t>(tiles_->count.x) * static_cast<std::size_t>(tiles_->count.y));
}

void TileDepths::find(const LightMesh& mesh, Coverage coverage, const CellBox& window) {
  window_ = window;
  columns_ = static_cast<std::size_t>(window.last.x - window.first.x) + 1;
  ranges_.assign(columns_ * static_cast<std::size_t>(window.last.y - window.first.y + 1), {});
  triangles_.clear();
  tests_ = 0;
  bool eye_within = !tiles_->orthographic;
  double size = 0.0;
  for (const Vec3d& vertex : mesh.vertices) size = std::max(size, size_of(vertex));
  const double off = k_vertex_roundoffs * k_roundoff * size;
  for (const auto& [a, b, c] : mesh.topology->triangles) {
    const Triangle triangle(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], tiles_->orthographic);
    triangles_.push_back(triangle.depths);
    eye_within = eye_within && triangle.may_have_eye_behind(off);
    add_triangle(triangle, coverage);
  }
  for (const MeshEdge& edge : mesh.topology->edges) {
    const Extent whole = hull(triangles_[edge.sides[0]], triangles_[edge.sides[1]]);
    add_edge(mesh.vertices[edge.a], mesh.vertices[edge.b], coverage == Coverage::triangle ? &whole : nullptr);
  }
  // All tiles meet in the eye.
  if (eye_within)
    for (Extent& range : ranges_) range.add(0.0, 0.0);
}

// `whole`: the depths for all tiles that the edge touches; null: the depths of the edge in each tile.
void TileDepths::add_edge(const Vec3d& a, const Vec3d& b, const Extent* whole) {
  const bool orthographic = tiles_->orthographic;
  if (!orthographic && a.z < 0.0 && b.z < 0.0) return;
  const double least = std::min(a.z, b.z), most = std::max(a.z, b.z);
  const Extent up = places_along(a.y, b.y, a.z, b.z, {}, orthographic);
  const grid::IndexRange rows = grid::descending_intervals_touched(tiles_->y, up.lo, up.hi);
  for (int row = std::max(rows.first, window_.first.y); row <= std::min(rows.last, window_.last.y); ++row) {
    Part in_row;
    in_row.cut_between(a.y, a.z, b.y, b.z, tiles_->y_min(row), tiles_->y_max(row), orthographic);
    ++tests_;
    if (in_row.empty()) continue;
    const Extent across = places_along(a.x, b.x, a.z, b.z, in_row, orthographic);
    const grid::IndexRange columns = grid::intervals_touched(tiles_->x, across.lo, across.hi);
    for (int column = std::max(columns.first, window_.first.x); column <= std::min(columns.last, window_.last.x);
         ++column) {
      const auto x = static_cast<std::size_t>(column);
      Part in_tile = in_row;
      in_tile.cut_between(a.x, a.z, b.x, b.z, tiles_->x[x], tiles_->x[x + 1], orthographic);
      ++tests_;
      if (in_tile.empty()) continue;
      if (whole != nullptr) {
        at(column, row).add(whole->lo, whole->hi);
        continue;
      }
      for (const double share : {in_tile.begin, in_tile.end}) {
        const Rounded depth = along_edge(a.z, b.z, share);
        at(column, row)
            .add(std::clamp(depth.value - depth.error, least, most),
                 std::clamp(depth.value + depth.error, least, most));
      }
    }
  }
}

void TileDepths::add_triangle(const Triangle& triangle, Coverage coverage) {
  if (!triangle.orthographic && triangle.depths.hi < 0.0) return;
  const auto& x = tiles_->x;
  const auto& y = tiles_->y;
  const auto begin =
      std::lower_bound(x.begin() + window_.first.x, x.begin() + window_.last.x + 2, triangle.places_x.lo);
  const auto end = std::upper_bound(begin, x.begin() + window_.last.x + 2, triangle.places_x.hi);
  for (int row_line = window_.first.y; row_line <= window_.last.y + 1; ++row_line) {
    const double py = y[static_cast<std::size_t>(row_line)];
    if (py < triangle.places_y.lo || py > triangle.places_y.hi) continue;
    for (auto line = begin; line != end; ++line) {
      ++tests_;
      if (!triangle.may_hold(*line, py)) continue;
      const Extent there = triangle.depths_at(*line, py);
      // A ray has no points behind the eye.
      if (!triangle.orthographic && there.hi < 0.0) continue;
      add_around_corner(static_cast<int>(line - x.begin()), row_line,
                        coverage == Coverage::exact ? there : triangle.depths);
    }
  }
}

// Adds depths to the tiles that share a corner.
void TileDepths::add_around_corner(int column_line, int row_line, const Extent& depths) {
  for (int row = std::max(row_line - 1, window_.first.y); row <= std::min(row_line, window_.last.y); ++row)
    for (int column = std::max(column_line - 1, window_.first.x); column <= std::min(column_line, window_.last.x);
         ++column)
      at(column, row).add(depths.lo, depths.hi);
}

std::size_t TileDepths::capacity_bytes() const {
  return bytes_of(ranges_, triangles_);
}

}  // namespace clusterbench::assign
