#pragma once
// How the conservative methods see a light: a ball, and for a spot its cone against the cells' bounding balls. Both are
// padded by what the method's own single-precision steps can lose, and by no more.
//
// A unit roundoff is 2^-24 of the light's reach, |x| + |y| + |z| + r in its space. A method derives how many of them
// its steps can add up to, in the comment above its row; view::k_given_roundoffs come on top.

#include <vector>

#include "assign/contract/assigner.h"
#include "core/arrays.h"
#include "geom/single_precision/touch_tests.h"

namespace clusterbench::assign {

// `spot`: "sphere", "range", "cone-sphere" or "both" (the default).
ParamSpec spot_param();
// `inflation`: the padding in units of the derived one. Below 1 a method is no longer conservative.
ParamSpec inflation_param();
// Both, for most methods.
std::vector<ParamSpec> light_params();

// Throws Error (ExitCode::internal) for spots without the cells' balls: the build was not told of them.
void check_prepared(const view::LightArrays& lights, const std::vector<geom::Ball>& cell_balls);

struct TestedLight {
  std::uint32_t index = 0;
  geom::Ball ball{};           // a point's; a spot's bounding ball or, with range and cone-sphere, that of its range
  bool has_cone = false;       // test the cone, too
  geom::SphericalCone cone{};  // only if has_cone
};

// The tests of one assigner.
class LightTest {
 public:
  // `roundoffs`: what the method's own steps lose.
  LightTest(const Params& params, float roundoffs);

  // Makes the cells' bounding balls where there are spots that are tested with them.
  void start_grid(const grid::Grid& grid, const LightKinds& kinds);
  // check_prepared(), where spots are tested with the balls.
  void start_frame(const view::LightArrays& lights) const;

  // Not for lights that are empty.
  TestedLight tested(const view::LightArrays& lights, std::uint32_t light) const;
  // The same ball as a method with no more than these roundoffs of its own would have it: for steps before the method's
  // test that lose less.
  geom::Ball ball(const view::LightArrays& lights, std::uint32_t light, float roundoffs) const;
  // The cone that the cells' balls are tested with, of a spot.
  geom::SphericalCone cone(const view::LightArrays& lights, std::uint32_t light) const {
    // What the cone's tests lose, they add themselves.
    return lights.cone(light, padding(0.0f));
  }
  // Roundoffs that a method with no more than these of its own pads by.
  float padding(float roundoffs) const { return inflation_ * (view::k_given_roundoffs + roundoffs); }
  float own_padding() const { return padding(roundoffs_); }
  // Whether a spot's ball is the one around its cone, not that of its range.
  bool balls_are_around_cones() const { return spot_ == SpotTest::ball || spot_ == SpotTest::both; }
  // Whether spots are tested by their cones, too, and then the cells' balls, in the order of the cells.
  bool tests_cones() const { return spot_ == SpotTest::cone_sphere || spot_ == SpotTest::both; }
  const std::vector<geom::Ball>& cell_balls() const { return cell_balls_; }
  bool cone_touches(const TestedLight& light, std::uint32_t cell) const {
    return geom::cone_touches_ball(light.cone, cell_balls_[cell]);
  }
  // Adds the cells first_cell .. first_cell + count - 1, of a spot those that its cone may touch. Each cone test adds 1
  // to `tests`.
  void add_row(const TestedLight& light, std::uint32_t first_cell, std::uint32_t count, PairBuffer& pairs,
               std::uint64_t& tests) const;

  std::size_t capacity_bytes() const { return bytes_of(cell_balls_); }

 private:
  enum class SpotTest { ball, range, cone_sphere, both };

  SpotTest spot_;
  float inflation_, roundoffs_;
  std::vector<geom::Ball> cell_balls_;
};

}  // namespace clusterbench::assign
