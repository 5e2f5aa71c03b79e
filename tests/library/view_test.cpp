#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "library/assign.h"

namespace clusterbench::library {
namespace {

using Numbers = std::array<double, 16>;
constexpr double k_endless = std::numeric_limits<double>::infinity();
constexpr double k_near = 0.25, k_far = 400.0;

Numbers transposed(const Numbers& m) {
  Numbers out;
  for (std::size_t i = 0; i < 16; ++i) out[i] = m[i % 4 * 4 + i / 4];
  return out;
}

// By columns, of a camera at (1, 2, 3) that looks along +x with z to the left: view x = -(z - 3)... right is +z.
Numbers pose(double forward_sign) {
  // Rows: right (0, 0, 1), top (0, 1, 0), forward_sign * (1, 0, 0).
  return {0, 0, forward_sign, 0, 0, 1, 0, 0, 1, 0, 0, 0, -3, -2, -forward_sign, 1};
}

// As the textbooks of each interface write it: sides as slopes, depth mapped to clip values at near and far.
Numbers perspective(double clip_near, double clip_far, double forward_sign, double y_sign, double far = k_far) {
  const double left = -0.4, right = 0.8, bottom = -0.3, top = 0.5;
  Numbers m{};
  m[0] = 2 / (right - left);
  m[5] = y_sign * 2 / (top - bottom);
  m[8] = forward_sign * -(right + left) / (right - left);
  m[9] = forward_sign * y_sign * -(top + bottom) / (top - bottom);
  // clip / w = a + b / depth.
  const double b = std::isinf(far) ? (clip_near - clip_far) * k_near : (clip_near - clip_far) / (1 / k_near - 1 / far);
  const double a = std::isinf(far) ? clip_far : clip_near - b / k_near;
  m[10] = forward_sign * a;
  m[11] = forward_sign;
  m[14] = b;
  return m;
}

Numbers orthographic(double clip_near, double clip_far, double forward_sign, double y_sign) {
  Numbers m{};
  m[0] = 2.0 / 12.0, m[5] = y_sign * 2.0 / 8.0, m[15] = 1.0;
  m[12] = -(8.0 - 4.0) / 12.0, m[13] = y_sign * -(5.0 - 3.0) / 8.0;
  m[10] = forward_sign * (clip_far - clip_near) / (k_far - k_near);
  m[14] = clip_near - (clip_far - clip_near) / (k_far - k_near) * k_near;
  return m;
}

struct Api {
  const char* name;
  Conventions::Depth depth;
  double clip_near, clip_far;
};

constexpr Api k_apis[] = {{"0 to 1", Conventions::Depth::zero_to_one, 0.0, 1.0},
                          {"reverse", Conventions::Depth::one_to_zero, 1.0, 0.0},
                          {"-1 to 1", Conventions::Depth::minus_one_to_one, -1.0, 1.0}};

void expect_pose(const View& view) {
  const double expected[3][3] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(view.eye[i], i + 1.0);
    EXPECT_DOUBLE_EQ(view.to_right[i], expected[0][i]);
    EXPECT_DOUBLE_EQ(view.to_top[i], expected[1][i]);
    EXPECT_DOUBLE_EQ(view.forward[i], expected[2][i]);
  }
}

TEST(View, reads_matrices_in_all_conventions) {
  for (const Api& api : k_apis)
    for (const double forward : {-1.0, 1.0})
      for (const double y : {1.0, -1.0})
        for (const bool by_rows : {false, true})
          for (const double far : {k_far, k_endless}) {
            const Conventions conventions{by_rows ? Conventions::Order::rows : Conventions::Order::columns, api.depth,
                                          forward > 0.0, y < 0.0};
            const Numbers p = perspective(api.clip_near, api.clip_far, forward, y, far);
            const Numbers v = pose(forward);
            View view;
            const char* fault = view.set_matrices((by_rows ? transposed(v) : v).data(),
                                                  (by_rows ? transposed(p) : p).data(), conventions);
            ASSERT_EQ(fault, nullptr) << fault << " " << api.name << forward << y << by_rows << far;
            expect_pose(view);
            EXPECT_FALSE(view.is_orthographic);
            EXPECT_NEAR(view.left, -0.4, 1e-12);
            EXPECT_NEAR(view.right, 0.8, 1e-12);
            EXPECT_NEAR(view.bottom, -0.3, 1e-12);
            EXPECT_NEAR(view.top, 0.5, 1e-12);
            EXPECT_NEAR(view.near_m, k_near, 1e-9);
            if (std::isinf(far))
              EXPECT_EQ(view.far_m, k_endless);
            else
              EXPECT_NEAR(view.far_m, far, 1e-6);
          }
}

TEST(View, reads_orthographic_matrices) {
  for (const Api& api : k_apis)
    for (const double forward : {-1.0, 1.0})
      for (const double y : {1.0, -1.0}) {
        View view;
        const char* fault =
            view.set_matrices(pose(forward).data(), orthographic(api.clip_near, api.clip_far, forward, y).data(),
                              {Conventions::Order::columns, api.depth, forward > 0.0, y < 0.0});
        ASSERT_EQ(fault, nullptr) << fault;
        expect_pose(view);
        EXPECT_TRUE(view.is_orthographic);
        EXPECT_NEAR(view.left, -4.0, 1e-12);
        EXPECT_NEAR(view.right, 8.0, 1e-12);
        EXPECT_NEAR(view.bottom, -3.0, 1e-12);
        EXPECT_NEAR(view.top, 5.0, 1e-12);
        EXPECT_NEAR(view.near_m, k_near, 1e-9);
        EXPECT_NEAR(view.far_m, k_far, 1e-9);
      }
}

TEST(View, reads_single_precision_with_an_infinite_far_plane_of_engines) {
  // glm::tweakedInfinitePerspective and Bevy's reverse z, in the numbers that they have.
  const float infinite[16] = {1.2f, 0, 0, 0, 0, 2.1f, 0, 0, 0, 0, -1.0f, -1.0f, 0, 0, -0.2f, 0};
  const float reverse[16] = {1.2f, 0, 0, 0, 0, 2.1f, 0, 0, 0, 0, 0, -1.0f, 0, 0, 0.1f, 0};
  const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  View view;
  ASSERT_EQ(view.set_matrices(identity, infinite, {.depth = Conventions::Depth::minus_one_to_one}), nullptr);
  EXPECT_NEAR(view.near_m, 0.1, 1e-7);
  EXPECT_EQ(view.far_m, k_endless);
  ASSERT_EQ(view.set_matrices(identity, reverse, {.depth = Conventions::Depth::one_to_zero}), nullptr);
  EXPECT_NEAR(view.near_m, 0.1, 1e-7);
  EXPECT_EQ(view.far_m, k_endless);
}

TEST(View, refuses_what_is_no_camera_and_stays_as_it_was) {
  const Numbers v = pose(-1.0), p = perspective(0.0, 1.0, -1.0, 1.0);
  const auto fault_with = [&](const Numbers& pose_numbers, const Numbers& projection,
                              const Conventions& conventions = {}) {
    View view;
    view.eye[0] = 77.0;
    const char* fault = view.set_matrices(pose_numbers.data(), projection.data(), conventions);
    EXPECT_EQ(view.eye[0], 77.0);
    EXPECT_EQ(view.right, 1.0);
    return std::string(fault == nullptr ? "none" : fault);
  };
  const auto changed = [](Numbers numbers, std::size_t at, double value) {
    numbers[at] = value;
    return numbers;
  };
  EXPECT_TRUE(fault_with(transposed(v), p).starts_with("world_to_view: its last row"));
  EXPECT_TRUE(fault_with(changed(v, 2, -3.0), p).starts_with("world_to_view: is no rotation"));
  EXPECT_TRUE(fault_with(changed(v, 12, std::nan("")), p).starts_with("world_to_view: has a number"));
  EXPECT_TRUE(fault_with(v, changed(p, 0, k_endless)).starts_with("projection: has a number"));
  EXPECT_TRUE(fault_with(v, transposed(p)).starts_with("projection: its last row"));
  EXPECT_TRUE(fault_with(v, Numbers{}).starts_with("projection: its last row is 0"));
  EXPECT_TRUE(fault_with(v, changed(p, 1, 0.5)).starts_with("projection: is singular"));
  EXPECT_TRUE(fault_with(v, changed(p, 0, -1.0)).starts_with("projection: mirrors"));
  EXPECT_TRUE(fault_with(v, changed(p, 5, -1.0)).starts_with("projection: turns the picture"));
  EXPECT_TRUE(fault_with(v, p, {.looks_along_positive_z = true}).starts_with("projection: is that of a camera"));
  EXPECT_TRUE(fault_with(v, perspective(1.0, 0.0, -1.0, 1.0)).starts_with("projection: its near plane"));
  const Conventions reverse{.depth = Conventions::Depth::one_to_zero};
  EXPECT_EQ(fault_with(v, changed(perspective(1.0, 0.0, -1.0, 1.0, k_endless), 14, 0.0), reverse),
            "projection: has its near plane at the eye; the last number of its third row must not be 0");
}

TEST(View, refuses_matrices_that_are_not_there) {
  const Numbers numbers{};
  const double* none = nullptr;
  const float* neither = nullptr;
  View view;
  EXPECT_STREQ(view.set_matrices(none, numbers.data()), "world_to_view: is null; allowed: 16 numbers");
  EXPECT_STREQ(view.set_matrices(numbers.data(), none), "projection: is null; allowed: 16 numbers");
  EXPECT_STREQ(view.set_matrices(neither, neither), "world_to_view: is null; allowed: 16 numbers");
}

TEST(View, refuses_conventions_that_are_none) {
  const Numbers v = pose(-1.0), p = perspective(0.0, 1.0, -1.0, 1.0);
  Conventions order, depth;
  order.order = static_cast<Conventions::Order>(5);
  depth.depth = static_cast<Conventions::Depth>(5);
  View view;
  EXPECT_STREQ(view.set_matrices(v.data(), p.data(), order), "conventions.order: is none; allowed: columns, rows");
  EXPECT_STREQ(view.set_matrices(v.data(), p.data(), depth),
               "conventions.depth: is none; allowed: zero_to_one, one_to_zero, minus_one_to_one");
}

// The same limit where axes are given and where they are in a matrix.
TEST(View, takes_axes_up_to_the_tolerance_of_the_header) {
  LightLists lists;
  ASSERT_TRUE(lists.start({}));
  for (const double off : {0.9e-3, 1.1e-3, 1.9e-3}) {
    const bool is_within = off < 1e-3;
    View given, read;
    given.width = read.width = 64, given.height = read.height = 64;
    given.to_right[1] = off;  // times to_top
    EXPECT_EQ(lists.update(given, {}), is_within) << off << " " << lists.error();
    const Numbers world_to_view{1, 0, 0, 0, off, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const char* fault = read.set_matrices(world_to_view.data(), perspective(0.0, 1.0, -1.0, 1.0).data());
    EXPECT_EQ(fault == nullptr, is_within) << off;
    EXPECT_EQ(fault == nullptr && lists.update(read, {}), is_within) << off << " " << lists.error();
  }
}

}  // namespace
}  // namespace clusterbench::library
