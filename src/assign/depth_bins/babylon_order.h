#pragma once
// The common part of `babylon-masks` and `babylon-as-shipped`: lights in one order by depth, and a range of that order
// for each slice. A slice's range begins with its own first light; or with the first light of all, if a light before
// that one has already reached a slice behind it.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "assign/depth_bins/sorted_masks.h"

namespace clusterbench::assign {

// All lights that are not empty, by the depth of their positions; without culling.
inline void sort_by_depth(const view::LightArrays& lights, std::vector<std::uint32_t>& order) {
  order.clear();
  for (std::uint32_t light = 0; light < lights.size(); ++light)
    if (!lights.is_empty(light)) order.push_back(light);
  std::ranges::sort(order, {}, [&](std::uint32_t light) { return std::pair(-lights.z[light], light); });
}

// `box_of(light)`: tiles and slices of a light; without tiles it has no bits, without slices no place in a range.
template <class BoxOf>
void fill_in_one_order(const grid::Grid& grid, const view::LightArrays& lights, std::vector<std::uint32_t>& order,
                       SortedMasks<RangesOf::slices>& out, BoxOf&& box_of) {
  sort_by_depth(lights, order);
  const int slices = grid.cells().z;
  out.start(grid, lights.size(), static_cast<std::uint32_t>(order.size()), {.is_one_order = true});
  // The last slice whose range began with the light that reached it. Ranges of earlier slices that no light had reached
  // begin with the first light of all, and so do those of slices without lights.
  int last_begun = -1;
  for (int z = 0; z < slices && !order.empty(); ++z) out.begin_with_first(z);
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) {
    const CellBox box = box_of(order[rank]);
    for (int z = std::max(box.first.z, last_begun + 1); z <= box.last.z; ++z) out.begin_anew(z);
    last_begun = std::max(last_begun, box.last.z);
    out.add(rank, order[rank], lights.type_of(order[rank]), box);
  }
}

}  // namespace clusterbench::assign
