#pragma once
// A frame on a frustum grid as all threads of exact-fast see it, and its balls slice by slice.

#include <algorithm>

#include "assign/lists.h"
#include "assign/simd/slice_balls.h"
#include "view/frame.h"

namespace clusterbench::assign {

struct ExactFrame {
  const grid::Grid& grid;
  const RowPlanes& planes;
  const view::LightArrays& lights;
  const SeenBalls& seen;           // first those of points; a spot's ball bounds it
  std::uint32_t first_spot_place;  // in `seen`
  const SliceBalls& balls;

  // Places in `seen` of a slice's points and spots, ascending.
  std::span<const std::uint32_t> points_of(int slice) const {
    return balls.of(slice).first(points_before_spots(slice));
  }
  std::span<const std::uint32_t> spots_of(int slice) const {
    return balls.of(slice).subspan(points_before_spots(slice));
  }

 private:
  std::size_t points_before_spots(int slice) const {
    const std::span<const std::uint32_t> all = balls.of(slice);
    if (first_spot_place == seen.count) return all.size();
    return static_cast<std::size_t>(std::ranges::lower_bound(all, first_spot_place) - all.begin());
  }
};

// Calls take(batch) for the rows of a slice's balls, batch by batch.
template <class Take>
void each_batch(const ExactFrame& frame, int slice, std::span<const std::uint32_t> places, RowBatches& rows,
                Take&& take) {
  const std::uint32_t most = k_batches_at_once * balls_per_batch();
  for (std::size_t begin = 0; begin < places.size(); begin += most) {
    const auto count = std::min(most, static_cast<std::uint32_t>(places.size() - begin));
    find_rows(frame.planes, frame.seen, {slice, places.data() + begin, count}, rows);
    for (std::uint32_t i = 0; i < rows.count; ++i) take(rows.batches[i]);
  }
}

// Calls take(light, columns, is_uncertain) for a batch's spans of a row.
template <class Take>
void each_span(const BatchRows& batch, int row, Take&& take) {
  const std::uint32_t* columns = batch.columns.data() + static_cast<std::size_t>(row) * batch.lanes;
  for (std::uint32_t lane = 0; lane < batch.lanes; ++lane)
    if (columns[lane] != BatchRows::k_none)
      take(batch.lights[lane], grid::IndexRange{BatchRows::first_of(columns[lane]), BatchRows::last_of(columns[lane])},
           (columns[lane] & BatchRows::k_uncertain) != 0);
}

}  // namespace clusterbench::assign
