#include "scene/fine_path.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "scene/animation.h"

namespace clusterbench::scene {
namespace {

// A rotation as a unit quaternion x, y, z, w.
Vec4d quaternion_of(const Mat3d& rotation) {
  const glm::dquat q = glm::quat_cast(rotation);
  return {q.x, q.y, q.z, q.w};
}

Mat3d matrix_of(const Vec4d& q) {
  return glm::mat3_cast(glm::dquat(q.w, q.x, q.y, q.z));
}

// The angle of the rotation from a to b.
double turn_between(const Mat3d& a, const Mat3d& b) {
  const Vec4d q = quaternion_of(b * glm::transpose(a));
  return 2.0 * std::atan2(glm::length(Vec3d(q)), std::abs(q.w));
}

// The number of maximal steps between two shots; not a whole number.
double steps_between(const Shot& a, const Shot& b, const FineSteps& steps) {
  return std::max(glm::length(b.pose.eye - a.pose.eye) / steps.largest_move_m,
                  turn_between(a.pose.view_from_world, b.pose.view_from_world) / steps.largest_turn_rad);
}

// Motion below this part of a step counts as none: it is only rounding.
constexpr double k_still = 1e-6;

Shot between(const Shot& a, const Shot& b, double t) {
  Shot shot = a;
  if (t == 0.0) return shot;
  shot.time_s = (1.0 - t) * a.time_s + t * b.time_s;
  shot.pose.eye = (1.0 - t) * a.pose.eye + t * b.pose.eye;
  const Mat3d &from = a.pose.view_from_world, &to = b.pose.view_from_world;
  if (from != to) shot.pose.view_from_world = matrix_of(slerp(quaternion_of(from), quaternion_of(to), t));
  return shot;
}

std::size_t fastest_shot(const std::vector<Shot>& shots, const FineSteps& steps) {
  std::size_t fastest = 0;
  double most = 0.0;
  for (std::size_t i = 0; i + 1 < shots.size(); ++i) {
    const double length = steps_between(shots[i], shots[i + 1], steps);
    if (length <= most) continue;
    most = length;
    fastest = i;
  }
  return fastest;
}

std::vector<Shot> shots_along(const std::vector<Shot>& shots, std::size_t from, const FineSteps& steps) {
  std::vector<Shot> out{shots[from]};
  const auto wanted = static_cast<std::size_t>(steps.count) + 1;
  for (std::size_t i = from; i + 1 < shots.size() && out.size() < wanted; ++i) {
    const double length = steps_between(shots[i], shots[i + 1], steps);
    if (!(length > k_still)) break;
    const double parts = std::ceil(length);
    for (double part = 1.0; part <= parts && out.size() < wanted; ++part)
      out.push_back(between(shots[i], shots[i + 1], part / parts));
  }
  return out;
}

std::vector<Shot> drifting_shots(const Shot& start, const FineSteps& steps) {
  std::vector<Shot> out{start};
  const Vec3d forward = -glm::transpose(start.pose.view_from_world)[2];
  for (int step = 1; step <= steps.count; ++step) {
    const double turn = step * steps.largest_turn_rad, c = std::cos(turn), s = std::sin(turn);
    Shot shot = start;
    shot.pose.eye += step * steps.largest_move_m * forward;
    // A point ahead, -z, moves to the left, -x.
    shot.pose.view_from_world = Mat3d(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c) * start.pose.view_from_world;
    out.push_back(shot);
  }
  return out;
}

std::string drift_text(const FineSteps& steps) {
  char text[160];
  std::snprintf(text, sizeof text,
                "standing camera, made to drift %g mm forward and %g degrees to the right per step; lights held",
                steps.largest_move_m * 1e3, glm::degrees(steps.largest_turn_rad));
  return text;
}

void measure_steps(FinePath& fine, const FineSteps& steps) {
  const std::vector<Shot>& shots = fine.path.shots;
  for (std::size_t i = 0; i + 1 < shots.size(); ++i) {
    fine.move_m = std::max(fine.move_m, glm::length(shots[i + 1].pose.eye - shots[i].pose.eye));
    fine.turn_rad =
        std::max(fine.turn_rad, turn_between(shots[i].pose.view_from_world, shots[i + 1].pose.view_from_world));
  }
  if (fine.move_m < k_still * steps.largest_move_m) fine.move_m = 0.0;
  if (fine.turn_rad < k_still * steps.largest_turn_rad) fine.turn_rad = 0.0;
}

}  // namespace

FinePath fine_path(const CameraPath& path, const FineSteps& steps) {
  FinePath fine;
  fine.path = {path.camera, path.made, "", {}};
  const std::size_t from = fastest_shot(path.shots, steps);
  fine.path.shots = shots_along(path.shots, from, steps);
  fine.is_drift = fine.path.shots.size() == 1;
  if (fine.is_drift) {
    fine.path.shots = drifting_shots(path.shots.front(), steps);
    fine.path.how = drift_text(steps);
  } else {
    fine.from_shot = static_cast<int>(from);
    fine.path.how = std::to_string(fine.path.shots.size() - 1) + " steps from frame " + std::to_string(from) +
                    ", where the camera moves most";
  }
  for (Shot& shot : fine.path.shots) shot.jitter_px = Vec2d(0.0);  // a pixel is larger than a step
  measure_steps(fine, steps);
  return fine;
}

}  // namespace clusterbench::scene
