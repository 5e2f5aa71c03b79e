#include "gpu/user_shaders/number_bytes.h"

#include <bit>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "view/number_formats.h"

namespace clusterbench::gpu {
namespace {

[[noreturn]] void refuse_number(const std::string& type, double value, const std::string& where) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  throw Error("", where, std::string("is ") + text + " here, which no " + type + " is");
}

// Bits of a whole number in two's complement.
std::uint64_t whole_bits(const std::string& type, double value, const std::string& where) {
  const bool is_signed = type.front() == 'i';
  const int bits = static_cast<int>(8 * bytes_of_number(type));
  const double end = std::ldexp(1.0, is_signed ? bits - 1 : bits), begin = is_signed ? -end : 0.0;
  if (!(value >= begin && value < end) || std::floor(value) != value) refuse_number(type, value, where);
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
}

}  // namespace

std::uint64_t bytes_of_number(const std::string& type) {
  return std::stoull(type.substr(1)) / 8;
}

void check_number(const std::string& type, double value, const std::string& where) {
  constexpr float k_f16_end = 65520.0f;  // what rounds to infinity begins there
  if (type.front() != 'f') {
    whole_bits(type, value, where);
    return;
  }
  if (type == "f64" || !std::isfinite(value)) return;
  const float rounded = std::abs(static_cast<float>(value));
  if (!std::isfinite(rounded) || (type == "f16" && rounded >= k_f16_end)) refuse_number(type, value, where);
}

void write_number(std::byte* to, const std::string& type, double value, const std::string& where) {
  check_number(type, value, where);
  std::uint64_t bits = 0;
  if (type == "f64")
    bits = std::bit_cast<std::uint64_t>(value);
  else if (type == "f32")
    bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  else if (type == "f16")
    bits = view::half_of(static_cast<float>(value));
  else
    bits = whole_bits(type, value, where);
  for (std::uint64_t i = 0; i < bytes_of_number(type); ++i) to[i] = static_cast<std::byte>(bits >> 8 * i & 0xffu);
}

void ByteImage::write(std::uint64_t at, const std::string& type, std::uint64_t step, std::span<const double> numbers,
                      const std::string& where) {
  const std::uint64_t size = bytes_of_number(type), apart = step == 0 ? size : step;
  if (numbers.empty()) return;
  grow(at + (numbers.size() - 1) * apart + size);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    write_number(bytes_.data() + at + i * apart, type, numbers[i], where);
}

}  // namespace clusterbench::gpu
