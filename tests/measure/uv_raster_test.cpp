// Coverage of texels against other ways to find it: clipped polygons, sides of lines, and sums of areas.

#include "measure/light_maps/uv_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/memory.h"
#include "core/random.h"

namespace clusterbench::measure {
namespace {

using scene::Vec2f;

constexpr auto k_centres = TexelCoverage::centres;
constexpr auto k_touched = TexelCoverage::conservative;

double cross_of(const Vec2d& a, const Vec2d& b) {
  return a.x * b.y - a.y * b.x;
}

// Corners on the lattice of 1/256 texel, so that nothing is snapped and doubles are exact.
UvTriangle lattice_triangle(SplitMix64& random, const TexelGrid& grid, double repeats) {
  UvTriangle out;
  for (Vec2f& corner : out) {
    const auto at = [&](int side) {
      const double steps = std::floor(random.between(-repeats, 1.0 + repeats) * side * 256.0);
      return static_cast<float>(steps / 256.0 / side);
    };
    corner = {at(grid.width), at(grid.height)};
  }
  return out;
}

std::array<Vec2d, 3> in_texels(const UvTriangle& triangle, const TexelGrid& grid) {
  std::array<Vec2d, 3> out;
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = Vec2d(triangle[i]) * Vec2d(static_cast<double>(grid.width), static_cast<double>(grid.height));
  return out;
}

// The area that a triangle and a texel share, by clipping (Sutherland and Hodgman 1974).
double shared_area(const std::array<Vec2d, 3>& triangle, double x, double y) {
  std::vector<Vec2d> polygon(triangle.begin(), triangle.end());
  for (int side = 0; side < 4; ++side) {
    const auto inside = [&](const Vec2d& p) {
      return side == 0 ? p.x - x : side == 1 ? x + 1.0 - p.x : side == 2 ? p.y - y : y + 1.0 - p.y;
    };
    std::vector<Vec2d> next;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
      const double a = inside(from), b = inside(to);
      if (a >= 0.0) next.push_back(from);
      if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) next.push_back(from + a / (a - b) * (to - from));
    }
    polygon = next;
  }
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    area += cross_of(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return std::abs(area) / 2.0;
}

// 1: inside, 0: on an edge, -1: outside.
int side_of(const std::array<Vec2d, 3>& t, const Vec2d& p) {
  const double turn = cross_of(t[1] - t[0], t[2] - t[0]) > 0.0 ? 1.0 : -1.0;
  double least = 1e300;
  for (std::size_t i = 0; i < 3; ++i) least = std::min(least, turn * cross_of(t[(i + 1) % 3] - t[i], p - t[i]));
  return least > 0.0 ? 1 : least < 0.0 ? -1 : 0;
}

Vec2d place_of(const TexelSample& sample, const std::array<Vec2d, 3>& t) {
  return t[0] + sample.weight_b * (t[1] - t[0]) + sample.weight_c * (t[2] - t[0]);
}

TEST(UvRaster, triangles_around_a_point_cover_each_texel_of_the_map_once) {
  SplitMix64 random(1);
  for (int width = 1; width < 12; ++width)
    for (int height = 1; height < 12; ++height) {
      const TexelGrid grid{width, height};
      Vec2f middle(static_cast<float>(random.unit()), static_cast<float>(random.unit()));
      // On a texel's centre, where four triangles meet.
      if ((width + height) % 2 == 0) middle = {0.5f / static_cast<float>(width), 0.5f / static_cast<float>(height)};
      const Vec2f corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      std::vector<UvTriangle> fan;
      for (std::size_t i = 0; i < 4; ++i) {
        fan.push_back({corners[i], corners[(i + 1) % 4], middle});
        if (i % 2 == 1) std::swap(fan.back()[0], fan.back()[1]);  // turned over
      }
      const TexelCover cover = cover_texels(fan, grid, k_centres);
      EXPECT_EQ(cover.covered, grid.count());
      EXPECT_EQ(cover.samples.size(), grid.count());
      EXPECT_EQ(cover.overlapping, 0U);
      EXPECT_EQ(cover.wrapped_triangles, 0U);
    }
}

TEST(UvRaster, centres_inside_are_covered_and_centres_outside_are_not) {
  SplitMix64 random(2);
  const TexelGrid grid{16, 8};
  for (int i = 0; i < 500; ++i) {
    const UvTriangle triangle = lattice_triangle(random, grid, 0.0);
    const std::array<Vec2d, 3> corners = in_texels(triangle, grid);
    const TexelCover cover = cover_texels({&triangle, 1}, grid, k_centres);
    for (std::size_t texel = 0; texel < grid.count(); ++texel) {
      const Vec2d centre(static_cast<double>(texel % 16) + 0.5, static_cast<double>(texel / 16) + 0.5);
      const int side = side_of(corners, centre);
      if (side != 0 || cover.degenerate_triangles > 0) {
        EXPECT_EQ(cover.of(texel).size(), side > 0 && cover.degenerate_triangles == 0 ? 1U : 0U) << i << " " << texel;
      }
      for (const TexelSample& sample : cover.of(texel))
        EXPECT_LT(glm::length(place_of(sample, corners) - centre), 1e-9) << i << " " << texel;
    }
  }
}

TEST(UvRaster, conservative_are_the_texels_that_share_an_area_with_the_triangle) {
  SplitMix64 random(3);
  const TexelGrid grid{16, 8};
  for (int i = 0; i < 300; ++i) {
    UvTriangle triangle = lattice_triangle(random, grid, 0.0);
    if (i % 3 == 0)  // on texels' corners, where touching is no area
      for (Vec2f& corner : triangle)
        corner = {std::floor(corner.x * 16.0f) / 16.0f, std::floor(corner.y * 8.0f) / 8.0f};
    const std::array<Vec2d, 3> corners = in_texels(triangle, grid);
    const TexelCover cover = cover_texels({&triangle, 1}, grid, k_touched);
    if (cover.degenerate_triangles > 0) continue;
    for (std::size_t texel = 0; texel < grid.count(); ++texel) {
      const double x = static_cast<double>(texel % 16), y = static_cast<double>(texel / 16);
      const double area = shared_area(corners, x, y);
      // The least area on this lattice is 2^-40; rounding of clipped corners makes some 1e-14.
      EXPECT_EQ(cover.of(texel).size(), area > 1e-13 ? 1U : 0U) << i << " " << texel << " " << area;
      for (const TexelSample& sample : cover.of(texel)) {
        const Vec2d centre(x + 0.5, y + 0.5), place = place_of(sample, corners);
        const double away = glm::length(place - centre);
        if (side_of(corners, centre) != 0) {
          EXPECT_EQ(sample.is_centre, side_of(corners, centre) > 0);
        }
        EXPECT_TRUE(!sample.is_centre || away < 1e-9);
        // No point of the triangle is nearer.
        for (int k = 0; k < 50; ++k) {
          double b = random.unit(), c = random.unit();
          if (b + c > 1.0) b = 1.0 - b, c = 1.0 - c;
          if (k % 2 == 1) c = 1.0 - b;
          EXPECT_GE(glm::length(place_of({0, true, b, c}, corners) - centre), away - 1e-9);
        }
        EXPECT_GE(std::min({sample.weight_b, sample.weight_c, 1.0 - sample.weight_b - sample.weight_c}), -1e-12);
      }
    }
  }
}

TEST(UvRaster, what_lies_outside_of_the_map_wraps) {
  SplitMix64 random(4);
  const TexelGrid grid{8, 16};
  for (const TexelCoverage coverage : {k_centres, k_touched})
    for (int i = 0; i < 200; ++i) {
      const UvTriangle triangle = lattice_triangle(random, grid, 0.0);
      UvTriangle moved = triangle;
      for (Vec2f& corner : moved) corner += Vec2f(-3.0f, 5.0f);
      const TexelCover here = cover_texels({&triangle, 1}, grid, coverage),
                       there = cover_texels({&moved, 1}, grid, coverage);
      EXPECT_EQ(here.begin, there.begin);
      EXPECT_EQ(here.wrapped_triangles, 0U);
      EXPECT_EQ(there.wrapped_triangles, 1U);
    }
  // Twice and a half times around: the sum of all repeats is the triangle's area.
  const UvTriangle large{Vec2f(0, 0), Vec2f(2.5f, 0), Vec2f(0, 2)};
  const TexelCover cover = cover_texels({&large, 1}, {64, 64}, k_centres);
  EXPECT_NEAR(static_cast<double>(cover.samples.size()), 2.5 * 64 * 64, 100.0);
  EXPECT_EQ(cover.covered, 64U * 64U);
  EXPECT_GT(cover.overlapping, 3000U);
}

TEST(UvRaster, a_texel_with_two_triangles_at_its_centre_overlaps_and_one_touched_by_two_does_not) {
  const std::vector<UvTriangle> halves{{Vec2f(0, 0), Vec2f(1, 0), Vec2f(1, 1)},
                                       {Vec2f(0, 0), Vec2f(1, 1), Vec2f(0, 1)}};
  const TexelCover touched = cover_texels(halves, {8, 8}, k_touched);
  EXPECT_EQ(touched.overlapping, 0U);
  EXPECT_EQ(touched.samples.size(), 64U + 8U);  // those on the diagonal twice
  const std::vector<UvTriangle> same(2, halves[0]);
  const TexelCover twice = cover_texels(same, {8, 8}, k_centres);
  EXPECT_EQ(twice.overlapping, twice.covered);
  EXPECT_EQ(twice.samples.size(), 2 * twice.covered);
}

TEST(UvRaster, triangles_that_cover_nothing_are_told) {
  const std::vector<UvTriangle> triangles{
      {Vec2f(0, 0), Vec2f(1, 1), Vec2f(0.5f, 0.5f)},                    // a line
      {Vec2f(0.5f, 0.5f), Vec2f(0.5001f, 0.5f), Vec2f(0.5f, 0.5001f)},  // a point, once snapped
      {Vec2f(0.01f, 0.01f), Vec2f(0.05f, 0.01f), Vec2f(0.01f, 0.05f)},  // in a corner of texel 0
  };
  const TexelCover cover = cover_texels(triangles, {8, 8}, k_centres);
  EXPECT_EQ(cover.covered, 0U);
  EXPECT_EQ(cover.degenerate_triangles, 2U);
  EXPECT_EQ(cover.missed_triangles, 1U);
  const TexelCover touched = cover_texels(triangles, {8, 8}, k_touched);
  EXPECT_EQ(touched.covered, 1U);
  EXPECT_EQ(touched.missed_triangles, 0U);
}

std::string refusal_of(const UvTriangle& triangle, const TexelGrid& grid) {
  try {
    cover_texels({&triangle, 1}, grid, k_centres);
  } catch (const Error& error) {
    return error.message();
  }
  return "covers";
}

TEST(UvRaster, what_takes_too_long_or_too_much_memory_is_refused_before_it_is_made) {
  const UvTriangle whole{Vec2f(0, 0), Vec2f(1, 0), Vec2f(0, 1)};
  EXPECT_EQ(refusal_of({Vec2f(-4096, 0), Vec2f(4096, 0), Vec2f(0, 4096)}, {16384, 16384}),
            "a triangle reaches across 134217728 texels; at most 1048576 are allowed: use fewer texels");
  const MemoryLimitScope little(1 << 20);
  EXPECT_EQ(refusal_of(whole, {64, 64}), "covers");
  EXPECT_NE(refusal_of(whole, {512, 512}).find("262144 texels would take 2 MiB"), std::string::npos);
  // Each texel many times: the map itself is small.
  EXPECT_NE(refusal_of({Vec2f(0, 0), Vec2f(90, 0), Vec2f(0, 90)}, {64, 64}).find("texels that triangles cover"),
            std::string::npos);
}

}  // namespace
}  // namespace clusterbench::measure
