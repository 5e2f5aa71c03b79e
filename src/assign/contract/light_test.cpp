#include "assign/contract/light_test.h"

#include "core/error.h"

namespace clusterbench::assign {

ParamSpec spot_param() {
  return {.name = "spot",
          .summary =
              "how spots are tested. sphere: the one around their cone; range: the sphere of their range; "
              "cone-sphere: the sphere of their range, and the cone against each cell's bounding sphere; both: a cell "
              "has to pass sphere and cone-sphere",
          .default_value = std::string("both"),
          .unit = "",
          .choices = {"sphere", "range", "cone-sphere", "both"},
          .former = {{"ball", "sphere"}}};
}

ParamSpec inflation_param() {
  return {
      .name = "inflation",
      .summary = "padding of the light's radius, in units of the derived rounding error; below 1 lights can be lost",
      .default_value = 1.0,
      .unit = "",
      .min = 0.0,
      .max = 1e6,
      .choices = {},
      .conservative_from = 1.0};
}

std::vector<ParamSpec> light_params() {
  return {spot_param(), inflation_param()};
}

void check_prepared(const view::LightArrays& lights, const std::vector<geom::Ball>& cell_balls) {
  if (!lights.spots.empty() && cell_balls.empty())
    throw Error("", "lights", "have spots, which the build was not told of", ExitCode::internal);
}

LightTest::LightTest(const Params& params, float roundoffs)
    : spot_(SpotTest::both), inflation_(static_cast<float>(params.number("inflation"))), roundoffs_(roundoffs) {
  const std::string& name = params.text("spot");
  if (name == "sphere") spot_ = SpotTest::ball;
  if (name == "range") spot_ = SpotTest::range;
  if (name == "cone-sphere") spot_ = SpotTest::cone_sphere;
}

void LightTest::start_grid(const grid::Grid& grid, const LightKinds& kinds) {
  cell_balls_.clear();
  if (kinds.spots && tests_cones()) cell_balls_ = grid.balls_around_cells();
}

void LightTest::start_frame(const view::LightArrays& lights) const {
  if (tests_cones()) check_prepared(lights, cell_balls_);
}

geom::Ball LightTest::ball(const view::LightArrays& lights, std::uint32_t light, float roundoffs) const {
  const float all = padding(roundoffs);
  if (!lights.is_spot(light) || !balls_are_around_cones()) return lights.ball(light, all);
  return lights.bounding_ball(light, all);
}

TestedLight LightTest::tested(const view::LightArrays& lights, std::uint32_t light) const {
  TestedLight tested{light, ball(lights, light, roundoffs_), false, {}};
  if (!lights.is_spot(light) || !tests_cones()) return tested;
  tested.has_cone = true;
  tested.cone = cone(lights, light);
  return tested;
}

void LightTest::add_row(const TestedLight& light, std::uint32_t first_cell, std::uint32_t count, PairBuffer& pairs,
                        std::uint64_t& tests) const {
  if (!light.has_cone) return pairs.add_row(first_cell, count, light.index);
  tests += count;
  for (std::uint32_t cell = first_cell; cell < first_cell + count; ++cell)
    if (cone_touches(light, cell)) pairs.add(cell, light.index);
}

}  // namespace clusterbench::assign
