// Sampling between keys, against formulas written out independently of the code.

#include "scene/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace clusterbench::scene {
namespace {

constexpr double k_pi = std::numbers::pi;

Vec4d turn(const Vec3d& axis, double angle_rad) {
  return Vec4d(glm::normalize(axis) * std::sin(angle_rad / 2.0), std::cos(angle_rad / 2.0));
}

double largest_difference(const Vec4d& a, const Vec4d& b) {
  const Vec4d d = a - b;
  return std::max(std::max(std::abs(d.x), std::abs(d.y)), std::max(std::abs(d.z), std::abs(d.w)));
}

// -1 .. 1 from raw generator output, the same with every standard library.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
}

// The Hamilton product of quaternions x, y, z, w.
Vec4d product(const Vec4d& a, const Vec4d& b) {
  const Vec3d u(a), v(b);
  return Vec4d(a.w * v + b.w * u + glm::cross(u, v), a.w * b.w - glm::dot(u, v));
}

// Slerp as a power: a * (a^-1 b)^t by axis and angle, the nearer of b and -b.
Vec4d power_slerp(const Vec4d& a, Vec4d b, double t) {
  if (glm::dot(a, b) < 0.0) b = -b;
  const Vec4d step = product(Vec4d(-Vec3d(a), a.w), b);
  const double half_angle = std::atan2(glm::length(Vec3d(step)), step.w);
  const Vec3d axis = half_angle > 0.0 ? glm::normalize(Vec3d(step)) : Vec3d(1.0, 0.0, 0.0);
  return product(a, Vec4d(axis * std::sin(t * half_angle), std::cos(t * half_angle)));
}

Channel channel_of(ChannelPath path, Interpolation interpolation, std::vector<double> times_s,
                   std::vector<Vec4d> values) {
  Channel channel;
  channel.node = 0;
  channel.path = path;
  channel.interpolation = interpolation;
  channel.times_s = std::move(times_s);
  channel.values = std::move(values);
  return channel;
}

TEST(Slerp, agrees_with_the_power_of_the_relative_rotation_on_random_quaternions) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const Vec4d a = glm::normalize(Vec4d(uniform(random), uniform(random), uniform(random), uniform(random)));
    const Vec4d b = glm::normalize(Vec4d(uniform(random), uniform(random), uniform(random), uniform(random)));
    const double t = 0.5 + 0.5 * uniform(random);
    ASSERT_LT(largest_difference(slerp(a, b, t), power_slerp(a, b, t)), 1e-12) << i;
  }
}

TEST(Slerp, keeps_its_digits_where_the_two_rotations_are_nearly_the_same) {
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-12, 0.0}) {
    const Vec4d middle = slerp(turn({0, 1, 0}, 0.0), turn({0, 1, 0}, angle), 0.25);
    EXPECT_NEAR(middle.y, std::sin(angle / 8.0), 1e-15 * angle + 1e-18) << angle;
    EXPECT_NEAR(glm::length(middle), 1.0, 1e-15);
  }
}

TEST(Slerp, takes_the_short_way_round) {
  const Vec4d a = turn({0, 0, 1}, 0.0), b = turn({0, 0, 1}, k_pi / 2.0);
  EXPECT_LT(largest_difference(slerp(a, -b, 0.5), turn({0, 0, 1}, k_pi / 4.0)), 1e-15);
  EXPECT_LT(largest_difference(slerp(a, b, 0.5), turn({0, 0, 1}, k_pi / 4.0)), 1e-15);
}

TEST(Sampling, linear_translation_lies_on_the_line_between_two_keys) {
  const Channel channel = channel_of(ChannelPath::translation, Interpolation::linear, {1.0, 3.0},
                                     {Vec4d(0, 10, -4, 0), Vec4d(8, 10, 4, 0)});
  EXPECT_EQ(sample(channel, 1.5), Vec4d(2, 10, -2, 0));
  EXPECT_EQ(sample(channel, 2.0), Vec4d(4, 10, 0, 0));
}

TEST(Sampling, the_first_and_the_last_key_hold_outside_the_keys) {
  for (const Interpolation kind : {Interpolation::linear, Interpolation::step}) {
    const Channel channel = channel_of(ChannelPath::scale, kind, {1.0, 3.0}, {Vec4d(1, 2, 3, 0), Vec4d(4, 5, 6, 0)});
    EXPECT_EQ(sample(channel, -5.0), Vec4d(1, 2, 3, 0));
    EXPECT_EQ(sample(channel, 1.0), Vec4d(1, 2, 3, 0));
    EXPECT_EQ(sample(channel, 3.0), Vec4d(4, 5, 6, 0));
    EXPECT_EQ(sample(channel, 1e9), Vec4d(4, 5, 6, 0));
  }
  const Channel spline = channel_of(ChannelPath::translation, Interpolation::cubic_spline, {1.0, 3.0},
                                    {Vec4d(9), Vec4d(1, 2, 3, 0), Vec4d(9), Vec4d(9), Vec4d(4, 5, 6, 0), Vec4d(9)});
  EXPECT_EQ(sample(spline, 0.0), Vec4d(1, 2, 3, 0));
  EXPECT_EQ(sample(spline, 4.0), Vec4d(4, 5, 6, 0));
}

TEST(Sampling, a_step_holds_each_value_until_the_next_key) {
  const Channel channel = channel_of(ChannelPath::translation, Interpolation::step, {0.0, 1.0, 2.0},
                                     {Vec4d(1, 0, 0, 0), Vec4d(2, 0, 0, 0), Vec4d(3, 0, 0, 0)});
  EXPECT_EQ(sample(channel, std::nextafter(1.0, 0.0)).x, 1.0);
  EXPECT_EQ(sample(channel, 1.0).x, 2.0);
  EXPECT_EQ(sample(channel, 1.999).x, 2.0);
}

TEST(Sampling, a_single_key_holds_always) {
  const Channel channel = channel_of(ChannelPath::translation, Interpolation::linear, {2.0}, {Vec4d(1, 2, 3, 0)});
  for (const double time_s : {0.0, 2.0, 5.0}) EXPECT_EQ(sample(channel, time_s), Vec4d(1, 2, 3, 0));
}

// A cubic f is its own Hermite spline: its tangents are f' in units per second, whatever the length of the interval.
TEST(Sampling, a_cubic_spline_reproduces_a_cubic_polynomial_over_uneven_intervals) {
  const auto f = [](double t) { return 2.0 * t * t * t - 5.0 * t * t + 0.5 * t - 7.0; };
  const auto slope = [](double t) { return 6.0 * t * t - 10.0 * t + 0.5; };
  const std::vector<double> times_s = {0.0, 0.25, 2.0, 5.0};
  std::vector<Vec4d> values;
  for (const double t : times_s) {
    values.insert(values.end(), {Vec4d(slope(t)), Vec4d(f(t), -f(t), 1.0, 0.0), Vec4d(slope(t), -slope(t), 0.0, 0.0)});
    values[values.size() - 3] = Vec4d(slope(t), -slope(t), 0.0, 0.0);
  }
  const Channel channel = channel_of(ChannelPath::translation, Interpolation::cubic_spline, times_s, values);
  for (double t = 0.0; t <= 5.0; t += 0.01) {
    const Vec4d value = sample(channel, t);
    ASSERT_NEAR(value.x, f(t), 1e-12 * (1.0 + std::abs(f(t)))) << t;
    ASSERT_NEAR(value.y, -f(t), 1e-12 * (1.0 + std::abs(f(t)))) << t;
    ASSERT_NEAR(value.z, 1.0, 1e-14) << t;
  }
}

TEST(Sampling, a_cubic_spline_uses_the_out_tangent_of_the_key_before_and_the_in_tangent_of_the_key_after) {
  const Vec4d unused(1e6);
  const Channel channel = channel_of(ChannelPath::translation, Interpolation::cubic_spline, {0.0, 4.0},
                                     {unused, Vec4d(0.0), Vec4d(1, 0, 0, 0), Vec4d(0, 1, 0, 0), Vec4d(0.0), unused});
  // The formula of glTF 2.0 appendix C at t = 1/2: td (t³ - 2t² + t) = 4/8, td (t³ - t²) = -4/8.
  EXPECT_EQ(sample(channel, 2.0), Vec4d(0.5, -0.5, 0, 0));
}

TEST(Sampling, a_rotation_is_of_unit_length_at_every_time_and_in_every_interpolation) {
  const Vec4d a = turn({1, 2, 3}, 0.4), b = turn({-1, 0, 2}, 2.5), tangent(0.3, -0.8, 0.1, 0.6);
  const std::vector<Channel> channels = {
      channel_of(ChannelPath::rotation, Interpolation::linear, {0.0, 1.0}, {a * 1.005, b * 0.995}),
      channel_of(ChannelPath::rotation, Interpolation::step, {0.0, 1.0}, {a * 1.005, b}),
      channel_of(ChannelPath::rotation, Interpolation::cubic_spline, {0.0, 1.0},
                 {tangent, a, tangent, tangent, b, tangent})};
  for (const Channel& channel : channels) {
    for (double t = -0.1; t < 1.2; t += 0.05) ASSERT_NEAR(glm::length(sample(channel, t)), 1.0, 1e-15) << t;
  }
}

}  // namespace
}  // namespace clusterbench::scene
