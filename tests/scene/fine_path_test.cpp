#include "scene/fine_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clusterbench::scene {
namespace {

constexpr double k_rounding = 1.0 + 1e-9;

// A camera at `eye` that has turned to its left by `yaw_rad` from -z.
Shot shot_at(double time_s, const Vec3d& eye, double yaw_rad = 0.0) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  Shot shot;
  shot.time_s = time_s;
  shot.pose = {eye, Mat3d(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c)};
  shot.projection.yfov_rad = 1.0;
  return shot;
}

CameraPath path_with(std::vector<Shot> shots) {
  return {"eye", false, "", std::move(shots)};
}

double yaw_of(const Shot& shot) {
  const Vec3d ahead = -glm::transpose(shot.pose.view_from_world)[2];
  return std::atan2(-ahead.x, -ahead.z);
}

void expect_within_limits(const FinePath& fine, const FineSteps& steps) {
  const std::vector<Shot>& shots = fine.path.shots;
  for (std::size_t i = 0; i + 1 < shots.size(); ++i) {
    EXPECT_LE(glm::length(shots[i + 1].pose.eye - shots[i].pose.eye), steps.largest_move_m * k_rounding) << i;
    EXPECT_LE(std::abs(yaw_of(shots[i + 1]) - yaw_of(shots[i])), steps.largest_turn_rad * k_rounding) << i;
  }
  EXPECT_LE(fine.move_m, steps.largest_move_m * k_rounding);
  EXPECT_LE(fine.turn_rad, steps.largest_turn_rad * k_rounding);
}

TEST(FinePath, both_limits_hold_when_the_eye_moves_fast_and_when_the_view_turns_fast) {
  const FineSteps steps{400, 1e-3, 2e-4};
  const FinePath moving = fine_path(path_with({shot_at(0, {0, 0, 0}), shot_at(1, {0.35, 0, 0}, 0.01)}), steps);
  expect_within_limits(moving, steps);
  EXPECT_EQ(moving.path.shots.size(), 351u);
  EXPECT_NEAR(moving.move_m, 1e-3, 1e-9);
  const FinePath turning = fine_path(path_with({shot_at(0, {0, 0, 0}), shot_at(1, {0.01, 0, 0}, 0.0701)}), steps);
  expect_within_limits(turning, steps);
  EXPECT_EQ(turning.path.shots.size(), 352u);
  EXPECT_NEAR(turning.turn_rad, 0.0701 / 351, 1e-9);
}

TEST(FinePath, is_not_jittered) {
  Shot first = shot_at(0, {0, 0, 0}), second = shot_at(1, {0.35, 0, 0});
  first.jitter_px = second.jitter_px = {0.25, -0.25};
  for (const FineSteps& steps : {FineSteps{400, 1e-3, 2e-4}, FineSteps{5, 1e-3, 2e-4}})
    for (const Shot& shot : fine_path(path_with({first, second}), steps).path.shots)
      EXPECT_EQ(shot.jitter_px, Vec2d(0.0));
  for (const Shot& shot : fine_path(path_with({first}), {5, 1e-3, 2e-4}).path.shots)
    EXPECT_EQ(shot.jitter_px, Vec2d(0.0)) << "drifting";
}

TEST(FinePath, begins_where_the_camera_moves_most_in_terms_of_the_limits) {
  // By 0.2 m; by 0.1 rad, which are more steps; by 0.3 m.
  const std::vector<Shot> shots{shot_at(0, {0, 0, 0}), shot_at(1, {0.2, 0, 0}), shot_at(2, {0.2, 0, 0}, 0.1),
                                shot_at(3, {0.5, 0, 0}, 0.1)};
  EXPECT_EQ(fine_path(path_with(shots), {10, 1e-3, 2e-4}).from_shot, 1);
  EXPECT_EQ(fine_path(path_with(shots), {10, 1e-3, 1e-2}).from_shot, 2);
}

TEST(FinePath, place_time_and_view_change_evenly_and_go_on_through_the_next_shots) {
  constexpr double k_step_m = 1.0 / 1024.0;
  const FinePath fine = fine_path(path_with({shot_at(5, {1, 2, 3}), shot_at(6, {1, 2, 3 + 10 * k_step_m}, 0.02),
                                             shot_at(8, {1, 2 + 4 * k_step_m, 3 + 10 * k_step_m}, 0.02)}),
                                  {12, k_step_m, 1.0});
  const std::vector<Shot>& shots = fine.path.shots;
  ASSERT_EQ(shots.size(), 13u);
  EXPECT_EQ(shots[0].pose.eye, Vec3d(1, 2, 3));
  EXPECT_NEAR(shots[3].pose.eye.z, 3 + 3 * k_step_m, 1e-12);
  EXPECT_NEAR(shots[3].time_s, 5.3, 1e-12);
  EXPECT_NEAR(yaw_of(shots[3]), 0.006, 1e-12);
  EXPECT_NEAR(shots[12].pose.eye.y, 2 + 2 * k_step_m, 1e-12);
  EXPECT_NEAR(shots[12].time_s, 7.0, 1e-12);
  EXPECT_EQ(shots[12].projection.yfov_rad, 1.0);
}

TEST(FinePath, a_view_that_does_not_turn_stays_the_same_to_the_last_bit) {
  const Shot first = shot_at(0, {0, 0, 0}, 0.7);
  Shot last = shot_at(1, {0, 0, 0.05}, 0.7);
  for (const Shot& shot : fine_path(path_with({first, last}), {50, 1e-3, 1e-3}).path.shots)
    EXPECT_EQ(shot.pose.view_from_world, first.pose.view_from_world);
  last.pose.view_from_world[0].x += 1e-16;
  EXPECT_EQ(fine_path(path_with({first, last}), {50, 1e-3, 1e-3}).turn_rad, 0.0) << "rounding is no turn";
}

TEST(FinePath, ends_early_where_the_path_ends_or_the_camera_stands_still) {
  const Shot first = shot_at(0, {0, 0, 0}), second = shot_at(1, {0, 0, 0.05}), later = shot_at(2, {0, 0, 0.05});
  EXPECT_EQ(fine_path(path_with({first, second}), {200, 1e-3, 1e-3}).path.shots.size(), 51u);
  EXPECT_EQ(fine_path(path_with({first, second, later, shot_at(3, {0, 0, 0.09})}), {200, 1e-3, 1e-3}).path.shots.size(),
            51u);
}

TEST(FinePath, a_camera_that_stands_still_drifts_ahead_and_to_the_right_and_says_so) {
  const FineSteps steps{30, 2e-3, 1e-3};
  const FinePath fine = fine_path(path_with({shot_at(4, {7, 8, 9}, 0.5), shot_at(5, {7, 8, 9}, 0.5)}), steps);
  EXPECT_TRUE(fine.is_drift);
  EXPECT_NE(fine.path.how.find("made to drift"), std::string::npos) << fine.path.how;
  ASSERT_EQ(fine.path.shots.size(), 31u);
  expect_within_limits(fine, steps);
  const Shot& last = fine.path.shots.back();
  EXPECT_NEAR(glm::length(last.pose.eye - Vec3d(7, 8, 9)), 0.06, 1e-12);
  EXPECT_NEAR(last.pose.eye.x, 7 - 0.06 * std::sin(0.5), 1e-12);
  EXPECT_NEAR(yaw_of(last), 0.5 - 0.03, 1e-12);
  EXPECT_EQ(last.time_s, 4.0);
  EXPECT_FALSE(fine_path(path_with({shot_at(0, {0, 0, 0}), shot_at(1, {0, 0, 0.05})}), steps).is_drift);
}

}  // namespace
}  // namespace clusterbench::scene
