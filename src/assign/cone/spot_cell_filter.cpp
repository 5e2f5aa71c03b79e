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

template <class AnyCells>
void look_at(const SpotsAndPlanes& from, Look how, SpotCells& cells) {
  const D d;
  const DU du;
  const hn::Rebind<std::uint8_t, DU> du8;
  const auto lanes = static_cast<std::uint32_t>(Lanes(d));
  for (std::uint32_t first = 0; first < cells.count; first += lanes) {
    const SpotsInRows rows = spots_in_rows(from, loaded_indices(cells.spot, first), loaded_indices(cells.slice, first),
                                           loaded_indices(cells.row, first));
    const AnyCells these(rows, gathered(from.side, loaded_indices(cells.column, first)),
                         gathered(from.side, loaded_indices(cells.end_column, first)));
    M common = FirstN(d, 0), apart = common;
    switch (how) {
      case Look::quick:
        common = these.holds_corner();
        apart = these.is_apart();
        break;
      case Look::approach:
        these.approach(common, apart);
        break;
      case Look::closer:
        common = these.holds_edge_point();
        break;
      case Look::thorough:
        these.settle(common, apart);
        break;
    }
    const M plain = are_plain(from, rows.light);
    common = And(common, plain);
    apart = And(apart, plain);
    const auto code = [&](Touch touch) { return Set(du, static_cast<std::uint32_t>(touch)); };
    const auto answer = IfThenElse(RebindMask(du, common), code(Touch::yes),
                                   IfThenElse(RebindMask(du, apart), code(Touch::no), code(Touch::uncertain)));
    StoreU(U8FromU32(answer), du8, reinterpret_cast<std::uint8_t*>(cells.touch.data()) + first);
  }
}

void look(const SpotsAndPlanes& from, Look how, SpotCells& cells) {
  from.orthographic ? look_at<CellsOf<false>>(from, how, cells) : look_at<Cells>(from, how, cells);
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

void look_at_cells(const SpotsAndPlanes& from, Look how, SpotCells& cells) {
  cells.pad();
  HWY_DYNAMIC_DISPATCH(look)(from, how, cells);
}

}  // namespace clusterbench::assign
#endif
