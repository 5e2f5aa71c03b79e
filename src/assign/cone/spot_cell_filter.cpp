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
void filter_cells_of(const view::LightArrays& lights, const RowPlanes& planes, SpotCells& cells) {
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
    const CellTests<orthographic> tests(rows, gathered(planes.side, loaded_indices(cells.column, first)),
                                        gathered(planes.side, loaded_indices(cells.end_column, first)));
    const M in_range = fit_single_precision(planes, rows.light);
    Point lowest;
    M common = tests.has_corner_in_volume(), apart = tests.is_apart(lowest);
    const auto some_are_uncertain = [&] { return !AllTrue(D(), Or(Not(in_range), Or(common, apart))); };
    if (some_are_uncertain()) apart = Or(apart, tests.refine_by_cone_planes(lowest));
    if (some_are_uncertain()) tests.refine_by_projections(common, apart);
    common = And(common, in_range);
    apart = And(apart, in_range);
    const auto code = [&](Touch touch) { return all(static_cast<std::uint32_t>(touch)); };
    const auto answer = IfThenElse(RebindMask(DU(), common), code(Touch::yes),
                                   IfThenElse(RebindMask(DU(), apart), code(Touch::no), code(Touch::uncertain)));
    StoreU(U8FromU32(answer), du8, reinterpret_cast<std::uint8_t*>(cells.touch.data()) + first);
  }
}

void filter_cells(const view::LightArrays& lights, const RowPlanes& planes, SpotCells& cells) {
  planes.orthographic ? filter_cells_of<true>(lights, planes, cells) : filter_cells_of<false>(lights, planes, cells);
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(filter_cells);

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

void filter_spot_cells(const view::LightArrays& lights, const RowPlanes& planes, SpotCells& cells) {
  cells.pad();
  HWY_DYNAMIC_DISPATCH(filter_cells)(lights, planes, cells);
}

}  // namespace clusterbench::assign
#endif
