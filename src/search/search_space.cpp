#include "search/search_space.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace clusterbench::search {
namespace {

constexpr double k_turn = 6.28318530717958647692;

double between(double lo, double hi, double share) {
  return lo + (hi - lo) * share;
}

double share_of(double lo, double hi, double value) {
  return hi > lo ? std::clamp((value - lo) / (hi - lo), 0.0, 1.0) : 0.5;
}

// One of several by its share of the edge.
std::size_t index_at(double share, std::size_t count) {
  return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
}

double share_of_index(std::size_t index, std::size_t count) {
  return (static_cast<double>(index) + 0.5) / static_cast<double>(count);
}

// The rotation with the smallest turn from another one.
std::size_t nearest_rotation(const std::vector<Vec4d>& rotations, const Vec4d& to) {
  const auto alike = [&](const Vec4d& rotation) { return std::abs(glm::dot(rotation, to)); };
  return static_cast<std::size_t>(std::ranges::max_element(rotations, {}, alike) - rotations.begin());
}

// About the upright axis, and then upward.
Vec4d turned(double yaw_rad, double pitch_rad) {
  const double cy = std::cos(0.5 * yaw_rad), sy = std::sin(0.5 * yaw_rad);
  const double cp = std::cos(0.5 * pitch_rad), sp = std::sin(0.5 * pitch_rad);
  return rounded_to_float(Vec4d{cy * sp, sy * cp, -sy * sp, cy * cp});
}

}  // namespace

bool Box::holds(const Vec3d& point) const {
  return glm::clamp(point, lo, hi) == point;
}

void Box::add(const Vec3d& point) {
  lo = glm::min(lo, point);
  hi = glm::max(hi, point);
}

SearchSpace::SearchSpace(const Box& eyes, const Box& lights, std::size_t moments, std::size_t extra_lights,
                         const Walkable* floor, double eye_height_m, std::vector<Vec4d> rotations)
    : eyes_(eyes),
      lights_(lights),
      moments_(moments),
      extra_lights_(extra_lights),
      floor_(floor),
      eye_height_m_(eye_height_m),
      rotations_(std::move(rotations)) {}

FrameChoice SearchSpace::at(std::span<const double> point) const {
  FrameChoice out;
  Vec3d eye;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    eye[i] = between(eyes_.lo[i], eyes_.hi[i], point[axis]);
  }
  if (floor_ != nullptr) {
    const Vec3d height{0.0, eye_height_m_, 0.0};
    eye = floor_->nearest(eye - height) + height;
  }
  out.eye = rounded_to_float(eye);
  if (rotations_.empty())
    out.rotation = turned(k_turn * (point[3] - 0.5), std::asin(std::clamp(2.0 * point[4] - 1.0, -1.0, 1.0)));
  else
    out.rotation = rotations_[rotations_.size() > 1 ? index_at(point[3], rotations_.size()) : 0];
  std::size_t next = pose_dimensions();
  if (moments_ > 1) out.moment = index_at(point[next++], moments_);
  // Relative to the eye, so that lights keep their effect when it moves, and finer near it.
  for (std::size_t light = 0; light < extra_lights_; ++light) {
    Vec3d position = eye;
    for (int axis = 0; axis < 3; ++axis) {
      const double side = 2.0 * point[next++] - 1.0;
      position[axis] += side * std::abs(side) * (lights_.hi[axis] - lights_.lo[axis]);
    }
    out.extra_lights.push_back(rounded_to_float(glm::clamp(position, lights_.lo, lights_.hi)));
  }
  return out;
}

std::vector<double> SearchSpace::point_of(const Vec3d& eye, const Vec4d& rotation, std::size_t moment) const {
  std::vector<double> point(dimensions(), 0.5);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    point[axis] = share_of(eyes_.lo[i], eyes_.hi[i], eye[i]);
  }
  if (rotations_.empty()) {
    const Vec3d forward = direction_of(rotation);
    point[3] = std::clamp(std::atan2(-forward.x, -forward.z) / k_turn + 0.5, 0.0, 1.0);
    point[4] = std::clamp(0.5 * (forward.y + 1.0), 0.0, 1.0);
  } else if (rotations_.size() > 1) {
    point[3] = share_of_index(nearest_rotation(rotations_, rotation), rotations_.size());
  }
  if (moments_ > 1) point[pose_dimensions()] = share_of_index(moment, moments_);
  return point;
}

std::vector<double> SearchSpace::random(SplitMix64& random) const {
  std::vector<double> point(dimensions());
  for (double& share : point) share = random.unit();
  if (floor_ == nullptr) return point;
  const Vec3d eye = floor_->random(random) + Vec3d{0.0, eye_height_m_, 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    point[axis] = share_of(eyes_.lo[i], eyes_.hi[i], eye[i]);
  }
  return point;
}

Vec4d rotation_of(const scene::CameraPose& pose) {
  const glm::dquat q = glm::quat_cast(glm::transpose(pose.view_from_world));
  return rounded_to_float(Vec4d{q.x, q.y, q.z, q.w});
}

Vec3d direction_of(const Vec4d& q) {
  return {-2.0 * (q.x * q.z + q.w * q.y), -2.0 * (q.y * q.z - q.w * q.x), -1.0 + 2.0 * (q.x * q.x + q.y * q.y)};
}

}  // namespace clusterbench::search
