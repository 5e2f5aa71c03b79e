#pragma once
// Sorting by integers, byte by byte from the lowest: stable, and in time that does not depend on the input's order.

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace clusterbench::assign {

// Floats (no NaN) as integers of the same order; -0 comes before 0.
inline std::uint32_t ordered_bits(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

// Keeps its memory between frames.
template <class Key>
class RadixSort {
 public:
  struct Entry {
    Key key;
    std::uint32_t value;
  };

  std::vector<Entry> entries;  // the input; after sorting, ascending by key, equal ones in their former order

  void sort() {
    other_.resize(entries.size());
    std::memset(counts_.data(), 0, sizeof counts_);
    for (const Entry& entry : entries)
      for (std::size_t byte = 0; byte < sizeof(Key); ++byte) ++counts_[byte][entry.key >> 8 * byte & 0xff];
    for (std::size_t byte = 0; byte < sizeof(Key); ++byte)
      if (!entries.empty() && counts_[byte][entries[0].key >> 8 * byte & 0xff] < entries.size()) sort_by(byte);
  }
  std::size_t capacity_bytes() const { return (entries.capacity() + other_.capacity()) * sizeof(Entry); }

 private:
  void sort_by(std::size_t byte) {
    std::uint32_t begin = 0;
    for (std::uint32_t& count : counts_[byte]) {
      const std::uint32_t end = begin + count;
      count = begin;
      begin = end;
    }
    for (const Entry& entry : entries) other_[counts_[byte][entry.key >> 8 * byte & 0xff]++] = entry;
    entries.swap(other_);
  }

  std::vector<Entry> other_;
  std::array<std::array<std::uint32_t, 256>, sizeof(Key)> counts_{};
};

}  // namespace clusterbench::assign
