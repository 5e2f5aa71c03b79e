#pragma once
// One figure frame by frame along a camera path, in bounded room.

#include <cstdint>
#include <vector>

namespace clusterbench::measure {

// Keeps every frame of a path of up to so many entries. Of a longer one each entry is the largest of so many successive
// frames, a power of two, that they fit: what is allocated has to hold the largest.
class PathSeries {
 public:
  static constexpr std::size_t k_most_entries = 512;

  // `most_entries`: even.
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
