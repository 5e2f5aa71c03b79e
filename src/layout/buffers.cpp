#include "layout/buffers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/text.h"
#include "view/number_formats.h"

namespace clusterbench::layout {
namespace {

constexpr const char* k_type_names[] = {"u8", "u16", "u32", "u64", "f16", "f32", "f64"};
constexpr std::uint64_t k_type_sizes[] = {1, 2, 4, 8, 2, 4, 8};

std::uint64_t little_endian(const std::byte* bytes, std::uint64_t size) {
  std::uint64_t value = 0;
  for (std::uint64_t i = 0; i < size; ++i) value |= std::to_integer<std::uint64_t>(bytes[i]) << 8 * i;
  return value;
}

// How many rows fit, without overflow.
std::uint64_t rows_in(std::uint64_t bytes, std::uint64_t at, std::uint64_t stride, std::uint64_t row_bytes) {
  if (at > bytes || row_bytes > bytes - at) return 0;
  return stride == 0 ? k_no_whole : (bytes - at - row_bytes) / stride + 1;
}

}  // namespace

NumberType number_type(const std::string& name) {
  const auto* found = std::ranges::find(k_type_names, name);
  return static_cast<NumberType>(found - k_type_names);
}

const char* name_of(NumberType type) {
  return k_type_names[static_cast<std::size_t>(type)];
}

std::uint64_t size_of(NumberType type) {
  return k_type_sizes[static_cast<std::size_t>(type)];
}

bool is_whole(NumberType type) {
  return type <= NumberType::u64;
}

std::string bits_allowed(NumberType type) {
  if (!is_whole(type)) return std::string("allowed: none, since ") + name_of(type) + " is no whole number";
  return "allowed: the first bit and how many, at least 1, within the " + std::to_string(8 * size_of(type)) +
         " bits of " + name_of(type);
}

double real_at(const std::byte* bytes, NumberType type) {
  const std::uint64_t bits = little_endian(bytes, size_of(type));
  if (type == NumberType::f64) return std::bit_cast<double>(bits);
  if (type == NumberType::f32) return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  if (type == NumberType::f16) return static_cast<double>(view::float_of_half(static_cast<std::uint16_t>(bits)));
  return static_cast<double>(bits);
}

std::uint64_t whole_at(const std::byte* bytes, NumberType type) {
  if (is_whole(type)) return little_endian(bytes, size_of(type));
  const double value = real_at(bytes, type);
  constexpr double k_largest_exact = 0x1p53;
  return value >= 0.0 && value <= k_largest_exact && std::floor(value) == value ? static_cast<std::uint64_t>(value)
                                                                                : k_no_whole;
}

const Buffer& BufferReader::buffer(const std::string& name, const std::string& pointer) const {
  const auto found = std::ranges::find(buffers_, name, &Buffer::name);
  if (found != buffers_.end()) return *found;
  std::vector<std::string> names;
  for (const Buffer& buffer : buffers_) names.push_back(buffer.name);
  throw Error("", pointer,
              "found '" + name + "'" + did_you_mean(name, names) +
                  (names.empty() ? ", and the dump has no buffers" : ", allowed: " + joined(names)));
}

Field BufferReader::field(const result::DumpField& field, std::uint64_t row_bytes, const std::string& pointer,
                          std::uint64_t values) const {
  Field out{field.at, number_type(field.type)};
  const std::uint64_t size = size_of(out.type) * values;
  if (field.at > row_bytes || size > row_bytes - field.at)
    throw Error("", pointer + "/at",
                "is " + std::to_string(field.at) + ": its " + std::to_string(size) +
                    " bytes end beyond the stride of " + std::to_string(row_bytes) + " bytes");
  if (!field.bits) return out;
  const auto [first, count] = *field.bits;
  const std::uint64_t width = 8 * size_of(out.type);
  if (!is_whole(out.type) || first >= width || count < 1 || count > width - first)
    throw Error("", pointer + "/bits",
                "is [" + std::to_string(first) + ", " + std::to_string(count) + "]; " + bits_allowed(out.type));
  out.shift = first;
  if (count < 64) out.mask = (std::uint64_t{1} << count) - 1;
  return out;
}

Rows BufferReader::rows(const Buffer& buffer, std::uint64_t at, std::uint64_t stride, std::uint64_t count,
                        std::uint64_t row_bytes, const std::string& pointer, const char* subject) const {
  Rows out;
  out.buffer_ = &buffer;
  out.at_ = at;
  out.stride_ = stride;
  out.count_ = count;
  const std::uint64_t room = rows_in(buffer.bytes.size(), at, stride, row_bytes);
  if (count <= room) return out;
  throw Error("", pointer,
              number_of(count, subject) + ", " + std::to_string(stride) + " bytes apart from byte " +
                  std::to_string(at) + ", do not fit into buffer '" + buffer.name + "' of " +
                  std::to_string(buffer.bytes.size()) + " bytes, which has room for " + std::to_string(room));
}

Rows BufferReader::all_rows(const Buffer& buffer, std::uint64_t at, std::uint64_t stride, std::uint64_t row_bytes,
                            const std::string& pointer) const {
  if (stride == 0) throw Error("", pointer + "/stride", "is 0; allowed: at least 1");
  if (at > buffer.bytes.size())
    throw Error("", pointer + "/at",
                "is " + std::to_string(at) + ", beyond the end of buffer '" + buffer.name + "' of " +
                    std::to_string(buffer.bytes.size()) + " bytes");
  return rows(buffer, at, stride, rows_in(buffer.bytes.size(), at, stride, row_bytes), row_bytes, pointer, "row");
}

}  // namespace clusterbench::layout
