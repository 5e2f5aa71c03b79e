#pragma once
// Raw buffers, and the numbers in them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "result/documents/dump.h"

namespace clusterbench::layout {

struct Buffer {
  std::string name, file;
  std::uint64_t file_at = 0;  // where in the file it begins
  std::vector<std::byte> bytes{};
};

enum class NumberType : std::uint8_t { u8, u16, u32, u64, f16, f32, f64 };
NumberType number_type(const std::string& name);  // a name that the schema allows
const char* name_of(NumberType type);
std::uint64_t size_of(NumberType type);
bool is_whole(NumberType type);
// For messages, of a field with bits: "allowed: the first bit and how many ..."
std::string bits_allowed(NumberType type);

// Little-endian, at any byte. The caller has checked that the bytes are there.
double real_at(const std::byte* bytes, NumberType type);
// Floating-point numbers that are not whole, negative or beyond 2^53: k_no_whole.
std::uint64_t whole_at(const std::byte* bytes, NumberType type);
inline constexpr std::uint64_t k_no_whole = ~std::uint64_t{0};

// A field of a row, checked.
struct Field {
  std::uint64_t at = 0;
  NumberType type = NumberType::u32;
  std::uint64_t shift = 0, mask = k_no_whole;  // of the bits that count

  std::uint64_t end() const { return at + size_of(type); }
  std::uint64_t whole(const std::byte* row) const {
    const std::uint64_t all = whole_at(row + at, type);
    return all == k_no_whole && !is_whole(type) ? all : all >> shift & mask;
  }
};

// Rows of bytes within a buffer, all of them there.
class Rows {
 public:
  Rows() = default;
  const std::byte* row(std::uint64_t index) const { return buffer_->bytes.data() + at_ + index * stride_; }
  // In the buffer's file.
  std::uint64_t byte_of(std::uint64_t index) const { return buffer_->file_at + at_ + index * stride_; }
  const Buffer& buffer() const { return *buffer_; }
  std::uint64_t count() const { return count_; }
  std::uint64_t stride() const { return stride_; }

 private:
  friend class BufferReader;
  const Buffer* buffer_ = nullptr;
  std::uint64_t at_ = 0, stride_ = 0, count_ = 0;
};

// Finds what a dump describes in its buffers. Everything throws Error ("", JSON pointer) where it is not there.
class BufferReader {
 public:
  explicit BufferReader(std::span<const Buffer> buffers) : buffers_(buffers) {}

  // `pointer`: of the name in the dump.
  const Buffer& buffer(const std::string& name, const std::string& pointer) const;
  // A field that lies within its row. `values`: consecutive numbers.
  Field field(const result::DumpField& field, std::uint64_t row_bytes, const std::string& pointer,
              std::uint64_t values = 1) const;
  // `count` rows of which the first `row_bytes` bytes are read each. `subject`: for messages, "row".
  Rows rows(const Buffer& buffer, std::uint64_t at, std::uint64_t stride, std::uint64_t count, std::uint64_t row_bytes,
            const std::string& pointer, const char* subject) const;
  // As many rows as there are in the buffer.
  Rows all_rows(const Buffer& buffer, std::uint64_t at, std::uint64_t stride, std::uint64_t row_bytes,
                const std::string& pointer) const;

 private:
  std::span<const Buffer> buffers_;
};

}  // namespace clusterbench::layout
