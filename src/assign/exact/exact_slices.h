#pragma once
// The true lists of some slices of a frustum grid: what a thread of exact-fast does. Spots come first, all
// slices at once, so that their questions fill vectors; then slice by slice the points' rows and the lists. Keeps its
// memory between frames.

#include "assign/exact/exact_rows.h"
#include "assign/exact/nearest_points.h"
#include "assign/exact/spot_spans.h"

namespace clusterbench::assign {

class ExactSlices {
 public:
  // Lists of the cells of slices first .. last - 1, numbered from the first one's on.
  void find(const ExactFrame& frame, int first, int last, Lists& out);

  std::uint64_t tests() const { return tests_ + spots_.tests(); }
  std::uint64_t fallbacks() const { return fallbacks_ + spots_.fallbacks(); }
  std::size_t scratch_bytes() const;

 private:
  // A span of a batch whose ends may be beyond the cells that are touched.
  struct UncertainSpan {
    std::uint32_t* entry;  // of the batch
    std::uint32_t light;
    int slice, row;
    grid::IndexRange columns;
    bool asks_first, asks_last;    // whether that column is touched
    std::uint32_t first_question;  // of one or two
  };
  // Vectors of questions are full, and memory does not depend on the lights.
  static constexpr std::size_t k_most_uncertain = 64;

  void add_points(int slice);
  void ask_about_spans(int slice, BatchSpans& batch);
  void settle_spans();
  void ask(UncertainSpan& span);
  // Takes the answers. False if more is to be asked.
  bool is_settled(UncertainSpan& span) const;
  // Without a question before.
  grid::IndexRange touched_anywhere(const UncertainSpan& span) const;

  const ExactFrame* frame_ = nullptr;
  SpotSpans spots_;
  BatchReader batches_;
  std::vector<UncertainSpan> uncertain_;
  BallCells questions_;
  ListBuilder spans_;
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

}  // namespace clusterbench::assign
