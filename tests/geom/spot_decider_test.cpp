// The quick proofs about spots against the slow ones, which prove in numbers of 106 bits, 1024 bits and rational ones.

#include "geom/spot/spot_decider.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geom/certificate/exact_axis.h"
#include "geom/filter/light_filter.h"
#include "geom/light_meets_cell.h"
#include "geom/random_pairs.h"
#include "geom/search/gjk.h"
#include "geom/shapes/verdict.h"
#include "geom/spot/proof_by_search.h"

namespace clusterbench::geom {
namespace {

constexpr double k_quarter_turn = std::numbers::pi / 2.0;

struct SpotPair {
  SpotVolume light;
  Cell cell;
};

// What the deciders of balls and geom/spot/proof_by_search.h say.
Verdict slowly(const SpotPair& pair) {
  if (!BallDecider(pair.light.apex, pair.light.range).meets(pair.cell)) return Verdict::no;
  if (BallDecider(pair.light.apex, 0.0).meets(pair.cell)) return Verdict::yes;
  return std::visit([&](const auto& cell) { return decide_spot(pair.light, cell); }, pair.cell);
}

// How many the filter left uncertain.
template <class Make>
int expect_agreement(int pairs, Make&& make) {
  int uncertain = 0;
  for (int i = 0; i < pairs; ++i) {
    const SpotPair pair = make(static_cast<std::size_t>(i % 3));
    const SpotDecider decider(pair.light);
    const Verdict quick = decider.meets_quickly(pair.cell), decided = prove_meets(pair.light, pair.cell);
    EXPECT_EQ(decider.meets(pair.cell), decided) << "pair " << i;
    Verdict expected = filter_meets(pair.light, pair.cell);
    if (expected == Verdict::uncertain) {
      ++uncertain;
      expected = slowly(pair);
    }
    EXPECT_EQ(decided, expected) << "pair " << i;
    EXPECT_TRUE(quick == Verdict::uncertain || quick == expected) << "pair " << i;
  }
  return uncertain;
}

double by_ulps(double value, int ulps) {
  for (int i = 0; i < std::abs(ulps); ++i) value = std::nextafter(value, ulps < 0 ? -1e300 : 1e300);
  return value;
}

int whole(SplitMix64& random, int least, int most) {
  return least + static_cast<int>(random.below(static_cast<std::uint64_t>(most - least) + 1));
}

Vec3d whole_vector(SplitMix64& random, int most) {
  return {whole(random, -most, most), whole(random, -most, most), whole(random, -most, most)};
}

// Whole coordinates and ranges, along axes and diagonals.
SpotPair lattice_pair(SplitMix64& random, std::size_t kind) {
  constexpr std::array<double, 7> k_parts{1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0, 0.25, 0.0, 1e-60};
  SpotPair pair;
  pair.light.apex.position = whole_vector(random, 8);
  pair.light.range = whole(random, 1, 12);
  do pair.light.direction = whole_vector(random, 1);
  while (pair.light.direction == Vec3d(0.0));
  pair.light.half_angle_rad = k_parts[random.below(k_parts.size())] * k_quarter_turn;
  const auto quarters = [&](int least, int most) { return 0.25f * static_cast<float>(whole(random, least, most)); };
  const float x = quarters(-4, 3), y = quarters(-4, 3), near = 4.0f * quarters(0, 6),
              far = near + 4.0f * quarters(1, 6);
  const float x1 = x + quarters(1, 4), y1 = y + quarters(1, 4);
  if (kind == 0) pair.cell = FrustumCell{x, x1, y, y1, near, far, false};
  if (kind == 1) pair.cell = ShellCell{x, x1, y, y1, near, far};
  if (kind == 2) pair.cell = Box{{4 * x, 4 * y, -far}, {4 * x1, 4 * y1, -near}};
  return pair;
}

SpotPair random_pair(SplitMix64& random, std::size_t kind) {
  SpotPair pair{random_spot(random), Cell()};
  if (kind == 0) pair.cell = random_piece(random);
  if (kind == 1) pair.cell = random_shell(random);
  if (kind == 2) pair.cell = random_box(random);
  return pair;
}

void turn(SpotVolume& light, double angle) {
  light.apex.rotation[0][0] = light.apex.rotation[2][2] = std::cos(angle);
  light.apex.rotation[2][0] = std::sin(angle);
  light.apex.rotation[0][2] = -std::sin(angle);
}

// Where the answer changes with `value`, which is part of the pair's light.
void nudge_to_touch(SpotPair& pair, double& value, double most, SplitMix64& random) {
  const double given = value;
  double apart = 0.0, touching = most;
  for (;;) {
    value = 0.5 * (apart + touching);
    if (value <= apart || value >= touching) break;
    (SpotDecider(pair.light).meets(pair.cell) == Verdict::no ? apart : touching) = value;
  }
  value = touching < most ? by_ulps(touching, whole(random, -4, 4)) : given;
}

TEST(SpotDecider, says_what_slow_proofs_say_on_lattices) {
  SplitMix64 random(41);
  EXPECT_GT(expect_agreement(6000, [&](std::size_t kind) { return lattice_pair(random, kind); }), 60);
}

TEST(SpotDecider, says_what_slow_proofs_say_beside_lattices) {
  SplitMix64 random(43);
  const auto make = [&](std::size_t kind) {
    SpotPair pair = lattice_pair(random, kind);
    switch (random.below(4)) {
      case 0:
        pair.light.range = by_ulps(pair.light.range, whole(random, -2, 2));
        break;
      case 1:
        pair.light.half_angle_rad = std::max(0.0, by_ulps(pair.light.half_angle_rad, whole(random, -2, 2)));
        break;
      case 2:
        pair.light.apex.position += 0x1p-45 * Vec3d(random.unit(), random.unit(), random.unit());
        break;
      default:
        turn(pair.light, 0.5 * k_quarter_turn);
    }
    return pair;
  };
  EXPECT_GT(expect_agreement(6000, make), 50);
}

TEST(SpotDecider, says_what_slow_proofs_say_within_ulps_of_touching) {
  SplitMix64 random(47);
  const auto make = [&](std::size_t kind) {
    SpotPair pair = random_pair(random, kind);
    if (random.below(2) == 0) turn(pair.light, random.between(0.0, 6.0));
    if (random.below(2) == 0)
      nudge_to_touch(pair, pair.light.range, 200.0, random);
    else
      nudge_to_touch(pair, pair.light.half_angle_rad, 1.57, random);
    return pair;
  };
  EXPECT_GT(expect_agreement(900, make), 60);
}

TEST(SpotDecider, says_what_slow_proofs_say_far_from_the_eye) {
  SplitMix64 random(53);
  const auto make = [&](std::size_t kind) {
    Slopes s = random_slopes(random);
    s.near = static_cast<float>(random.between(500.0, 5000.0));
    s.far = s.near * 1.1f;
    const bool is_shell = kind == 1;
    const Contact contact = random_contact(s, is_shell, random);
    SpotPair pair;
    pair.light.range = random.between(0.01, 2.0);
    pair.light.apex.origin = {1e4, 100.0, -3e3};
    pair.light.apex.position = contact.place + pair.light.range * contact.outward + pair.light.apex.origin;
    pair.light.direction = random.below(2) == 0 ? -contact.outward : random_direction(random) - contact.outward;
    pair.light.half_angle_rad = random.between(0.001, 1.57);
    if (is_shell)
      pair.cell = ShellCell{s.x0, s.x1, s.y0, s.y1, s.near, s.far};
    else if (kind == 0)
      pair.cell = FrustumCell{s.x0, s.x1, s.y0, s.y1, s.near, s.far, false};
    else
      pair.cell = Box{Vec3f(contact.place) - 1.0f, Vec3f(contact.place)};
    return pair;
  };
  EXPECT_GT(expect_agreement(900, make), 300);
}

// The half-space in front of a spot of 90° begins at its apex; its edges' ends are out of range.
TEST(SpotDecider, of_90_degrees_reaches_a_face_that_is_an_ulp_in_front_of_its_apex) {
  SpotVolume light;
  light.range = 3.0;
  light.direction = {1, 0, 0};
  light.half_angle_rad = k_quarter_turn;
  const Box box{{0, -10, -30}, {1, 10, -1}};
  for (const double x : {1.0, by_ulps(1.0, 1), 2.0}) {
    light.apex.position = {x, 0, 0};
    EXPECT_EQ(SpotDecider(light).meets(box), Verdict::no) << x;
  }
  for (const double x : {by_ulps(1.0, -1), 0.999}) {
    light.apex.position = {x, 0, 0};
    EXPECT_EQ(SpotDecider(light).meets(box), Verdict::yes) << x;
  }
}

// Of the plane through a centre: cells that touch it from its front.
TEST(BallDecider, tells_whether_a_cell_is_in_front_of_a_plane_through_the_centre) {
  struct Touch {
    Cell cell;
    Vec3d center;
    Point3<double> normal;
    int axis, back;  // where the cell sticks out
  };
  const std::array<Touch, 6> touches{
      Touch{Box{{1, 2, -5}, {3, 4, -3}}, {7, -1, -8}, {1, 1, 1}, 0, 1},
      Touch{FrustumCell{0.25f, 0.5f, -1.0f, 2.0f, 4.0f, 8.0f, false}, {1, 9, -7}, {1, 0, 0}, 0, 1},
      // With the far shell: a corner, an edge and the middle. With the near shell: a corner.
      Touch{ShellCell{0.5f, 1.0f, -0.5f, 0.0f, 1.0f, 3.0f}, {1, -2, -1}, {-1, 1, 0}, 0, -1},
      Touch{ShellCell{0.0f, 0.75f, -1.0f, 1.0f, 1.0f, 5.0f}, {3, 7, -4}, {-3, 0, 4}, 0, -1},
      Touch{ShellCell{0.25f, 0.75f, 0.5f, 1.0f, 1.0f, 7.0f}, {-2.5, 6, -6}, {-2, -3, 6}, 1, -1},
      Touch{ShellCell{0.0f, 0.5f, -1.0f, -0.5f, 3.0f, 7.0f}, {4, 1, -5}, {-1, 0, -1}, 0, -1}};
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const Touch& touch = touches[i];
    const auto is_in_front = [&](int ulps) {
      Placement center;
      center.position = touch.center;
      center.position[touch.axis] = by_ulps(center.position[touch.axis], ulps);
      return std::visit([&](const auto& cell) { return BallDecider(center, 1.0).has_in_front(touch.normal, cell); },
                        touch.cell);
    };
    EXPECT_TRUE(is_in_front(0)) << i;
    EXPECT_TRUE(is_in_front(-touch.back)) << i;
    EXPECT_FALSE(is_in_front(touch.back)) << i;
  }
}

// Ties of the scenes/lattice kind: decided before anything exact is needed, an ulp from touching included.
TEST(SpotDecider, decides_spots_that_shine_straight_at_a_plane_they_just_reach_in_doubles) {
  SplitMix64 random(59);
  for (int i = 0; i < 300; ++i) {
    SpotPair pair = lattice_pair(random, 0);
    const int range = whole(random, 1, 6);
    const float near = static_cast<float>(whole(random, 1, 20));
    // From the left, at the plane x = 0.
    pair.light.apex.position = {-range, 0.125 * (near + 2.0), -(near + 2.0)};
    pair.light.range = range;
    pair.light.direction = {1, 0, 0};
    pair.light.half_angle_rad = k_quarter_turn / whole(random, 1, 3);
    const std::array<Cell, 3> cells{FrustumCell{0.0f, 0.25f, 0.0f, 0.25f, near, near + 4.0f, false},
                                    ShellCell{0.0f, 0.25f, 0.0f, 0.25f, near, near + 8.0f},
                                    Box{{0.0f, 0.0f, -near - 4.0f}, {2.0f, near, -near}}};
    for (const Cell& cell : cells) {
      const SpotDecider decider(pair.light);
      EXPECT_EQ(decider.meets_quickly(cell), Verdict::yes);
      EXPECT_EQ(decider.exact_decisions(), 0u);
      SpotVolume shorter = pair.light;
      shorter.range = by_ulps(shorter.range, -1);
      EXPECT_EQ(SpotDecider(shorter).meets_quickly(cell), Verdict::no);
    }
  }
}

TEST(SpotDecider, of_endless_range_is_decided) {
  SpotVolume light;
  light.range = std::numeric_limits<double>::infinity();
  light.apex.position = {-4, 0.5, -6};
  light.direction = {1, 0, 0};
  light.half_angle_rad = 0.5;
  const FrustumCell cell{0.0f, 0.25f, 0.0f, 0.25f, 4.0f, 8.0f, false};
  EXPECT_EQ(SpotDecider(light).meets(cell), Verdict::yes);
  light.direction = {-1, 0, 0};
  EXPECT_EQ(SpotDecider(light).meets(cell), Verdict::no);
  light.direction = {0, 1, 0};
  light.half_angle_rad = k_quarter_turn;  // all of x >= ... of the plane y = 0.5 upwards
  EXPECT_EQ(SpotDecider(light).meets(cell), Verdict::yes);
  light.apex.position.y = 3.0;
  EXPECT_EQ(SpotDecider(light).meets(cell), Verdict::no);
}

TEST(ExactAxis, meets_what_its_ends_just_touch) {
  SpotVolume light;
  light.apex.position = {1, 0.25, 0};
  light.direction = {0, 0, -3};
  const Box box{{1, -1, -9}, {3, 1, -5}};  // its face x = 1 holds the axis
  light.range = 5.0;
  EXPECT_TRUE(axis_meets(light, box).value());
  light.range = by_ulps(5.0, -1);
  EXPECT_FALSE(axis_meets(light, box).value());
  light.range = 5.0;
  light.apex.position.x = by_ulps(1.0, -1);
  EXPECT_FALSE(axis_meets(light, box).value());
  const FrustumCell cell{0.125f, 1.0f, -1.0f, 1.0f, 4.0f, 8.0f, false};
  light.apex.position = {1, 0.25, 0};
  light.range = 8.0;  // x = depth / 8 only at depth 8, where the axis leaves the tile
  EXPECT_TRUE(axis_meets(light, cell).value());
  const ShellCell shell{0.0f, 1.0f, 0.0f, 1.0f, 9.0f, 12.0f};
  light.apex.position = {4, 4, 0};
  light.range = 7.0;  // to (4, 4, -7), which is 9 from the eye
  EXPECT_TRUE(axis_meets(light, shell).value());
  light.range = by_ulps(7.0, -1);
  EXPECT_FALSE(axis_meets(light, shell).value());
}

TEST(Gjk, finds_the_direction_between_two_boxes) {
  const auto least_of_box = [](const Vec3d& lo, const Vec3d& hi, const Point3<double>& n) {
    return Point3<double>{n.x > 0 ? lo.x : hi.x, n.y > 0 ? lo.y : hi.y, n.z > 0 ? lo.z : hi.z};
  };
  Point3<double> last{0, 0, 0};
  int tries = 0;
  try_separating_directions(
      {1, 5, -2},
      [&](const Point3<double>& n) {
        return least_of_box({3, 4, -1}, {5, 6, 1}, n) -
               least_of_box({-1, -1, -1}, {1, 1, 1}, Point3<double>{-n.x, -n.y, -n.z});
      },
      [&](const Point3<double>& n) {
        last = n;
        return ++tries > 12;
      });
  // From (1, 1, z) to (3, 4, z).
  EXPECT_NEAR(last.x * 3.0, last.y * 2.0, 1e-12);
  EXPECT_NEAR(last.z, 0.0, 1e-12);
}

}  // namespace
}  // namespace clusterbench::geom
