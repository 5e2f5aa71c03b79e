#include "assign/cone/spot_cell_filter.h"

#include <algorithm>
#include <cmath>

#include "assign/contract/lists.h"
#include "core/memory.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/cone/spot_cell_filter.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/cone/spot_cell_filter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

template <bool orthographic>
void look_at(const SpotsAndPlanes& from, SpotCells& cells) {
  const D d;
  const DU du;
  const hn::Rebind<std::uint8_t, DU> du8;
  const auto lanes = static_cast<std::uint32_t>(Lanes(d));
  for (std::uint32_t first = 0; first < cells.count; first += lanes) {
    const SpotsInRows rows = spots_in_rows(from, loaded_indices(cells.spot, first), loaded_indices(cells.slice, first),
                                           loaded_indices(cells.row, first));
    const Cells<orthographic> these(rows, gathered(from.side, loaded_indices(cells.column, first)),
                                    gathered(from.side, loaded_indices(cells.end_column, first)));
    const M plain = are_plain(from, rows.light);
    Point lowest;
    const M common = And(these.holds_corner(), plain);
    M apart = And(these.is_apart(lowest), plain);
    if (!AllTrue(d, Or(Not(plain), Or(common, apart)))) apart = Or(apart, And(these.is_beside_corners(lowest), plain));
    const auto code = [&](Touch touch) { return Set(du, static_cast<std::uint32_t>(touch)); };
    const auto answer = IfThenElse(RebindMask(du, common), code(Touch::yes),
                                   IfThenElse(RebindMask(du, apart), code(Touch::no), code(Touch::uncertain)));
    StoreU(U8FromU32(answer), du8, reinterpret_cast<std::uint8_t*>(cells.touch.data()) + first);
  }
}

void look(const SpotsAndPlanes& from, SpotCells& cells) {
  from.orthographic ? look_at<true>(from, cells) : look_at<false>(from, cells);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
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

void look_at_cells(const SpotsAndPlanes& from, SpotCells& cells) {
  cells.pad();
  HWY_DYNAMIC_DISPATCH(look)(from, cells);
}

}  // namespace clusterbench::assign
#endif
