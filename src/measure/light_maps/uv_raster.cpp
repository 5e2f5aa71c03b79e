#include "measure/light_maps/uv_raster.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/error.h"
#include "core/memory.h"

namespace clusterbench::measure {
namespace {

using Whole = std::int64_t;

constexpr Whole k_step = 256;  // snapped coordinates per texel
constexpr const char* k_fewer_texels = "use fewer texels";

struct Point {
  Whole x, y;
};

Whole floor_divided(Whole a, Whole b) {  // b > 0
  return a / b - (a % b < 0 ? 1 : 0);
}
Whole ceil_divided(Whole a, Whole b) {
  return -floor_divided(-a, b);
}

// Columns first .. last of a row; empty if first > last.
struct Span {
  Whole first, last;
};

// The line through an edge; points on the triangle's side have at(p) > 0.
struct Edge {
  Whole along_x, along_y, constant;
  bool owns_points;  // whether points on the line belong to this triangle: exactly one of two triangles at an edge owns
                     // them

  Edge(const Point& from, const Point& to)
      : along_x(from.y - to.y),
        along_y(to.x - from.x),
        constant(-along_x * from.x - along_y * from.y),
        owns_points(along_x > 0 || (along_x == 0 && along_y > 0)) {}

  Whole at(const Point& p) const { return along_x * p.x + along_y * p.y + constant; }
  bool holds(const Point& p) const { return at(p) + (owns_points ? 1 : 0) > 0; }

  // Clips a row's columns to those whose centre (or, conservative, any corner) is on this side.
  void clip(Whole row, TexelCoverage coverage, Span& span) const {
    const Whole more = coverage == TexelCoverage::centres ? (owns_points ? 1 : 0)
                                                          : (std::abs(along_x) + std::abs(along_y)) * (k_step / 2);
    const Whole start = at({k_step / 2, row * k_step + k_step / 2}) + more, slope = along_x * k_step;
    if (slope > 0) span.first = std::max(span.first, floor_divided(-start, slope) + 1);
    if (slope < 0) span.last = std::min(span.last, ceil_divided(start, -slope) - 1);
    if (slope == 0 && start <= 0) span.last = span.first - 1;
  }
};

// A triangle in snapped coordinates, counter-clockwise, in the repeat of the map that contains its least corner.
class Snapped {
 public:
  Snapped(const UvTriangle& triangle, const TexelGrid& grid) {
    for (std::size_t i = 0; i < 3; ++i) {
      // Exact: 24 bits times at most 2^22.
      corners_[i].x = std::llround(static_cast<double>(triangle[i].x) * (grid.width * static_cast<double>(k_step)));
      corners_[i].y = std::llround(static_cast<double>(triangle[i].y) * (grid.height * static_cast<double>(k_step)));
    }
    const Whole wide = grid.width * k_step, high = grid.height * k_step;
    is_wrapped_ = least_x() < 0 || least_y() < 0 || most_x() > wide || most_y() > high;
    const Whole left = floor_divided(least_x(), wide) * wide, low = floor_divided(least_y(), high) * high;
    for (Point& corner : corners_) corner = {corner.x - left, corner.y - low};
    if (longest() > k_longest_triangle_texels) return;  // the area might overflow
    area_ = (corners_[1].x - corners_[0].x) * (corners_[2].y - corners_[0].y) -
            (corners_[1].y - corners_[0].y) * (corners_[2].x - corners_[0].x);
    is_turned_ = area_ < 0;
    if (!is_turned_) return;
    std::swap(corners_[1], corners_[2]);
    area_ = -area_;
  }

  bool is_wrapped() const { return is_wrapped_; }
  bool has_area() const { return area_ > 0; }
  Whole longest() const { return std::max(most_x() - least_x(), most_y() - least_y()) / k_step; }

  Span rows() const { return {floor_divided(least_y(), k_step), ceil_divided(most_y(), k_step) - 1}; }
  Span columns(Whole row, TexelCoverage coverage) const {
    Span span{floor_divided(least_x(), k_step), ceil_divided(most_x(), k_step) - 1};
    for (std::size_t i = 0; i < 3; ++i) edge(i).clip(row, coverage, span);
    return span;
  }

  TexelSample sample(Whole column, Whole row, std::uint32_t triangle) const {
    const Point centre{column * k_step + k_step / 2, row * k_step + k_step / 2};
    TexelSample out;
    out.triangle = triangle;
    Vec3d weights;
    for (int i = 0; i < 3; ++i) {
      out.is_centre = out.is_centre && edge(static_cast<std::size_t>(i)).holds(centre);
      weights[i] = static_cast<double>(edge(static_cast<std::size_t>(i)).at(centre)) / static_cast<double>(area_);
    }
    if (std::min({weights.x, weights.y, weights.z}) < 0.0) weights = nearest_weights(centre);
    out.weight_b = is_turned_ ? weights.z : weights.y;
    out.weight_c = is_turned_ ? weights.y : weights.z;
    return out;
  }

 private:
  Whole least_x() const { return std::min({corners_[0].x, corners_[1].x, corners_[2].x}); }
  Whole least_y() const { return std::min({corners_[0].y, corners_[1].y, corners_[2].y}); }
  Whole most_x() const { return std::max({corners_[0].x, corners_[1].x, corners_[2].x}); }
  Whole most_y() const { return std::max({corners_[0].y, corners_[1].y, corners_[2].y}); }

  // The edge opposite to corner i.
  Edge edge(std::size_t i) const { return {corners_[(i + 1) % 3], corners_[(i + 2) % 3]}; }

  // Weights of the point on the triangle's outline that is nearest to an outside point.
  Vec3d nearest_weights(const Point& p) const {
    double least = -1.0;
    Vec3d weights(0.0);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const Point &from = corners_[static_cast<std::size_t>(i)], &to = corners_[static_cast<std::size_t>(j)];
      const Vec2d along(static_cast<double>(to.x - from.x), static_cast<double>(to.y - from.y)),
          way(static_cast<double>(p.x - from.x), static_cast<double>(p.y - from.y));
      const double size = glm::dot(along, along);
      const double share = size > 0.0 ? std::clamp(glm::dot(way, along) / size, 0.0, 1.0) : 0.0;
      const Vec2d apart = way - share * along;
      if (least >= 0.0 && glm::dot(apart, apart) >= least) continue;
      least = glm::dot(apart, apart);
      weights = Vec3d(0.0);
      weights[i] = 1.0 - share;
      weights[j] = share;
    }
    return weights;
  }

  std::array<Point, 3> corners_{};
  Whole area_ = 0;  // twice the area
  bool is_wrapped_ = false, is_turned_ = false;
};

// Calls visit(column, row) for each texel of a triangle, columns and rows before they are wrapped.
template <class Visit>
void each_texel(const Snapped& triangle, TexelCoverage coverage, Visit&& visit) {
  const Span rows = triangle.rows();
  for (Whole row = rows.first; row <= rows.last; ++row) {
    const Span span = triangle.columns(row, coverage);
    for (Whole column = span.first; column <= span.last; ++column) visit(column, row);
  }
}

std::size_t texel_at(const TexelGrid& grid, Whole column, Whole row) {
  // The least corner lies in the map, so columns and rows are not negative.
  return static_cast<std::size_t>(row % grid.height) * static_cast<std::size_t>(grid.width) +
         static_cast<std::size_t>(column % grid.width);
}

// Counts the work before it starts. Rows count, too, since each is work.
void check_work(std::span<const UvTriangle> triangles, const TexelGrid& grid, TexelCoverage coverage) {
  std::uint64_t work = 0;
  for (const UvTriangle& corners : triangles) {
    const Snapped triangle(corners, grid);
    if (triangle.longest() > k_longest_triangle_texels)
      throw Error("", "texture coordinates",
                  "a triangle reaches across " + std::to_string(triangle.longest()) + " texels; at most " +
                      std::to_string(k_longest_triangle_texels) + " are allowed: " + k_fewer_texels);
    if (!triangle.has_area()) continue;
    const Span rows = triangle.rows();
    work += static_cast<std::uint64_t>(rows.last - rows.first + 1);
    check_memory("texels that triangles cover", work, sizeof(TexelSample), k_fewer_texels);
    for (Whole row = rows.first; row <= rows.last; ++row) {
      const Span span = triangle.columns(row, coverage);
      work += static_cast<std::uint64_t>(std::max<Whole>(0, span.last - span.first + 1));
    }
    check_memory("texels that triangles cover", work, sizeof(TexelSample), k_fewer_texels);
  }
}

void count_texels(TexelCover& cover) {
  for (std::size_t texel = 0; texel < cover.grid.count(); ++texel) {
    const std::span<const TexelSample> samples = cover.of(texel);
    cover.covered += samples.empty() ? 0 : 1;
    cover.overlapping += std::ranges::count_if(samples, &TexelSample::is_centre) > 1 ? 1 : 0;
  }
}

}  // namespace

TexelCover cover_texels(std::span<const UvTriangle> triangles, const TexelGrid& grid, TexelCoverage coverage) {
  check_memory("texels", grid.count(), sizeof(std::uint64_t), k_fewer_texels);
  check_work(triangles, grid, coverage);
  TexelCover out;
  out.grid = grid;
  out.begin.assign(grid.count() + 1, 0);
  for (const UvTriangle& corners : triangles) {
    const Snapped triangle(corners, grid);
    out.wrapped_triangles += triangle.is_wrapped() ? 1 : 0;
    out.degenerate_triangles += triangle.has_area() ? 0 : 1;
    if (!triangle.has_area()) continue;
    bool is_missed = true;
    each_texel(triangle, coverage, [&](Whole column, Whole row) {
      ++out.begin[texel_at(grid, column, row) + 1];
      is_missed = false;
    });
    out.missed_triangles += is_missed ? 1 : 0;
  }
  for (std::size_t texel = 0; texel < grid.count(); ++texel) out.begin[texel + 1] += out.begin[texel];
  out.samples.resize(out.begin.back());
  // While a texel is filled, its begin moves to its end; afterwards all move back by one texel.
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Snapped triangle(triangles[i], grid);
    if (triangle.has_area())
      each_texel(triangle, coverage, [&](Whole column, Whole row) {
        out.samples[out.begin[texel_at(grid, column, row)]++] =
            triangle.sample(column, row, static_cast<std::uint32_t>(i));
      });
  }
  std::copy_backward(out.begin.begin(), out.begin.end() - 1, out.begin.end());
  out.begin.front() = 0;
  count_texels(out);
  return out;
}

}  // namespace clusterbench::measure
