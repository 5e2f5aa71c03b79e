#pragma once
// The true lists of some slices of a frustum grid: what a thread of exact-fast does. Spots come first, all
// slices at once, so that their questions fill vectors; then slice by slice the points' rows and the lists. Keeps its
// memory between frames.

#include "assign/exact_rows.h"
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
  void add_points(int slice);
  void add_batch(int slice, const BatchRows& batch);
  void decide_row(int slice, const BatchRows& batch, int row);
  grid::IndexRange decided(const Row& row, const grid::IndexRange& outer, std::uint32_t light);

  const ExactFrame* frame_ = nullptr;
  SpotSpans spots_;
  BatchReader batches_;
  std::vector<std::uint8_t> is_left_;
  SpanLists spans_;
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

}  // namespace clusterbench::assign
