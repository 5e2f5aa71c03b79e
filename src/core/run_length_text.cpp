#include "core/run_length_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace clusterbench {
namespace {

std::string word_of(std::uint32_t number) {
  return std::to_string(number);
}

std::string word_of(double number) {
  constexpr int k_digits = 6;
  if (std::isinf(number)) return number > 0.0 ? "Infinity" : "-Infinity";
  std::array<char, 32> text{};
  number += 0.0;  // no negative zero
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::general, k_digits);
  return {text.data(), end.ptr};
}

template <class Number>
std::string text_of(std::span<const Number> numbers) {
  std::string text;
  for (std::size_t begin = 0, end = 0; begin < numbers.size(); begin = end) {
    const std::string word = word_of(numbers[begin]);
    for (end = begin + 1; end < numbers.size() && numbers[end] == numbers[begin];) ++end;
    if (!text.empty()) text += ' ';
    text += word;
    if (end - begin > 1) text += '*' + std::to_string(end - begin);
  }
  return text;
}

}  // namespace

std::string run_length_text(std::span<const std::uint32_t> numbers) {
  return text_of(numbers);
}

std::string run_length_text(std::span<const double> numbers) {
  return text_of(numbers);
}

std::vector<std::uint32_t> gaps_of(std::span<const std::uint32_t> ascending) {
  std::vector<std::uint32_t> gaps;
  gaps.reserve(ascending.size());
  for (std::size_t i = 0; i < ascending.size(); ++i) gaps.push_back(ascending[i] - (i == 0 ? 0 : ascending[i - 1]));
  return gaps;
}

}  // namespace clusterbench
