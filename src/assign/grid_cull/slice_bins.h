#pragma once
// The balls that reach each slice.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assign/contract/lists.h"
#include "assign/simd/lanes.h"
#include "core/aligned_vector.h"
#include "core/arrays.h"
#include "core/memory.h"

namespace clusterbench::assign {

// The balls that reach each slice, ascending.
class SliceBins {
 public:
  // Balls: VisibleBalls, or another type with `count` and their slices; first_slice > last_slice: none.
  template <class Balls>
  void sort(const Balls& balls, int slices) {
    const auto bins = static_cast<std::size_t>(slices) + 1;
    begin_.assign(bins, 0);
    for (auto& next : next_) next.assign(bins, 0);
    if (std::uint64_t{balls.count} * static_cast<std::uint64_t>(slices) > k_surely_fit) check_room(balls);
    // The change of the number of balls from one slice to the next.
    each_of_halves(balls.count, [&](std::uint32_t i, std::uint32_t* steps) {
      if (balls.first_slice[i] > balls.last_slice[i]) return;
      ++steps[at(balls.first_slice[i])];
      --steps[at(balls.last_slice[i]) + 1];
    });
    std::uint32_t count = 0, in_half[2] = {0, 0};
    for (std::size_t slice = 0; slice < bins; ++slice) {
      begin_[slice] = count;
      for (std::size_t half = 0; half < 2; ++half) {
        in_half[half] += next_[half][slice];
        next_[half][slice] = count;
        count += in_half[half];
      }
    }
    if (balls_.size() < begin_.back() + k_most_lanes) balls_.resize(begin_.back() + k_most_lanes);
    each_of_halves(balls.count, [&](std::uint32_t i, std::uint32_t* next) {
      for (std::int32_t slice = balls.first_slice[i]; slice <= balls.last_slice[i]; ++slice)
        balls_[next[at(slice)]++] = i;
    });
    std::fill_n(balls_.begin() + static_cast<std::ptrdiff_t>(begin_.back()), k_most_lanes, 0);
  }

  // The number of entries in all slices.
  std::uint32_t count() const { return begin_.back(); }
  // Indices of a slice's balls in the sorted input; a whole vector can be read from each of them on.
  std::span<const std::uint32_t> of(int slice) const {
    return {balls_.data() + begin_[at(slice)], begin_[at(slice) + 1] - begin_[at(slice)]};
  }
  std::size_t capacity_bytes() const { return bytes_of(begin_, next_[0], next_[1], balls_); }

 private:
  static std::size_t at(int slice) { return static_cast<std::size_t>(slice); }

  // Up to this number no memory check is needed: the entries take 1 MiB, the smallest memory limit.
  static constexpr std::uint64_t k_surely_fit = (std::uint64_t{1} << 18) - k_most_lanes;

  // Visits the first and the second half in turns, each with its own counter per slice: many consecutive balls that
  // increment the same counter would wait for each other.
  template <class Visit>
  void each_of_halves(std::uint32_t count, Visit&& visit) {
    const std::uint32_t half = count / 2;
    for (std::uint32_t i = 0; i < half; ++i) {
      visit(i, next_[0].data());
      visit(half + i, next_[1].data());
    }
    if (count % 2 != 0) visit(count - 1, next_[1].data());
  }

  template <class Balls>
  static void check_room(const Balls& balls) {
    std::uint64_t in_slices = 0;
    for (std::uint32_t i = 0; i < balls.count; ++i)
      in_slices += static_cast<std::uint64_t>(std::max(0, balls.last_slice[i] - balls.first_slice[i] + 1));
    check_memory("lights in slices", in_slices + k_most_lanes, sizeof(std::uint32_t));
    check_pair_count(in_slices);
  }

  AlignedVector<std::uint32_t> begin_, balls_;
  std::array<AlignedVector<std::uint32_t>, 2> next_;  // of each half: the position of a slice's next ball
};

}  // namespace clusterbench::assign
