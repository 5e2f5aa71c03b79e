#pragma once
// One value per frame along a camera path, in bounded memory.

#include <cstdint>
#include <vector>

namespace clusterbench::measure {

// Keeps every frame of a path of up to `most_entries` frames. For a longer path each entry is the maximum over a power
// of two of consecutive frames, since an allocation has to hold the maximum.
class PathSeries {
 public:
  static constexpr std::size_t k_most_entries = 512;

  // `most_entries` must be even.
  explicit PathSeries(std::size_t most_entries = k_most_entries) : most_entries_(most_entries) {}

  void add_frame(std::uint64_t value);
  const std::vector<std::uint64_t>& entries() const { return entries_; }
  std::uint64_t frames_per_entry() const { return frames_per_entry_; }

 private:
  void join_neighbours();

  std::size_t most_entries_;
  std::vector<std::uint64_t> entries_;
  std::uint64_t frames_per_entry_ = 1, frames_in_last_ = 0;
};

}  // namespace clusterbench::measure
