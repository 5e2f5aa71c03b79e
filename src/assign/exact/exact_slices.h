#pragma once
// The true lists of some slices of a frustum grid: the work of one thread of exact-fast. Spots come first, for all
// slices at once, so that their tests fill vectors; then, slice by slice, the points' rows and the lists. Keeps its
// memory between frames.

#include "assign/exact/exact_rows.h"
#include "assign/exact/nearest_points.h"
#include "assign/exact/spot_spans.h"

namespace clusterbench::assign {

class ExactSlices {
 public:
  // Lists of the cells of slices first .. last - 1; cell 0 is the first cell of slice `first`.
  void find(const ExactFrame& frame, int first, int last, Lists& out);

  std::uint64_t tests() const { return tests_ + spots_.tests(); }
  std::uint64_t fallbacks() const { return fallbacks_ + spots_.fallbacks(); }
  std::size_t scratch_bytes() const;

 private:
  // A span of a batch whose ends may extend past the touched cells.
  struct UncertainSpan {
    std::uint32_t* entry;  // in the batch
    std::uint32_t light;
    int slice, row;
    grid::IndexRange columns;
    bool tests_first, tests_last;  // the column at that end needs a test
    std::uint32_t first_test;      // index in end_cells_, of one or two tests
  };
  // Enough to fill vectors of tests, while memory does not depend on the lights.
  static constexpr std::size_t k_most_uncertain = 64;

  void add_points(int slice);
  void collect_uncertain_spans(int slice, BatchSpans& batch);
  void decide_spans();
  void add_end_cells(UncertainSpan& span);
  // Applies the results of the tests. False if the span needs more tests.
  bool is_decided(UncertainSpan& span) const;
  // The span's touched columns without the filter, for lights outside its range.
  grid::IndexRange decided_without_filter(const UncertainSpan& span) const;

  const ExactFrame* frame_ = nullptr;
  SpotSpans spots_;
  BatchReader batches_;
  std::vector<UncertainSpan> uncertain_;
  BallCells end_cells_;
  ListBuilder spans_;
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

}  // namespace clusterbench::assign
