#include "geom/projection/disk_tangents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace clusterbench::geom {
namespace {

constexpr float k_inf = std::numeric_limits<float>::infinity();

// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  double log_between(double lo, double hi) { return lo * std::pow(hi / lo, unit()); }

 private:
  std::mt19937_64 engine_;
};

struct DenseRange {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
};

// By walking around the disk's rim and along its chords: independent of tangents.
DenseRange dense(double u, double depth, double r, double depth_min, double depth_max) {
  DenseRange range;
  const auto add = [&](double pu, double pd) {
    if (pd < depth_min || pd > depth_max) return;
    range.lo = std::min(range.lo, pu / pd);
    range.hi = std::max(range.hi, pu / pd);
  };
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2.0 * M_PI * i / steps;
    add(u + r * std::cos(angle), depth + r * std::sin(angle));
  }
  for (const double line : {depth_min, depth_max}) {
    const double half = std::sqrt(std::max(0.0, r * r - (line - depth) * (line - depth)));
    if (std::fabs(line - depth) > r) continue;
    add(u - half, line);
    add(u + half, line);
  }
  return range;
}

TEST(Tangents, agree_with_a_walk_around_the_rim_of_random_disks) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const float depth_min = static_cast<float>(random.log_between(0.1, 50));
    const float depth_max = static_cast<float>(depth_min * random.between(1.01, 3));
    const float u = static_cast<float>(random.between(-30, 30));
    const float depth = static_cast<float>(random.between(-20, 80));
    const float r = static_cast<float>(random.log_between(0.05, 60));
    const DenseRange want = dense(u, depth, r, depth_min, depth_max);
    const SlopeRange got = slope_range(u, depth, r, depth_min, depth_max);
    SCOPED_TRACE(::testing::Message() << "u " << u << " depth " << depth << " r " << r << " slab " << depth_min << ".."
                                      << depth_max);
    if (want.lo > want.hi) continue;  // the walk can step over a sliver; empty ranges have their own test
    const double slack = 1e-4 * (1.0 + std::fabs(want.lo) + std::fabs(want.hi));
    EXPECT_LE(got.lo, want.lo);
    EXPECT_GE(got.hi, want.hi);
    EXPECT_NEAR(got.lo, want.lo, slack);
    EXPECT_NEAR(got.hi, want.hi, slack);
  }
}

TEST(Tangents, a_disk_beside_the_slab_has_no_range_and_one_that_touches_it_has_a_point) {
  EXPECT_TRUE(slope_range(3, 10, 2, 12.5f, 20).empty());
  EXPECT_TRUE(slope_range(3, 10, 2, 1, 7.5f).empty());
  const SlopeRange far_touch = slope_range(3, 10, 2, 12, 20);
  EXPECT_NEAR(far_touch.lo, 0.25, 1e-6);
  EXPECT_NEAR(far_touch.hi, 0.25, 1e-6);
  const SlopeRange near_touch = slope_range(3, 10, 2, 1, 8);
  EXPECT_NEAR(near_touch.lo, 0.375, 1e-6);
  EXPECT_TRUE(slope_range(3, 10, 2, std::nextafter(12.0f, 13.0f), 20).empty());
}

TEST(Tangents, a_disk_of_radius_1e6_a_metre_from_the_eye_is_bounded_to_a_ten_thousandth_of_a_tile) {
  // One tile of 32 px at 1920 px and 60° is 0.019 of slope.
  const double tile = 0.019;
  for (const double gap : {1.0, 2.0, 5.0, 10.0})
    for (const double angle : {0.3, 1.0, 1.5, 1.57}) {
      const float r = 1e6f;
      const float u = static_cast<float>((1e6 + gap) * std::sin(angle));
      const float depth = static_cast<float>((1e6 + gap) * std::cos(angle));
      // The same in long double from angles: a tangent lies asin(r/|c|) beside the centre.
      const long double length = hypotl(u, depth), beside = asinl(static_cast<long double>(r) / length);
      if (length <= r) continue;
      const long double along = sqrtl((length - r) * (length + r));
      const long double low = atan2l(u, depth) - beside;
      if (cosl(low) * along < 0.1L) continue;  // touches in front of the slab
      const SlopeRange got = slope_range(u, depth, r, 0.1f, k_inf);
      EXPECT_NEAR(got.lo, static_cast<double>(tanl(low)), 1e-4 * tile) << "gap " << gap << " angle " << angle;
    }
}

// The root that is the difference of two nearly equal numbers must come from the product of the roots.
TEST(Tangents, a_disk_that_ends_straight_ahead_keeps_the_digits_of_its_nearer_side) {
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const float r = static_cast<float>(random.log_between(0.1, 100));
    const float depth = static_cast<float>(r * random.log_between(1.5, 100));
    float u = r;
    for (auto steps = static_cast<int>(random.between(1, 4)); steps > 0; --steps) u = std::nextafter(u, k_inf);
    const long double to_u = u, to_depth = depth, beyond = (to_u - r) * (to_u + r);
    const long double slope = beyond / (to_u * to_depth + r * sqrtl(beyond + to_depth * to_depth));
    EXPECT_LE(static_cast<long double>(slope_range(u, depth, r, 0.1f, k_inf).lo), slope);
    EXPECT_GE(static_cast<long double>(slope_range(-u, depth, r, 0.1f, k_inf).hi), -slope);
    EXPECT_NEAR(slope_range(u, depth, r, 0.1f, k_inf).lo / static_cast<double>(slope), 1.0, 2.5e-7);
  }
}

TEST(Tangents, an_eye_in_the_disk_sees_what_the_slab_leaves) {
  const SlopeRange got = slope_range(0, 0, 5, 3, 4);
  EXPECT_NEAR(got.lo, -4.0 / 3.0, 1e-6);
  EXPECT_NEAR(got.hi, 4.0 / 3.0, 1e-6);
  const SlopeRange from_the_eye = slope_range(1, 2, 5, 0, 100);
  EXPECT_EQ(from_the_eye.lo, -k_inf);
  EXPECT_EQ(from_the_eye.hi, k_inf);
}

TEST(Tangents, a_centre_behind_the_eye_is_not_mirrored) {
  EXPECT_TRUE(slope_range(3, -10, 5, 0.1f, 100).empty());
  const SlopeRange reaching = slope_range(30, -1, 5, 0.1f, 100);
  EXPECT_GT(reaching.lo, 6);  // 25.4 / 4 and steeper
  EXPECT_GT(reaching.hi, 300);
}

TEST(Tangents, an_unbounded_radius_is_everything_and_a_negative_or_undefined_one_nothing) {
  const SlopeRange all = slope_range(3, 10, k_inf, 1, 20);
  EXPECT_EQ(all.lo, -k_inf);
  EXPECT_EQ(all.hi, k_inf);
  EXPECT_TRUE(slope_range(3, 10, -1, 1, 20).empty());
  EXPECT_TRUE(slope_range(3, 10, std::numeric_limits<float>::quiet_NaN(), 1, 20).empty());
  const SlopeRange point = slope_range(3, 12, 0, 1, 20);
  EXPECT_NEAR(point.lo, 0.25, 1e-6);
  EXPECT_NEAR(point.hi, 0.25, 1e-6);
}

TEST(Tangents, hold_every_point_of_a_disk_whose_rim_is_within_an_ulp_of_a_boundary) {
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const float line = static_cast<float>(random.log_between(0.1, 1e4));
    const float r = static_cast<float>(random.log_between(1e-3, 1e6));
    float depth = static_cast<float>(random.unit() < 0.5 ? line + r : line - r);
    const int nudge = static_cast<int>(random.between(-3, 4));
    for (int k = 0; k < std::abs(nudge); ++k) depth = std::nextafter(depth, nudge < 0 ? -k_inf : k_inf);
    const float u = static_cast<float>(random.between(-100, 100));
    const SlopeRange got = slope_range(u, depth, r, line, line);
    const long double reach = static_cast<long double>(r) - fabsl(static_cast<long double>(line) - depth);
    SCOPED_TRACE(::testing::Message() << "u " << u << " depth " << depth << " r " << r << " line " << line);
    ASSERT_EQ(got.empty(), reach < 0);
    if (got.empty()) continue;
    const long double half = sqrtl(reach * (r + fabsl(static_cast<long double>(line) - depth)));
    EXPECT_LE(static_cast<long double>(got.lo), (u - half) / line);
    EXPECT_GE(static_cast<long double>(got.hi), (u + half) / line);
  }
}

TEST(Offsets, are_the_widest_chord_in_the_slab) {
  const SlopeRange middle = offset_range(3, 10, 2, 5, 20);
  EXPECT_NEAR(middle.lo, 1, 1e-6);
  EXPECT_NEAR(middle.hi, 5, 1e-6);
  const SlopeRange beyond = offset_range(3, 10, 5, 14, 20);
  EXPECT_NEAR(beyond.lo, 0, 1e-6);
  EXPECT_NEAR(beyond.hi, 6, 1e-6);
  const SlopeRange behind = offset_range(3, -10, 5, -6, 20);
  EXPECT_NEAR(behind.lo, 0, 1e-6);
  EXPECT_TRUE(offset_range(3, 10, 2, 13, 20).empty());
}

}  // namespace
}  // namespace clusterbench::geom
