#pragma once
// Every light against every box, with the assigners' predicate.

#include "assign/box_grid/box_rows.h"
#include "assign/dense_check.h"
#include "geom/single_precision/touch_tests.h"

namespace clusterbench::assign::testing {

inline Lists every_box_by_distance(const view::LightArrays& lights, const grid::Grid& grid) {
  Lists lists;
  lists.begin.push_back(0);
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
    if (!grid.is_hole(cell)) {
      const auto box = std::get<geom::Box>(grid.cell(cell));
      for (std::uint32_t light = 0; light < lights.size(); ++light) {
        const geom::Ball ball = lights.ball(light, view::k_given_roundoffs + k_box_roundoffs);
        if (!(ball.radius > 0.0f)) continue;
        if (geom::ball_touches_box(ball, box)) lists.lights.push_back(light);
      }
    }
    lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
  }
  return lists;
}

}  // namespace clusterbench::assign::testing
