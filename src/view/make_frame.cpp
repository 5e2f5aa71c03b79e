// Frames of a scene. Apart from frame.cpp, which needs no scene.

#include <utility>

#include "scene/domain_check.h"
#include "view/frame.h"

namespace clusterbench::view {
namespace {

// The rectangle moved against the picture.
Projection jittered(Projection projection, Vec2d jitter_px, Vec2i viewport) {
  if (jitter_px == Vec2d(0.0)) return projection;
  const double right = jitter_px.x * (projection.right - projection.left) / viewport.x;
  const double down = jitter_px.y * (projection.top - projection.bottom) / viewport.y;
  projection.left -= right;
  projection.right -= right;
  projection.bottom += down;
  projection.top += down;
  return projection;
}

}  // namespace

Frame make_frame(const scene::Scene& scene, const scene::Shot& shot, int index, Vec2i viewport) {
  std::vector<scene::WorldLight> lights = scene::world_lights(scene, shot.time_s);
  scene::check_domain(scene, lights, shot.time_s);
  return make_frame(scene, shot, index, viewport, std::move(lights));
}

Frame make_frame(const scene::Scene& scene, const scene::Shot& shot, int index, Vec2i viewport,
                 std::vector<scene::WorldLight> lights) {
  scene::check_domain(scene, "", shot);
  Frame frame;
  frame.index = index;
  frame.time_s = shot.time_s;
  frame.viewport = viewport;
  frame.projection = jittered(make_projection(shot.projection, viewport), shot.jitter_px, viewport);
  check_projection(frame.projection);
  frame.view_space = {shot.pose.eye, shot.pose.view_from_world};
  frame.lights = std::move(lights);
  frame.count_types();
  return frame;
}

}  // namespace clusterbench::view
