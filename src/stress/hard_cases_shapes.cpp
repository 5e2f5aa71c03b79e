// H19 to H22, H27, H28, H30, H32: nodes, spots, splinter cells, outliers, coplanar faces, published losses.

#include <cmath>

#include "core/random.h"
#include "scene/scene.h"
#include "stress/hard_cases.h"

namespace clusterbench::stress {
namespace {

using grid::Scheme;

// Lights under scaled and mirrored nodes keep their range.
Rig scaled_rig() {
  Rig rig;
  const int large = rig.node({.name = "large", .scale = {3, 3, 3}});
  const int uneven = rig.node({.name = "uneven", .parent = large, .translation = {1, 0, -4}, .scale = {0.1, 5, 1}});
  const int mirrored = rig.node({.name = "mirrored", .translation = {0, 1, -20}, .scale = {-1, 1, 1}});
  for (const int parent : {large, uneven, mirrored})
    for (int i = 0; i < 20; ++i) rig.point({0.7 * i - 6, 0.2 * i - 2, -0.9 * i}, 0.4 + 0.3 * i, parent);
  return rig;
}

std::vector<Trial> under_nodes(std::uint64_t) {
  std::vector<Trial> trials;
  scaled_rig().on_each(grids_of_every_kind(), "scaled and mirrored nodes", trials);
  return trials;
}

std::vector<ToolCheck> ranges_stay(std::uint64_t) {
  const Trial trial = scaled_rig().on(pixel_grid({64, 64}));
  bool same = true;
  for (const scene::WorldLight& light : frame_of(trial).lights)
    same = same && light.range_m == trial.scene.lights[static_cast<std::size_t>(light.rig_index)].range_m;
  return {{"a node's scale does not scale a light's range", same, ""}};
}

std::vector<Trial> cone_angles(std::uint64_t seed) {
  std::vector<Trial> trials;
  for (const double degrees : {0.001, 0.01, 0.05, 0.5, 44.9999, 45.0, 45.0001, 89.9, 90.0}) {
    SplitMix64 random(seed);
    Rig rig;
    for (int i = 0; i < 80; ++i) {
      const double x = random.between(-20, 20), y = random.between(-10, 10), z = random.between(-60, 5);
      const double yaw = random.between(0, 6.2831853), up = random.between(-1, 1);
      const double range = std::exp(random.between(std::log(0.5), std::log(1000.0)));
      rig.spot({x, y, z}, {std::cos(yaw), up, std::sin(yaw)}, range, degrees * k_degree);
    }
    rig.spot({-9e4, 0.3, -50}, {1, 0, 0}, 1e5, degrees * k_degree);
    rig.on_each(grids_of_every_kind(), std::to_string(degrees) + " degrees", trials);
  }
  return trials;
}

std::vector<Trial> cone_axes(std::uint64_t) {
  std::vector<Trial> trials;
  Rig rig;
  for (const double degrees : {5.0, 30.0, 60.0, 89.0})
    for (const Vec3d& axis : {Vec3d(1, 0, 0), Vec3d(-1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, -1, 0), Vec3d(0, 0, 1),
                              Vec3d(0, 0, -1), Vec3d(1, 1, 0), Vec3d(0, 1, -1)})
      for (const Vec3d& position : {Vec3d(0, 0, -10), Vec3d(3, -2, -25), Vec3d(-8, 4, -6)})
        rig.spot(position, axis, 12.0, degrees * k_degree);
  rig.on_each(grids_of_every_kind(), "axes along the axes", trials);
  return trials;
}

std::vector<Trial> cone_apexes(std::uint64_t) {
  std::vector<Trial> trials;
  const Trial empty = Rig().on(frustum_grid({12, 12}, Scheme::exponential, 24, 0.1, 400.0));
  const grid::ScreenGrid screen = grid_of(empty, frame_of(empty)).screen();
  Rig rig;
  for (const Vec3d& axis : {Vec3d(0, 0, -1), Vec3d(0, 0, 1), Vec3d(1, 0.2, -0.3), Vec3d(-0.5, -1, 0.1)})
    for (const double degrees : {3.0, 40.0, 85.0}) {
      rig.spot({0, 0, 0}, axis, 20, degrees * k_degree).spot({0.02, 0, -0.1}, axis, 30, degrees * k_degree);
      rig.spot({0, 0, 2}, axis, 25, degrees * k_degree);
      for (const std::size_t k : {3u, 12u, 20u}) {
        const double depth = screen.slices.boundaries[k];
        rig.spot({screen.tiles.x[k / 2] * depth, screen.tiles.y[k / 3] * depth, -depth}, axis, 8, degrees * k_degree);
      }
    }
  rig.on_each(grids_of_every_kind(), "apexes on near, corners, the eye", trials);
  return trials;
}

std::vector<Trial> splinters(std::uint64_t seed) {
  std::vector<Trial> trials;
  SplitMix64 random(seed);
  Rig rig;
  for (int i = 0; i < 120; ++i) {
    const double depth = random.between(0.5, 80), x = random.between(-1, 1), y = random.between(-0.6, 0.6);
    const double range = random.between(0.1, 10);
    rig.point({x * depth, y * depth, -depth}, range);
    if (i % 4 == 3) rig.spot({x * depth, -y * depth, -depth}, {y, -1, x}, range, 0.1 + 0.01 * i);
  }
  trials.push_back(rig.on(frustum_grid({1, 90}, Scheme::exponential, 24, 0.1, 400), "1 x 90 tiles"));
  trials.push_back(rig.on(frustum_grid({160, 1}, Scheme::exponential, 24, 0.1, 400), "160 x 1 tiles"));
  trials.push_back(rig.on(frustum_grid({120, 68}, Scheme::linear, 1, 0.1, 400), "one slice"));
  trials.push_back(rig.on(frustum_grid({1, 1}, Scheme::exponential, 200, 0.1, 400), "one tile"));
  trials.push_back(rig.on(frustum_grid({1, 1}, Scheme::linear, 1, 0.1, 400), "one cell"));
  grid::GridSpec shells = frustum_grid({2, 40}, Scheme::linear, 100, 0.1, 100);
  shells.kind = grid::Kind::distance;
  trials.push_back(rig.on(shells, "thin shells"));
  return trials;
}

std::vector<Trial> one_outlier(std::uint64_t) {
  std::vector<Trial> trials;
  Rig rig;
  rig.point({1e6, 20, -3e5}, 25).point({0, 900, -2000}, 1e5);
  for (int i = 0; i < 60; ++i) rig.point({i - 30.0, 0.1 * i, -20.0 - 0.5 * i}, 2.0 + 0.1 * i);
  rig.on_each(grids_of_every_kind(), "a light at 1,000 km", trials);
  return trials;
}

// Centres exactly in tile planes, on the edge lines through the eye, and in slice planes.
std::vector<Trial> coplanar(std::uint64_t) {
  std::vector<Trial> trials;
  for (const grid::GridSpec& spec :
       {frustum_grid({12, 12}, Scheme::exponential, 24, 0.1, 400), pixel_grid({128, 128})}) {
    const Trial empty = Rig().on(spec);
    const grid::ScreenGrid screen = grid_of(empty, frame_of(empty)).screen();
    Rig rig;
    for (std::size_t k = 1; k < screen.slices.boundaries.size(); k += 3) {
      const double depth = screen.slices.boundaries[k], between = 0.7 * depth;
      const double sx = screen.tiles.x[k % screen.tiles.x.size()], sy = screen.tiles.y[k % screen.tiles.y.size()];
      rig.point({sx * depth, 0.013 * depth, -depth}, 0.2 * depth).point({sx * between, sy * between, -between}, 0.3);
      rig.point({sx * depth, sy * depth, -depth}, 1e-3 * depth).point({0.0, sy * between, -between}, 2.0);
    }
    rig.on_each({spec}, "centres in planes", trials);
    grid::GridSpec distance = spec;
    distance.kind = grid::Kind::distance;
    trials.push_back(rig.on(distance, "centres in planes"));
  }
  return trials;
}

// Lights that shipped engines lose.
std::vector<Trial> published_losses(std::uint64_t) {
  std::vector<Trial> trials;
  const grid::GridSpec filament = frustum_grid({12, 12}, Scheme::exponential_first, 24, 0.1, 400, 0.141282);
  trials.push_back(Rig().point({-16.7833176, 14.3895569, -103.066628}, 3).on(filament, "a fast logarithm"));
  trials.push_back(Rig()
                       .point({24.3343582, -12.6534967, -24.6891174}, 13)
                       .on(frustum_grid({12, 12}, Scheme::exponential, 24, 0.1, 400), "a centre row kept"));
  trials.push_back(Rig()
                       .spot({32.4449654, -17.4399338, -90.1848755}, {.131388, -.724634, .676493}, 29.1207905, .0865885)
                       .on(frustum_grid({61, 50}, Scheme::exponential_first, 16, 0.1, 500), "a tile size rounded up"));
  return trials;
}

}  // namespace

std::vector<HardCase> shape_cases() {
  return {{"H19", "lights under scaled, unevenly scaled and mirrored nodes", under_nodes, ranges_stay},
          {"H20", "spot half-angles from 0.001 to 90 degrees", cone_angles, nullptr},
          {"H21", "spot axes along the view's axes", cone_axes, nullptr},
          {"H22", "spot apexes on near, on tile corners, at the eye", cone_apexes, nullptr},
          {"H27", "splinter cells, one slice, one tile, one cell", splinters, nullptr},
          {"H28", "one light at 1,000 km", one_outlier, nullptr},
          {"H30", "centres in tile planes and on edges through the eye", coplanar, nullptr},
          {"H32", "lights that shipped engines lose", published_losses, nullptr}};
}

}  // namespace clusterbench::stress
