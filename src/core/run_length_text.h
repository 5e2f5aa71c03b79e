#pragma once
// Long rows of numbers as short text that people and scripts can read: "5 1*40 0.25" is 5, forty times 1, and 0.25.
// Numbers are separated by one blank, N*K is N repeated K times (K at least 2), an empty row is the empty text, and
// "Infinity" is a number.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace clusterbench {

std::string run_length_text(std::span<const std::uint32_t> numbers);
// Six significant digits, the same on every machine. No number may be NaN.
std::string run_length_text(std::span<const double> numbers);

// The first number, followed by the differences between neighbours: short text for ascending numbers.
std::vector<std::uint32_t> gaps_of(std::span<const std::uint32_t> ascending);

}  // namespace clusterbench
