#include "assign/spot_test.h"

namespace clusterbench::assign {

ParamSpec spot_param() {
  return {
      .name = "spot",
      .summary =
          "spots: the cone's bounding ball; the range's ball with the cone against cells' bounding spheres; or both",
      .standard = std::string("both"),
      .unit = "",
      .choices = {"ball", "cone-sphere", "both"}};
}

SpotTest spot_test_from(const Params& params) {
  const std::string& name = params.text("spot");
  if (name == "ball") return SpotTest::ball;
  return name == "cone-sphere" ? SpotTest::cone_sphere : SpotTest::both;
}

geom::Ball ball_for(const view::LightArrays& lights, std::uint32_t light, SpotTest spot) {
  if (!lights.is_spot(light) || spot == SpotTest::cone_sphere) return lights.ball(light);
  return geom::bounding_ball(lights.cone(light));
}

void CellBalls::ensure(const grid::Grid& grid) {
  if (!balls_.empty()) return;
  balls_.reserve(grid.cell_count());
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
    balls_.push_back(grid.is_hole(cell) ? geom::Ball{{0.0f, 0.0f, 0.0f}, 0.0f} : geom::ball_around(grid.cell(cell)));
}

}  // namespace clusterbench::assign
