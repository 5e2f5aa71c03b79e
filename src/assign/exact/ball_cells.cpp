#include "assign/exact/ball_cells.h"

#include <algorithm>

#define HWY_TARGET_INCLUDE "assign/exact/ball_cells.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/exact/ball_runs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

void look(const view::LightArrays& lights, const RowPlanes& planes, BallCells& cells) {
  const std::size_t lanes = Lanes(DD());
  for (std::size_t first = 0; first < cells.count; first += lanes) {
    const auto load = [&](const std::vector<std::int32_t>& from) { return LoadU(DH(), from.data() + first); };
    const VH column = load(cells.column);
    const BallRuns balls(lights, planes,
                         {load(cells.light), load(cells.slice), load(cells.row), column, column + Set(DH(), 1)});
    const BallRuns::Nearest nearest = balls.nearest();
    const VD error = enlarged(nearest.excess.error);
    const MD touches = nearest.excess.value <= Neg(error);
    VD undershoot = Zero(DD());
    if (!AllTrue(DD(), touches)) undershoot = BallRuns::undershoot(balls.steepness(nearest));
    const MD misses = nearest.excess.value - undershoot > error;
    store_touches(touches, misses, cells.touch.data() + first);
  }
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(look);

void look_at_balls(const view::LightArrays& lights, const RowPlanes& planes, BallCells& cells) {
  if (cells.count == 0) return;
  // What a whole vector reads beyond the end must be indices that exist.
  for (std::vector<std::int32_t>* list : {&cells.light, &cells.slice, &cells.row, &cells.column})
    std::fill_n(list->begin() + cells.count, k_most_lanes, 0);
  HWY_DYNAMIC_DISPATCH(look)(lights, planes, cells);
}

}  // namespace clusterbench::assign
#endif
