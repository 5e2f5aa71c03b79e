#pragma once
// The true lists of some slices of a frustum grid: what a thread of exact-fast does. Spots come first, all
// slices at once, so that their questions fill vectors; then slice by slice the points' rows and the lists. Keeps its
// memory between frames.

#include "assign/exact_rows.h"
#include "assign/simd/ball_cells.h"
#include "assign/spot_spans.h"

namespace clusterbench::assign {

class ExactSlices {
 public:
  // Lists of the cells of slices first .. last - 1, numbered from the first one's on.
  void find(const ExactFrame& frame, int first, int last, Lists& out);

  std::uint64_t tests() const { return tests_ + spots_.tests(); }
  std::uint64_t fallbacks() const { return fallbacks_ + spots_.fallbacks(); }
  std::size_t scratch_bytes() const;

 private:
  // A span of a batch whose ends may be beyond the cells that are touched; where the questions of its two ends are.
  struct OpenSpan {
    int row;
    std::uint32_t lane, first_question;
  };

  void add_points(int slice);
  void add_batch(int slice, BatchRows& batch);
  void ask(int slice, const BatchRows& batch, int row);
  // The columns that the span's ball touches, as BatchRows has them.
  std::uint32_t decided(int slice, const BatchRows& batch, const OpenSpan& span);
  grid::IndexRange narrowed_to_touched(const grid::IndexRange& columns, const Row& row, std::uint32_t light) const;

  const ExactFrame* frame_ = nullptr;
  SpotSpans spots_;
  BatchReader batches_;
  std::vector<std::uint8_t> is_left_;
  std::vector<OpenSpan> open_;
  BallCells questions_;
  SpanLists spans_;
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

}  // namespace clusterbench::assign
