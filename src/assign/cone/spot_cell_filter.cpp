#include "assign/cone/spot_cell_filter.h"

#include <algorithm>
#include <cmath>

#include "assign/contract/lists.h"
#include "core/memory.h"

#define HWY_TARGET_INCLUDE "assign/cone/spot_cell_filter.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/cone/spot_cell_filter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

template <bool orthographic>
void look_at(const view::LightArrays& lights, const RowPlanes& planes, SpotCells& cells) {
  const hn::Rebind<std::uint8_t, DU> du8;
  for (std::uint32_t first = 0; first < cells.count; first += lane_count()) {
    const GivenSpots given(lights, loaded_indices(cells.spot, first));
    const VI slice = loaded_indices(cells.slice, first), row = loaded_indices(cells.row, first);
    const SpotsInRows rows{given.cone,
                           given.light,
                           gathered(planes.slope.data() + 1, row),
                           gathered(planes.slope, row),
                           gathered(planes.depth, slice),
                           gathered(planes.depth.data() + 1, slice)};
    const Cells<orthographic> these(rows, gathered(planes.side, loaded_indices(cells.column, first)),
                                    gathered(planes.side, loaded_indices(cells.end_column, first)));
    const M plain = are_plain(planes, rows.light);
    Point lowest;
    M common = these.holds_corner(), apart = these.is_apart(lowest);
    const auto some_are_uncertain = [&] { return !AllTrue(D(), Or(Not(plain), Or(common, apart))); };
    if (some_are_uncertain()) apart = Or(apart, these.is_beside_corners(lowest));
    if (some_are_uncertain()) these.approach(common, apart);
    common = And(common, plain);
    apart = And(apart, plain);
    const auto code = [&](Touch touch) { return all(static_cast<std::uint32_t>(touch)); };
    const auto answer = IfThenElse(RebindMask(DU(), common), code(Touch::yes),
                                   IfThenElse(RebindMask(DU(), apart), code(Touch::no), code(Touch::uncertain)));
    StoreU(U8FromU32(answer), du8, reinterpret_cast<std::uint8_t*>(cells.touch.data()) + first);
  }
}

void look(const view::LightArrays& lights, const RowPlanes& planes, SpotCells& cells) {
  planes.orthographic ? look_at<true>(lights, planes, cells) : look_at<false>(lights, planes, cells);
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(look);

void SpotCells::grow() {
  const std::size_t size = 2 * spot.size() + 4 * k_most_lanes;
  check_pair_count(size);
  check_memory("cells of spots", size, sizeof(SpotCell) + sizeof(Touch));
  grow_to(size, spot, slice, row, column, end_column, touch);
}

void SpotCells::pad() {
  for (std::vector<std::uint32_t>* list : {&spot, &slice, &row, &column, &end_column})
    std::fill_n(list->begin() + count, std::min(k_most_lanes, list->size() - count), list == &end_column ? 1 : 0);
}

void look_at_cells(const view::LightArrays& lights, const RowPlanes& planes, SpotCells& cells) {
  cells.pad();
  HWY_DYNAMIC_DISPATCH(look)(lights, planes, cells);
}

}  // namespace clusterbench::assign
#endif
