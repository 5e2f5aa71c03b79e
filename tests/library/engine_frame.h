#pragma once
// A frame as an engine has it, and the same one as the program has it.

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"
#include "geom/shapes/domain.h"
#include "grid/grid.h"
#include "library/assign.h"
#include "view/frame.h"

namespace clusterbench::library::testing {

struct EngineFrame {
  View view;
  std::vector<PointLight> points;
  std::vector<SpotLight> spots;
  std::vector<Box> boxes;

  Lights lights() const { return {points, spots, boxes}; }
};

inline void set_random(float (&out)[3], SplitMix64& random, double size) {
  for (float& number : out) number = static_cast<float>(random.between(-size, size));
}

// `boxes`: with an oriented box for every fifth light.
inline EngineFrame engine_frame(int lights, std::uint64_t seed, bool has_boxes = false) {
  EngineFrame frame;
  SplitMix64 random(seed);
  for (int i = 0; i < lights; ++i) {
    if (i % 3 != 0) {
      PointLight& point = frame.points.emplace_back();
      set_random(point.position, random, 60.0);
      point.range = static_cast<float>(random.between(0.5, 12.0));
    } else {
      SpotLight& spot = frame.spots.emplace_back();
      set_random(spot.position, random, 60.0);
      set_random(spot.direction, random, 1.0);
      spot.range = static_cast<float>(random.between(2.0, 25.0));
      spot.outer_angle = static_cast<float>(random.between(0.1, 1.5));
    }
    if (!has_boxes || i % 5 != 0) continue;
    Box& box = frame.boxes.emplace_back();
    set_random(box.center, random, 60.0);
    for (auto& axis : box.half_axes) set_random(axis, random, 3.0);
  }
  View& view = frame.view;
  view.width = 1280;
  view.height = 720;
  const double turn = random.between(0.0, 6.0), tilt = random.between(-0.5, 0.5);
  const double c = std::cos(turn), s = std::sin(turn), ct = std::cos(tilt), st = std::sin(tilt);
  const double right[3] = {c, 0.0, -s}, top[3] = {s * st, ct, c * st}, forward[3] = {-s * ct, st, -c * ct};
  for (int i = 0; i < 3; ++i) {
    view.to_right[i] = right[i], view.to_top[i] = top[i], view.forward[i] = forward[i];
    view.eye[i] = random.between(-20.0, 20.0);
  }
  view.top = 0.6, view.bottom = -0.6, view.left = -0.6 * 16 / 9, view.right = 0.6 * 16 / 9;
  view.near_m = 0.1, view.far_m = 150.0;
  return frame;
}

inline Vec3d vec(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

inline view::Frame program_frame(const EngineFrame& engine) {
  view::Frame frame;
  const View& view = engine.view;
  frame.viewport = {view.width, view.height};
  frame.projection = {view.is_orthographic, view.left, view.right, view.bottom, view.top, view.near_m, view.far_m};
  frame.view_space.origin = {view.eye[0], view.eye[1], view.eye[2]};
  for (int i = 0; i < 3; ++i) frame.view_space.rotation[i] = Vec3d(view.to_right[i], view.to_top[i], -view.forward[i]);
  for (const PointLight& point : engine.points) {
    scene::WorldLight& light = frame.lights.emplace_back();
    light.position = vec(point.position);
    light.range_m = static_cast<double>(point.range);
  }
  for (const SpotLight& spot : engine.spots) {
    scene::WorldLight& light = frame.lights.emplace_back();
    light.type = scene::LightType::spot;
    light.position = vec(spot.position);
    light.range_m = static_cast<double>(spot.range);
    light.direction = vec(spot.direction) / std::sqrt(dot(vec(spot.direction), vec(spot.direction)));
    light.outer_cone_rad = static_cast<double>(spot.outer_angle);
  }
  for (const Box& box : engine.boxes) {
    scene::WorldLight& light = frame.lights.emplace_back();
    light.type = scene::LightType::box;
    light.position = vec(box.center);
    for (std::size_t i = 0; i < 3; ++i) light.half_axes_m[i] = vec(box.half_axes[i]);
    light.range_m = scene::corner_distance_m(light.half_axes_m);
  }
  frame.count_types();
  return frame;
}

}  // namespace clusterbench::library::testing
