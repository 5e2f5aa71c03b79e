// Rooms on both sides of a hallway: an environment probe for each room and for parts of the hallway, decals on floors
// and walls, a few lamps. Probes are large boxes that share walls, decals small and flat ones, some with no thickness.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scene/generators/scenes.h"

namespace clusterbench::scene {
namespace {

constexpr double k_half_hallway = 2.0, k_depth = 8.0, k_height = 3.5, k_wall = 0.1;

// The turn about x (0), y (1) or z (2).
Vec4d turn_about(int axis, double angle_rad) {
  Vec4d q{0.0, 0.0, 0.0, std::cos(angle_rad / 2.0)};
  q[axis] = std::sin(angle_rad / 2.0);
  return q;
}

void add_walls(Stage& stage, int rooms_per_side) {
  const double length = k_depth * rooms_per_side, outer = k_half_hallway + k_depth;
  std::vector<Vec3d> corners;
  add_quad(corners, {-outer, 0.0, 0.0}, {2.0 * outer, 0.0, 0.0}, {0.0, 0.0, -length});
  add_quad(corners, {-outer, k_height, -length}, {2.0 * outer, 0.0, 0.0}, {0.0, 0.0, length});
  for (const double side : {-1.0, 1.0}) {
    add_box(corners, {std::min(side * outer, side * (outer + k_wall)), 0.0, -length},
            {std::max(side * outer, side * (outer + k_wall)), k_height, 0.0});
    const double near = std::min(side * k_half_hallway, side * (k_half_hallway + k_wall));
    for (int room = 0; room < rooms_per_side; ++room) {
      const double front = -k_depth * room;
      // A door of 2 m in the middle.
      add_box(corners, {near, 0.0, front - 3.0}, {near + k_wall, k_height, front});
      add_box(corners, {near, 0.0, front - k_depth}, {near + k_wall, k_height, front - 5.0});
      const double from = std::min(side * k_half_hallway, side * outer);
      add_box(corners, {from, 0.0, front - k_depth}, {from + k_depth, k_height, front - k_depth + k_wall});
    }
  }
  stage.mesh("walls", corners);
}

void add_probes(Stage& stage, int rooms_per_side) {
  const Vec3d half{k_depth / 2.0, k_height / 2.0, k_depth / 2.0};
  for (int room = 0; room < rooms_per_side; ++room)
    for (const double side : {-1.0, 1.0})
      stage.box("room probe " + std::to_string(2 * room + (side > 0.0 ? 1 : 0)),
                {side * (k_half_hallway + half.x), half.y, -k_depth * room - half.z}, {0.0, 0.0, 0.0, 1.0}, half);
  for (int part = 0; 2 * part < rooms_per_side; ++part)
    stage.box("hallway probe " + std::to_string(part), {0.0, half.y, -2.0 * k_depth * part - k_depth},
              {0.0, 0.0, 0.0, 1.0}, {k_half_hallway, half.y, k_depth});
}

// On the floor, the hallway's walls or the rooms' outer walls, turned within the surface.
void add_decal(Stage& stage, int index, double length) {
  constexpr double k_turn = 6.28318530717958647692;
  SplitMix64& random = stage.random();
  const int on = static_cast<int>(random.below(3));
  const double across = random.between(0.1, 0.6), along = random.between(0.1, 0.6), angle = random.between(0.0, k_turn);
  const double thickness = index % 8 == 0 ? 0.0 : random.between(0.02, 0.15);
  const double side = random.below(2) == 0 ? -1.0 : 1.0;
  const double outer = k_half_hallway + k_depth;
  Vec3d at = stage.position_in({-outer, 0.4, -length}, {outer, k_height - 0.4, 0.0});
  Vec3d half{across, thickness, along};
  if (on == 0) {
    at.y = 0.0;
  } else {
    at.x = side * (on == 1 ? k_half_hallway : outer);
    half = {thickness, across, along};
  }
  stage.box("decal " + std::to_string(index), at, turn_about(on == 0 ? 1 : 0, angle), half);
}

}  // namespace

void build_rooms(Stage& stage, int lights) {
  const int rooms_per_side = std::max(1, lights / 8);
  const double length = k_depth * rooms_per_side;
  SplitMix64& random = stage.random();
  add_walls(stage, rooms_per_side);
  add_probes(stage, rooms_per_side);
  for (int i = 0; i < 16 * rooms_per_side; ++i) add_decal(stage, i, length);
  for (int i = 0; stage.light_count() < lights; ++i) {
    const double side = i % 2 == 0 ? -1.0 : 1.0;
    const Vec3d lamp{side * (k_half_hallway + random.between(1.0, k_depth - 1.0)), k_height - 0.2,
                     -length * (i + 0.5) / lights};
    if (i % 4 < 2)
      stage.point("lamp " + std::to_string(i), lamp, random.between(2.5, 5.0));
    else
      stage.spot("lamp " + std::to_string(i), lamp, {0.0, -1.0, 0.0}, 5.0, random.between(30.0, 60.0));
  }
  stage.camera("walk",
               walk({{0.0, 1.7, 2.0},
                     {0.0, 1.7, -0.45 * length},
                     {6.0, 1.7, -0.45 * length - 1.0},
                     {6.0, 1.7, -0.45 * length + 2.0},
                     {0.0, 1.7, -0.45 * length + 2.0},
                     {0.0, 1.7, -length + 2.0}},
                    15.0),
               200.0);
}

}  // namespace clusterbench::scene
