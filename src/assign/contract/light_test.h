#pragma once
// How conservative methods represent a light: as a ball, and a spot also as a cone that is tested against the cells'
// bounding balls. Both are padded by the error of the method's own single-precision steps, and by no more.
//
// A unit roundoff is 2^-24 of the light's reach, |x| + |y| + |z| + r in its space. Each method derives the sum of its
// steps' roundoffs in the comment above its constant; view::k_given_roundoffs are added.

#include <vector>

#include "assign/contract/assigner.h"
#include "core/arrays.h"
#include "geom/single_precision/touch_tests.h"

namespace clusterbench::assign {

// `spot`: "sphere", "range", "cone-sphere" or "both" (the default).
ParamSpec spot_param();
// `inflation`: the padding in units of the derived one. Below 1 a method is no longer conservative.
ParamSpec inflation_param();
// Both parameters, for most methods.
std::vector<ParamSpec> light_params();

// Throws Error (ExitCode::internal) if there are spots but no balls around cells: the build did not know of the spots.
void check_prepared(const view::LightArrays& lights, const std::vector<geom::Ball>& cell_balls);

struct TestedLight {
  std::uint32_t index = 0;
  geom::Ball ball{};  // of a point; for a spot its bounding ball or, with range and cone-sphere, the ball of its range
  bool has_cone = false;       // the cone has to be tested, too
  geom::SphericalCone cone{};  // only if has_cone
};

// The light tests of one assigner.
class LightTest {
 public:
  // `roundoffs`: the error of the method's own steps.
  LightTest(const Params& params, float roundoffs);

  // Computes the cells' bounding balls if there are spots to be tested with them.
  void start_grid(const grid::Grid& grid, const LightKinds& kinds);
  // check_prepared(), if spots are tested with the balls.
  void start_frame(const view::LightArrays& lights) const;

  // Not for empty lights.
  TestedLight tested(const view::LightArrays& lights, std::uint32_t light) const;
  // The same ball, padded as for a method with only these roundoffs of its own: for earlier steps with smaller errors.
  geom::Ball ball(const view::LightArrays& lights, std::uint32_t light, float roundoffs) const;
  // A spot's cone, to be tested against the cells' balls.
  geom::SphericalCone cone(const view::LightArrays& lights, std::uint32_t light) const {
    // The cone's tests add their own roundoffs.
    return lights.cone(light, padding(0.0f));
  }
  // The padding, in roundoffs, of a method with these roundoffs of its own.
  float padding(float roundoffs) const { return inflation_ * (view::k_given_roundoffs + roundoffs); }
  float own_padding() const { return padding(roundoffs_); }
  // Is a spot's ball the one around its cone, and not that of its range?
  bool balls_are_around_cones() const { return spot_ == SpotTest::ball || spot_ == SpotTest::both; }
  // Are spots also tested by their cones? And the cells' balls for that, in the order of the cells.
  bool tests_cones() const { return spot_ == SpotTest::cone_sphere || spot_ == SpotTest::both; }
  const std::vector<geom::Ball>& cell_balls() const { return cell_balls_; }
  bool cone_touches(const TestedLight& light, std::uint32_t cell) const {
    return geom::cone_touches_ball(light.cone, cell_balls_[cell]);
  }
  // Adds the cells first_cell .. first_cell + count - 1; for a spot only those that its cone may touch. Each cone test
  // adds 1 to `tests`.
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
