#pragma once
// One trial of a hard case: one scene, camera, picture and grid, with everything that a person needs to run it again.

#include <string>
#include <vector>

#include "assign/contract/assigner.h"
#include "grid/grid.h"
#include "scene/scene.h"

namespace clusterbench::stress {

struct Trial {
  std::string label;
  scene::Scene scene;  // one fixed camera; ranges resolved
  Vec2i viewport{1920, 1080};
  grid::GridSpec grid;
  bool is_refused = false;  // the grid must be refused for this camera
};

// Builds a trial: lights around a camera at the origin that looks down -z (vertical field of view 60 degrees, 0.1 to
// 500 m) unless it is placed elsewhere.
class Rig {
 public:
  Rig();

  Rig& point(const Vec3d& position, double range_m, int parent = -1);
  Rig& spot(const Vec3d& position, const Vec3d& direction, double range_m, double half_angle_rad);
  // A node for lights; returns its number for use as a parent.
  int node(const scene::Node& node);
  scene::CameraProjection& projection() { return scene_.cameras[0].projection; }
  Rig& look(const Vec3d& eye, double yaw_rad);
  Rig& show(Vec2i viewport);

  Trial on(const grid::GridSpec& grid, const std::string& label = "") const;
  // Adds to the trials, on each of the grids.
  void on_each(const std::vector<grid::GridSpec>& grids, const std::string& label, std::vector<Trial>& trials) const;

 private:
  scene::Scene scene_;
  Vec2i viewport_{1920, 1080};
};

// Grids of a perspective picture.
grid::GridSpec frustum_grid(Vec2i tiles, grid::Scheme scheme, int slices, double near_m, double far_m,
                            double first_m = 5.0);
grid::GridSpec pixel_grid(Vec2i tile_pixels);  // 16 slices 0.1..5..500
// One of each kind: two of frustum, distance, cascades, world.
std::vector<grid::GridSpec> grids_of_every_kind();

// Whether there are oriented boxes among its lights.
bool has_boxes(const Trial& trial);

// The frame of a trial's camera, and its grid. Throws Error for an impossible grid.
view::Frame frame_of(const Trial& trial);
grid::Grid grid_of(const Trial& trial, const view::Frame& frame);
// A trial has no triangles: depths at random, the same every time, for methods that need them; an image without pixels
// for others.
depth::DepthImage depths_for(const assign::AssignerDescriptor& assigner, const view::Frame& frame);
assign::FrameInput input_of(const view::Frame& frame, const view::LightArrays& lights, const depth::DepthImage& depths);

}  // namespace clusterbench::stress
