#pragma once
// A frame on a frustum grid, shared by all threads of exact-fast, with its balls sorted by slice.

#include <algorithm>
#include <array>
#include <span>

#include "assign/contract/lists.h"
#include "assign/grid_cull/frustum_cull.h"
#include "assign/grid_cull/row_planes.h"
#include "assign/grid_cull/slice_bins.h"
#include "assign/rows/slice_rows.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::assign {

struct ExactFrame {
  const grid::Grid& grid;
  const RowPlanes& planes;
  const view::LightArrays& lights;
  const VisibleBalls& visible;  // points first, then spots; a spot's ball bounds the spot
  std::uint32_t first_spot;     // in `visible`
  const SphereSetup& shapes;    // of the points
  const SliceBins& balls;

  // Indices in `visible` of a slice's points and spots, ascending.
  std::span<const std::uint32_t> points_of(int slice) const {
    return balls.of(slice).first(points_before_spots(slice));
  }
  std::span<const std::uint32_t> spots_of(int slice) const {
    return balls.of(slice).subspan(points_before_spots(slice));
  }

 private:
  std::size_t points_before_spots(int slice) const {
    const std::span<const std::uint32_t> all = balls.of(slice);
    if (first_spot == visible.count) return all.size();
    return static_cast<std::size_t>(std::ranges::lower_bound(all, first_spot) - all.begin());
  }
};

// Reads the rows of the points of some slices, slice by slice and batch by batch. It finds up to k_batches_at_once
// batches together, across slices if a slice has fewer. pipeline/slice_lists.h finds one batch at a time: there the
// rows come from each ball's box. Here a batch's rows need square roots and divisions; several batches side by side
// hide their latency.
class BatchReader {
 public:
  // Starts with slices first .. last - 1.
  void start(const ExactFrame& frame, int first, int last) {
    frame_ = &frame;
    slice_ = first;
    last_ = last;
    begin_ = count_ = next_ = 0;
  }
  // The slice's next batch; null after its last one. Slices must be read to their end, in order. When several batches
  // are found together, visit(slice, batch) is called for each of them and then finish(), before the first one is
  // returned.
  template <class Visit, class Finish>
  const BatchSpans* next(int slice, Visit&& visit, Finish&& finish) {
    if (next_ == count_) {
      find_more();
      for (std::size_t i = 0; i < count_; ++i) visit(balls_[i].slice, rows_[i]);
      finish();
    }
    if (next_ == count_ || balls_[next_].slice != slice) return nullptr;
    return &rows_[next_++];
  }
  const BatchSpans* next(int slice) {
    return next(
        slice, [](int, BatchSpans&) {}, [] {});
  }
  std::size_t capacity_bytes() const {
    std::size_t bytes = 0;
    for (const BatchSpans& batch : rows_) bytes += batch.capacity_bytes();
    return bytes;
  }

 private:
  void find_more() {
    const std::uint32_t most = balls_per_batch();
    count_ = next_ = 0;
    while (count_ < k_batches_at_once && slice_ < last_) {
      const std::span<const std::uint32_t> indices = frame_->points_of(slice_).subspan(begin_);
      if (indices.size() <= most) {
        if (!indices.empty()) balls_[count_++] = {slice_, indices.data(), static_cast<std::uint32_t>(indices.size())};
        ++slice_;
        begin_ = 0;
      } else {
        balls_[count_++] = {slice_, indices.data(), most};
        begin_ += most;
      }
    }
    if (count_ != 0) find_rows(frame_->planes, frame_->shapes, std::span(balls_).first(count_), rows_);
  }

  const ExactFrame* frame_ = nullptr;
  int slice_ = 0, last_ = 0;  // the next slice to find batches for; the end
  std::size_t begin_ = 0;     // the first ball of that slice that is not in a batch yet
  std::array<BallsOfSlice, k_batches_at_once> balls_{};
  std::size_t count_ = 0, next_ = 0;  // the batches found; the next one to be read
  RowBatches rows_;
};

}  // namespace clusterbench::assign
