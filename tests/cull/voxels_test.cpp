// Voxels against a loop over all of them.

#include "cull/voxels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/error.h"
#include "core/memory.h"
#include "core/random.h"

namespace clusterbench::cull {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

Vec3d place_in(SplitMix64& random, double lo, double hi) {
  const double x = random.between(lo, hi), y = random.between(lo, hi), z = random.between(lo, hi);
  return {x, y, z};
}

Vec3d direction(SplitMix64& random) {
  while (true) {
    const Vec3d way = place_in(random, -1.0, 1.0);
    if (const double length = glm::length(way); length > 0.1 && length <= 1.0) return way / length;
  }
}

// How long the way is inside of a box; below 0 where it misses it.
double inside(const Vec3d& from, const Vec3d& along, double length, const Vec3d& lo, const Vec3d& hi) {
  double begin = 0.0, end = length;
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0.0) {
      if (from[axis] < lo[axis] || from[axis] > hi[axis]) return -1.0;
      continue;
    }
    const double a = (lo[axis] - from[axis]) / along[axis], b = (hi[axis] - from[axis]) / along[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return end - begin;
}

constexpr double k_size = 1.5;

Vec3d low_corner(const VoxelIndex& voxel) {
  return k_size * Vec3d(static_cast<double>(voxel[0]), static_cast<double>(voxel[1]), static_cast<double>(voxel[2]));
}

template <class Take>
void each_voxel(const Take& take) {
  for (std::int64_t x = -5; x <= 5; ++x)
    for (std::int64_t y = -5; y <= 5; ++y)
      for (std::int64_t z = -5; z <= 5; ++z) take(VoxelIndex{x, y, z});
}

TEST(Voxels, a_way_marks_what_it_passes_through_and_nothing_else) {
  SplitMix64 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    Voxels voxels(Vec3d(-7.0), Vec3d(7.4), k_size);  // -5 to 4
    Vec3d from = place_in(random, -9.0, 9.0), along = direction(random);
    if (trial % 5 == 0) along = trial % 2 == 0 ? Vec3d(0.0, 1.0, 0.0) : Vec3d(0.0, 0.0, -1.0);
    // From a corner; along an axis from there lies between voxels, and either side will do.
    if (trial % 7 == 0 && trial % 5 != 0) from = k_size * glm::round(from / k_size);  // a corner
    const double length = trial % 3 == 0 ? k_infinity : random.between(0.0, 12.0);
    voxels.mark_way(from, along, length);
    each_voxel([&](const VoxelIndex& voxel) {
      const Vec3d lo = low_corner(voxel);
      const bool is_outside = *std::ranges::max_element(voxel) > 4;
      const double passed = inside(from, along, length - 1e-3 * k_size, lo, lo + k_size);
      if (is_outside || passed < -1e-9) {
        EXPECT_FALSE(voxels.is_marked(voxel)) << trial;
      } else if (passed > 1e-9) {
        EXPECT_TRUE(voxels.is_marked(voxel)) << trial << " by " << passed;
      }
    });
  }
}

TEST(Voxels, a_surface_between_two_voxels_does_not_open_the_one_behind_it) {
  Voxels voxels(Vec3d(0.0), Vec3d(9.0), 2.0);
  voxels.mark_way({1.0, 1.0, 1.0}, {1.0, 0.0, 0.0}, 3.0);  // to x = 4, where a voxel begins
  EXPECT_TRUE(voxels.is_marked({1, 0, 0}));
  EXPECT_FALSE(voxels.is_marked({2, 0, 0}));
  EXPECT_EQ(voxels.marked_count(), 2u);
}

TEST(Voxels, a_ball_touches_what_a_loop_over_all_of_them_says) {
  SplitMix64 random(4);
  int touching = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Voxels voxels(Vec3d(-7.0), Vec3d(7.4), k_size);
    for (int way = 0; way < 2; ++way) voxels.mark_way(place_in(random, -6.0, 6.0), direction(random), 2.0);
    const Vec3d center = place_in(random, -9.0, 9.0);
    const double radius = random.between(0.0, 9.0);
    double nearest = k_infinity;
    each_voxel([&](const VoxelIndex& voxel) {
      if (!voxels.is_marked(voxel)) return;
      const Vec3d lo = low_corner(voxel), apart = glm::max(glm::max(lo - center, center - (lo + k_size)), Vec3d(0.0));
      nearest = std::min(nearest, glm::length(apart));
    });
    if (std::abs(nearest - radius) < 1e-9) continue;
    EXPECT_EQ(voxels.are_touched_by(center, radius), nearest < radius) << trial;
    touching += nearest < radius ? 1 : 0;
  }
  EXPECT_GT(touching, 80);
  EXPECT_LT(touching, 320);
}

TEST(Voxels, touching_counts) {
  Voxels voxels(Vec3d(-10.0), Vec3d(10.0), 2.0);
  voxels.mark_way({0.5, 0.5, 0.5}, {1.0, 0.0, 0.0}, 1.0);  // [0, 2] cubed
  EXPECT_TRUE(voxels.are_touched_by({-1.0, 1.0, 1.0}, 1.0));
  EXPECT_TRUE(voxels.are_touched_by({5.0, 6.0, 1.0}, 5.0)) << "an edge: 3, 4, 5";
  EXPECT_FALSE(voxels.are_touched_by({5.0, 6.0, 1.0}, 4.999999));
  EXPECT_FALSE(voxels.are_touched_by({-1.0, 1.0, 1.0}, 0.999999));
}

TEST(Voxels, too_many_are_refused_before_memory_is_taken) {
  EXPECT_THROW(Voxels(Vec3d(-1e15), Vec3d(1e15), 0.01), Error);
  const MemoryLimitScope limit(1 << 20);
  EXPECT_THROW(Voxels(Vec3d(0.0), Vec3d(1000.0), 1.0), Error);
  EXPECT_NO_THROW(Voxels(Vec3d(0.0), Vec3d(100.0), 1.0));
}

}  // namespace
}  // namespace clusterbench::cull
