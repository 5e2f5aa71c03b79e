// Levels are built on lattices: lamps at whole metres, whole ranges, mirrored halves, and a camera that moves along an
// axis or a diagonal. Each light here just touches one of the two planes through the camera's middle, their common
// line, or a point on it at a whole depth, where slices may meet. So whether it reaches the cells there is a tie.

#include <array>
#include <cmath>

#include "scene/generators/scenes.h"

namespace clusterbench::scene {
namespace {

int whole(SplitMix64& random, int least, int most) {
  return least + static_cast<int>(random.below(static_cast<std::uint64_t>(most - least) + 1));
}

// Beside the plane x = 0 or y = 0, beside both, or beyond a corner, with a range that just reaches it.
struct Lamp {
  Vec3d position, towards;
  double range_m;
};

Lamp beside_plane(SplitMix64& random) {
  const int axis = whole(random, 0, 1);
  Lamp lamp{};
  lamp.position[axis] = whole(random, 1, 6);
  lamp.position[1 - axis] = whole(random, -12, 12);
  lamp.position.z = -whole(random, 2, 60);
  lamp.towards[axis] = -1.0;
  lamp.range_m = lamp.position[axis];
  return lamp;
}

// From Pythagorean triples, so that the range is whole, too.
Lamp beside_edge(SplitMix64& random) {
  constexpr std::array<std::array<int, 3>, 3> k_triples{{{3, 4, 5}, {6, 8, 10}, {5, 12, 13}}};
  const auto& triple = k_triples[random.below(k_triples.size())];
  const bool swapped = random.below(2) == 0;
  Lamp lamp{};
  lamp.position = {triple[swapped ? 1 : 0], triple[swapped ? 0 : 1], -whole(random, 2, 60)};
  lamp.towards = {-lamp.position.x, -lamp.position.y, 0.0};
  lamp.range_m = triple[2];
  return lamp;
}

// From four whole numbers with a² + b² + c² = d²: just reaches the corner at (0, 0, -depth), from behind it.
Lamp beside_corner(SplitMix64& random) {
  constexpr std::array<std::array<int, 4>, 4> k_quadruples{{{1, 2, 2, 3}, {2, 3, 6, 7}, {4, 4, 7, 9}, {2, 6, 9, 11}}};
  const auto& quadruple = k_quadruples[random.below(k_quadruples.size())];
  const int depth = 4 * whole(random, 1, 12);
  Lamp lamp{};
  lamp.position = {quadruple[0], quadruple[1], -(depth + quadruple[2])};
  lamp.towards = {-quadruple[0], -quadruple[1], quadruple[2]};
  lamp.range_m = quadruple[3];
  return lamp;
}

Vec3d mirrored(Vec3d v, int side) {
  if (side & 1) v.x = -v.x;
  if (side & 2) v.y = -v.y;
  return v;
}

}  // namespace

void build_lattice(Stage& stage, int lights, const Vec3d& off) {
  SplitMix64& random = stage.random();
  constexpr std::array<double, 3> k_angles_deg{30.0, 45.0, 60.0};
  for (int i = 0; stage.light_count() < lights; ++i) {
    const std::uint64_t way = random.below(16);
    const Lamp lamp = way == 0 ? beside_corner(random) : way < 3 ? beside_edge(random) : beside_plane(random);
    const bool is_spot = i % 5 == 4;
    const double angle_deg = k_angles_deg[random.below(k_angles_deg.size())];
    for (int side = 0; side < 4 && stage.light_count() < lights; ++side) {
      const std::string name = std::to_string(i) + " of side " + std::to_string(side);
      const Vec3d position = mirrored(lamp.position, side) + off;
      if (is_spot)
        stage.spot("spot " + name, position, mirrored(lamp.towards, side), lamp.range_m, angle_deg);
      else
        stage.point("lamp " + name, position, lamp.range_m);
    }
  }
  constexpr double k_eighth_turn = 0.78539816339744831;
  stage.camera("walk",
               {{0.0, {0.0, 0.0, 0.0}, 0.0},
                {6.0, {0.0, 0.0, -12.0}, 0.0},
                {7.0, {0.0, 0.0, -12.0}, k_eighth_turn},
                {12.0, {-8.0, 0.0, -20.0}, k_eighth_turn}},
               400.0);
}

}  // namespace clusterbench::scene
