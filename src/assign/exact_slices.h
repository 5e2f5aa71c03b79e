#pragma once
// The true lists of some slices of a perspective frustum grid, one slice after the other: what a thread of exact-fast
// does. Keeps its memory between frames.

#include "assign/exact_rows.h"
#include "assign/simd/slice_balls.h"
#include "assign/simd/spot_cells.h"

namespace clusterbench::assign {

// A frame as all threads see it.
struct ExactFrame {
  const grid::Grid& grid;
  const RowPlanes& planes;
  const view::LightArrays& lights;
  const SeenBalls& seen;  // a spot's ball bounds it
  const SliceBalls& balls;
};

class ExactSlices {
 public:
  // Lists of the cells of slices first .. last - 1, numbered from the first one's on.
  void find(const ExactFrame& frame, int first, int last, Lists& out);

  std::uint64_t tests() const { return tests_; }
  std::uint64_t fallbacks() const { return fallbacks_; }
  std::size_t scratch_bytes() const;

 private:
  void add_slice(int slice);
  void look_at_spots(int slice);
  void look_closer(const SpotsAndPlanes& from);
  void add_closer(std::uint32_t place);
  void decide_row(int slice, int row);
  grid::IndexRange decided(const Row& row, const grid::IndexRange& outer, std::uint32_t light);
  grid::IndexRange lit(const Row& row, const grid::IndexRange& outer, CellJudge& judge);
  template <class Take>
  void each_span(int row, Take&& take) const;

  const ExactFrame* frame_ = nullptr;
  BatchRows rows_;
  std::vector<std::uint8_t> is_left_;
  SpotCells cells_, closer_;  // of a batch; those of them to look at closely
  std::vector<std::uint32_t> closer_places_;
  std::uint32_t next_cell_ = 0;
  SpanLists spans_;
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

}  // namespace clusterbench::assign
