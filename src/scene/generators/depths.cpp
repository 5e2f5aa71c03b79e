// Depths that are hard for lists of tiles: jumps between near and far surfaces, surfaces at grazing angles, and both.
// Persson's bad cases are vegetation, hallways and ground at grazing angles.

#include <cmath>

#include "scene/generators/scenes.h"

namespace clusterbench::scene {
namespace {

constexpr double k_two_pi = 6.28318530717958647692;

// Triangles of a hand's size anywhere in a box, at any angle about the vertical.
void add_leaves(Stage& stage, std::vector<Vec3d>& corners, const Vec3d& lo, const Vec3d& hi, int count) {
  for (int i = 0; i < count; ++i) {
    const Vec3d middle = stage.position_in(lo, hi);
    const double turn = stage.random().between(0.0, k_two_pi), size_m = stage.random().between(0.1, 0.25);
    const Vec3d along{size_m * std::cos(turn), 0.0, size_m * std::sin(turn)};
    corners.insert(corners.end(), {middle - along, middle + along, middle + Vec3d(0.0, 1.5 * size_m, 0.0)});
  }
}

void add_pole(std::vector<Vec3d>& corners, const Vec3d& foot, double width_m, double height_m) {
  add_box(corners, foot - Vec3d(width_m / 2.0, 0.0, width_m / 2.0),
          foot + Vec3d(width_m / 2.0, height_m, width_m / 2.0));
}

// Lights of 2 to 5 m anywhere in a box; every fourth one is a lamp that shines down.
void fill_with_lights(Stage& stage, int lights, const Vec3d& lo, const Vec3d& hi) {
  for (int i = 0; stage.light_count() < lights; ++i) {
    const Vec3d position = stage.position_in(lo, hi);
    const double range_m = stage.random().between(2.0, 5.0);
    if (i % 4 == 3)
      stage.spot("lamp " + std::to_string(i), position, {0.0, -1.0, 0.0}, range_m, 50.0);
    else
      stage.point("light " + std::to_string(i), position, range_m);
  }
}

}  // namespace

void build_steps(Stage& stage, int lights) {
  std::vector<Vec3d> wall, poles, leaves;
  add_quad(wall, {-80.0, -40.0, -60.0}, {160.0, 0.0, 0.0}, {0.0, 80.0, 0.0});
  for (int i = 0; i < 90; ++i)
    add_pole(poles, stage.position_in({-25.0, -20.0, -45.0}, {25.0, -20.0, -4.0}), 0.3, 40.0);
  add_leaves(stage, leaves, {-12.0, -4.0, -20.0}, {12.0, 8.0, -3.0}, 900);
  stage.mesh("wall", wall);
  stage.mesh("poles", poles);
  stage.mesh("leaves", leaves);
  fill_with_lights(stage, lights, {-25.0, -8.0, -60.0}, {25.0, 12.0, -3.0});
  stage.camera("sidestep", walk({{-4.0, 1.7, 6.0}, {-3.0, 1.7, 3.0}, {-2.0, 1.7, 0.0}}, 10.0), 200.0);
}

void build_slope(Stage& stage, int lights) {
  constexpr double k_half_m = 2.0, k_height_m = 3.0, k_hall_m = 60.0;
  std::vector<Vec3d> hallway, ground;
  add_quad(hallway, {-k_half_m, 0.0, 0.0}, {2.0 * k_half_m, 0.0, 0.0}, {0.0, 0.0, -k_hall_m});
  add_quad(hallway, {-k_half_m, k_height_m, -k_hall_m}, {2.0 * k_half_m, 0.0, 0.0}, {0.0, 0.0, k_hall_m});
  add_quad(hallway, {-k_half_m, 0.0, 0.0}, {0.0, 0.0, -k_hall_m}, {0.0, k_height_m, 0.0});
  add_quad(hallway, {k_half_m, 0.0, -k_hall_m}, {0.0, 0.0, k_hall_m}, {0.0, k_height_m, 0.0});
  add_quad(ground, {-400.0, 0.0, -k_hall_m}, {800.0, 0.0, 0.0}, {0.0, 0.0, -400.0});
  stage.mesh("hallway", hallway);
  stage.mesh("ground", ground);
  fill_with_lights(stage, lights, {-k_half_m, 0.2, -250.0}, {k_half_m, k_height_m, 0.0});
  stage.camera("walk", walk({{0.5, 1.7, -1.0}, {0.5, 1.7, -30.0}, {0.5, 1.7, -70.0}}, 10.0), 400.0);
}

void build_mix(Stage& stage, int lights) {
  std::vector<Vec3d> ground, houses, poles, leaves;
  add_quad(ground, {-200.0, 0.0, 20.0}, {400.0, 0.0, 0.0}, {0.0, 0.0, -320.0});
  for (int i = 0; i < 12; ++i) {
    const int house = i / 2;
    const double side = i % 2 == 0 ? 1.0 : -1.0, z = -20.0 * house - 5.0;
    add_box(houses, {side * 15.0 - 6.0, 0.0, z - 16.0}, {side * 15.0 + 6.0, stage.random().between(6.0, 14.0), z});
    add_pole(poles, {side * 7.0, 0.0, z - 18.0}, 0.2, 7.0);
    add_leaves(stage, leaves, {side * 7.0 - 1.5, 3.0, z - 11.0}, {side * 7.0 + 1.5, 6.0, z - 8.0}, 120);
  }
  stage.mesh("ground", ground);
  stage.mesh("houses", houses);
  stage.mesh("poles", poles);
  stage.mesh("leaves", leaves);
  fill_with_lights(stage, lights, {-9.0, 0.3, -150.0}, {9.0, 7.0, 0.0});
  stage.camera("walk", walk({{1.0, 1.7, 5.0}, {1.0, 1.7, -30.0}, {-1.0, 1.7, -60.0}}, 10.0), 300.0);
}

}  // namespace clusterbench::scene
