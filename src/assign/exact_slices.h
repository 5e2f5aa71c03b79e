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
  // A spot's columns in a row, as far as they are known: those that are not touched go from both ends.
  struct Lit {
    std::uint32_t light;
    int row;
    grid::IndexRange columns;
    bool left_is_open, right_is_open;  // the end may yet not be touched
  };
  // Cells at one or both ends of a Lit that are asked for, from cells_[place] on.
  struct Ends {
    std::uint32_t lit, place;
    grid::IndexRange columns;
    bool from_left, from_right;
  };

  void add_slice(int slice);
  void add_batch(int slice, const BatchRows& batch, bool has_spots);
  void light_rows(int slice, const BatchRows& batch);
  bool ask_for_ends();
  void ask(std::uint32_t i, const grid::IndexRange& columns, bool from_left, bool from_right);
  void ask_more_closely();
  void add_closer(std::uint32_t place);
  void settle(int slice, const Ends& ends);
  void decide_row(int slice, const BatchRows& batch, int row);
  grid::IndexRange decided(const Row& row, const grid::IndexRange& outer, std::uint32_t light);

  const ExactFrame* frame_ = nullptr;
  RowBatches rows_;
  std::vector<std::uint8_t> is_left_;
  std::vector<Lit> lit_;  // of a batch, row by row
  std::size_t next_lit_ = 0;
  std::vector<Ends> ends_;
  SpotCells cells_, closer_;  // of all ends; those of them to look at closely
  std::vector<std::uint32_t> closer_places_;
  SpanLists spans_;
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

}  // namespace clusterbench::assign
