#pragma once
// Numbers as shaders have them in buffers, little-endian.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace clusterbench::gpu {

// `type`: a name that the schema allows (u8 .. f64).
std::uint64_t bytes_of_number(const std::string& type);
// Throws Error ("", `where`) for a value that the type does not have: of a whole type any but its own, of a float a
// finite one beyond its greatest. Infinity is one (the far plane of a camera without one).
void check_number(const std::string& type, double value, const std::string& where);
// Single and half precision round to nearest. Throws as check_number() does.
void write_number(std::byte* to, const std::string& type, double value, const std::string& where);

// Bytes that grow as they are written, all others 0.
class ByteImage {
 public:
  // `step`: from one number to the next; 0: one after the other.
  void write(std::uint64_t at, const std::string& type, std::uint64_t step, std::span<const double> numbers,
             const std::string& where);
  void clear() { bytes_.clear(); }
  void grow(std::uint64_t size) {
    if (bytes_.size() < size) bytes_.resize(size);
  }
  std::span<const std::byte> bytes() const { return bytes_; }
  std::size_t capacity() const { return bytes_.capacity(); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace clusterbench::gpu
