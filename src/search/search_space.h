#pragma once
// The variables of a search, as a cube with edges of 0 to 1: the camera's position and direction, the moment of the
// scene's lights, and positions of extra lights.

#include <optional>
#include <span>
#include <vector>

#include "core/random.h"
#include "search/path_scene.h"
#include "search/walkable.h"

namespace clusterbench::search {

class SearchSpace {
 public:
  // `eyes`: possible positions of the camera. `lights`: of extra lights. `floor`: instead, the camera stands at this
  // height above it, in the part of the floor nearest to a point of `eyes`; must outlive this object. `rotations`: the
  // only ones for the camera; empty: any direction, upright.
  SearchSpace(const Box& eyes, const Box& lights, std::size_t moments, std::size_t extra_lights,
              const Walkable* floor = nullptr, double eye_height_m = 0.0, std::vector<Vec4d> rotations = {});

  std::size_t dimensions() const { return pose_dimensions() + (moments_ > 1 ? 1 : 0) + 3 * extra_lights_; }
  // The frame at a point of the cube. Positions are rounded to single precision, which can move them out of a box.
  FrameChoice at(std::span<const double> point) const;
  // The point for a camera that looks along the -z of `rotation` (its roll is lost, unless it is one of the allowed
  // rotations), moved into the cube. Extra lights are at the eye.
  std::vector<double> point_of(const Vec3d& eye, const Vec4d& rotation, std::size_t moment) const;
  // Eyes evenly in the box, or over the floor's area; directions evenly over the sphere; extra lights as in at().
  std::vector<double> random(SplitMix64& random) const;
  const Box& eyes() const { return eyes_; }

 private:
  std::size_t pose_dimensions() const { return 3 + (rotations_.empty() ? 2 : rotations_.size() > 1 ? 1 : 0); }

  Box eyes_, lights_;
  std::size_t moments_, extra_lights_;
  const Walkable* floor_;
  double eye_height_m_;
  std::vector<Vec4d> rotations_;
};

// The rotation of the camera's node, in single precision, for a pose.
Vec4d rotation_of(const scene::CameraPose& pose);
// The direction of view.
Vec3d direction_of(const Vec4d& rotation);

}  // namespace clusterbench::search
