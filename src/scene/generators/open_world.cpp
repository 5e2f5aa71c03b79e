// Persson's setting: hundreds of artist-placed lights of metres to tens of metres over 500 m of open world, seen from
// the ground: lit roads, villages, a petrol station, floodlights, cars with moving headlights.

#include <cmath>

#include "scene/generators/scenes.h"

namespace clusterbench::scene {
namespace {

const Vec3d k_down{0.0, -1.0, 0.0};

// The main road winds from north to south; x by z.
double road_x(double z) {
  return 25.0 * std::round(z / 60.0) - z * 0.25;
}

void light_roads(Stage& stage) {
  for (int i = 0; i < 60; ++i) {
    const double z = -250.0 + 500.0 * i / 59.0, side = i % 2 == 0 ? 5.0 : -5.0;
    const Vec3d lamp{road_x(z) + side, 7.0, z};
    if (i % 3 == 0)
      stage.point("road lamp " + std::to_string(i), lamp, 14.0);
    else
      stage.spot("road lamp " + std::to_string(i), lamp, k_down, 18.0, 62.0);
  }
  for (int i = 0; i < 30; ++i)
    stage.spot("cross road lamp " + std::to_string(i), {-240.0 + 16.0 * i, 6.5, 30.0 + (i % 2) * 9.0}, k_down, 16.0,
               60.0);
}

void fill_petrol_station(Stage& stage, const Vec3d& at) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      stage.spot("canopy " + std::to_string(4 * row + column), at + Vec3d(4.0 * column, 5.5, 4.0 * row), k_down, 12.0,
                 70.0);
  for (int i = 0; i < 8; ++i) stage.point("shop " + std::to_string(i), at + Vec3d(-6.0, 2.2, 1.5 * i), 5.0);
  stage.point("price sign", at + Vec3d(14.0, 8.0, -3.0), 20.0);
}

void fill_village(Stage& stage, const std::string& name, const Vec3d& at, int houses) {
  for (int house = 0; house < houses; ++house) {
    const Vec3d home = at + stage.position_in({-35.0, 0.0, -35.0}, {35.0, 0.0, 35.0});
    const std::string part = name + " house " + std::to_string(house);
    const double door_m = stage.random().between(4.0, 7.0), window_m = stage.random().between(2.0, 5.0);
    stage.point(part + " door", home + Vec3d(0.0, 2.4, 3.2), door_m);
    stage.point(part + " window", home + Vec3d(2.5, 1.8, 0.0), window_m);
    const double yard_m = stage.random().between(9.0, 16.0), yard_deg = stage.random().between(25.0, 55.0);
    if (house % 3 == 0) stage.spot(part + " yard", home + Vec3d(0.0, 4.0, 3.0), {0.1, -1.0, 0.6}, yard_m, yard_deg);
  }
  stage.point(name + " square", at + Vec3d(0.0, 6.0, 0.0), 26.0);
  stage.point(name + " fire", at + Vec3d(8.0, 0.6, -6.0), 9.0);
}

void place_floodlights(Stage& stage) {
  for (int mast = 0; mast < 6; ++mast) {
    const Vec3d top{-160.0 + 25.0 * mast, 18.0, -150.0};
    for (int lamp = 0; lamp < 4; ++lamp)
      stage.spot("flood " + std::to_string(mast) + "." + std::to_string(lamp), top + Vec3d(0.8 * lamp, 0.0, 0.0),
                 {0.3 * lamp - 0.45, -0.8, 0.9}, 48.0, 38.0);
  }
  for (int lamp = 0; lamp < 3; ++lamp)
    stage.spot("search " + std::to_string(lamp), {120.0 + 20.0 * lamp, 12.0, 140.0}, {0.2 * lamp - 0.2, 0.5, -1.0},
               70.0, 2.0);
}

void drive_cars(Stage& stage, int cars) {
  for (int i = 0; i < cars; ++i) {
    const bool goes_north = i % 2 == 0;
    const double start = stage.random().between(-230.0, 130.0), length = stage.random().between(60.0, 100.0);
    std::vector<Vec3d> corners;
    for (int step = 0; step <= 4; ++step) {
      const double z = start + length * (goes_north ? 4 - step : step) / 4.0;
      corners.push_back({road_x(z) + (goes_north ? 1.8 : -1.8), 0.7, z});
    }
    const int car = stage.mover("car " + std::to_string(i), walk(corners, 18.0));
    const std::string name = "car " + std::to_string(i);
    for (const double side : {-0.7, 0.7}) {
      stage.spot(name + " headlight", {side, 0.0, -2.0}, {0.0, -0.06, -1.0}, 38.0, 14.0, car);
      stage.point(name + " tail light", {side, 0.1, 2.0}, 2.0, car);
    }
  }
}

}  // namespace

void build_open_world(Stage& stage, int lights) {
  light_roads(stage);
  fill_petrol_station(stage, {road_x(80.0) + 18.0, 0.0, 80.0});
  fill_village(stage, "north", {road_x(-180.0) + 45.0, 0.0, -180.0}, 40);
  fill_village(stage, "east", {150.0, 0.0, 20.0}, 36);
  fill_village(stage, "south", {road_x(190.0) - 50.0, 0.0, 190.0}, 40);
  place_floodlights(stage);
  drive_cars(stage, 24);
  for (int i = 0; stage.light_count() < lights; ++i) {
    const Vec3d position = stage.position_in({-240.0, 1.0, -240.0}, {240.0, 3.0, 240.0});
    stage.point("lantern " + std::to_string(i), position, stage.random().between(3.0, 12.0));
  }

  constexpr double k_eye = 1.7;
  std::vector<Vec3d> corners;
  for (int i = 0; i <= 12; ++i) {
    const double z = 230.0 - 38.0 * i;
    corners.push_back({road_x(z), k_eye, z});
  }
  stage.camera("drive", walk(corners, 20.0), 500.0);
}

}  // namespace clusterbench::scene
