#pragma once
// Which balls reach each slice.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "assign/simd/slice_rows.h"

namespace clusterbench::assign {

// The balls that reach each slice, ascending.
class SliceBalls {
 public:
  // Balls: SeenBalls, or others with `count` and their slices; first_slice > last_slice: none.
  template <class Balls>
  void sort(const Balls& balls, int slices) {
    begin_.assign(static_cast<std::size_t>(slices) + 2, 0);
    for (std::uint32_t i = 0; i < balls.count; ++i)
      for (std::int32_t slice = balls.first_slice[i]; slice <= balls.last_slice[i]; ++slice) ++begin_[at(slice) + 2];
    for (std::size_t slice = 2; slice < begin_.size(); ++slice) begin_[slice] += begin_[slice - 1];
    if (balls_.size() < begin_.back() + k_most_lanes) balls_.resize(begin_.back() + k_most_lanes);
    // begin_[slice + 1] walks from the slice's begin to its end, the next one's begin.
    for (std::uint32_t i = 0; i < balls.count; ++i)
      for (std::int32_t slice = balls.first_slice[i]; slice <= balls.last_slice[i]; ++slice)
        balls_[begin_[at(slice) + 1]++] = i;
    std::fill_n(balls_.begin() + static_cast<std::ptrdiff_t>(begin_.back()), k_most_lanes, 0);
  }

  // How many there are in all slices.
  std::uint32_t count() const { return begin_.back(); }
  // Places in the balls as they were sorted; a whole vector can be read from each of them.
  std::span<const std::uint32_t> of(int slice) const {
    return {balls_.data() + begin_[at(slice)], begin_[at(slice) + 1] - begin_[at(slice)]};
  }
  std::size_t capacity_bytes() const { return (begin_.capacity() + balls_.capacity()) * sizeof(std::uint32_t); }

 private:
  static std::size_t at(int slice) { return static_cast<std::size_t>(slice); }

  std::vector<std::uint32_t> begin_, balls_;
};

}  // namespace clusterbench::assign
