#pragma once
// Which balls reach each slice.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "assign/contract/lists.h"
#include "assign/simd/lanes.h"
#include "core/aligned_vector.h"
#include "core/memory.h"

namespace clusterbench::assign {

// The balls that reach each slice, ascending.
class SliceBins {
 public:
  // Balls: VisibleBalls, or others with `count` and their slices; first_slice > last_slice: none.
  template <class Balls>
  void sort(const Balls& balls, int slices) {
    // How many more balls a slice has than the one before it, then how many it has, then where they end.
    begin_.assign(static_cast<std::size_t>(slices) + 3, 0);
    if (std::uint64_t{balls.count} * static_cast<std::uint64_t>(slices) > k_surely_fit) check_room(balls);
    for (std::uint32_t i = 0; i < balls.count; ++i) {
      if (balls.first_slice[i] > balls.last_slice[i]) continue;
      ++begin_[at(balls.first_slice[i]) + 2];
      --begin_[at(balls.last_slice[i]) + 3];
    }
    begin_.pop_back();
    for (int sums = 0; sums < 2; ++sums) std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    if (balls_.size() < begin_.back() + k_most_lanes) balls_.resize(begin_.back() + k_most_lanes);
    // begin_[slice + 1] walks from the slice's begin to its end, the next one's begin.
    for (std::uint32_t i = 0; i < balls.count; ++i)
      for (std::int32_t slice = balls.first_slice[i]; slice <= balls.last_slice[i]; ++slice)
        balls_[begin_[at(slice) + 1]++] = i;
    std::fill_n(balls_.begin() + static_cast<std::ptrdiff_t>(begin_.back()), k_most_lanes, 0);
  }

  // How many there are in all slices.
  std::uint32_t count() const { return begin_.back(); }
  // Indices of the balls as they were sorted; a whole vector can be read from each of them.
  std::span<const std::uint32_t> of(int slice) const {
    return {balls_.data() + begin_[at(slice)], begin_[at(slice) + 1] - begin_[at(slice)]};
  }
  std::size_t capacity_bytes() const { return (begin_.capacity() + balls_.capacity()) * sizeof(std::uint32_t); }

 private:
  static std::size_t at(int slice) { return static_cast<std::size_t>(slice); }

  // So many are not counted before: they take 1 MiB, the least limit on memory.
  static constexpr std::uint64_t k_surely_fit = (std::uint64_t{1} << 18) - k_most_lanes;

  template <class Balls>
  static void check_room(const Balls& balls) {
    std::uint64_t in_slices = 0;
    for (std::uint32_t i = 0; i < balls.count; ++i)
      in_slices += static_cast<std::uint64_t>(std::max(0, balls.last_slice[i] - balls.first_slice[i] + 1));
    check_memory("lights in slices", in_slices + k_most_lanes, sizeof(std::uint32_t));
    check_pair_count(in_slices);
  }

  AlignedVector<std::uint32_t> begin_, balls_;
};

}  // namespace clusterbench::assign
