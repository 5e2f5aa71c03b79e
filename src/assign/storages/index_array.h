#pragma once
// Light indices of a width that is set at run time.

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "assign/storages/list_encodings.h"

namespace clusterbench::assign {

// 8, 16 or 32: the narrowest width for the indices of this number of lights.
inline std::uint32_t narrowest_bits(std::uint32_t lights) {
  if (lights <= 1u << 8) return 8;
  return lights <= 1u << 16 ? 16 : 32;
}

class IndexArray {
 public:
  // Never shrinks: growing again would fill with zeros the memory that is written next.
  void make_room(std::size_t entries, std::uint32_t bits) {
    if (bytes_.size() < entries * (bits / 8)) bytes_.resize(entries * (bits / 8));
    bits_ = bits;
  }
  void write(std::size_t at, const std::uint32_t* from, std::size_t count) {
    unsigned char* to = bytes_.data() + at * (bits_ / 8);
    if (bits_ == 8) return narrow(from, count, to);
    if (bits_ == 16) return narrow(from, count, reinterpret_cast<std::uint16_t*>(to));
    if (count > 0) std::memcpy(to, from, count * sizeof(std::uint32_t));
  }
  std::uint32_t read(std::size_t at) const {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_.data() + at * (bits_ / 8), bits_ / 8);  // little-endian
    return value;
  }
  std::uint32_t bits() const { return bits_; }
  // Of the first entries.
  std::span<const unsigned char> bytes(std::size_t entries) const { return {bytes_.data(), entries * (bits_ / 8)}; }

 private:
  std::vector<unsigned char> bytes_;
  std::uint32_t bits_ = 8;
};

}  // namespace clusterbench::assign
