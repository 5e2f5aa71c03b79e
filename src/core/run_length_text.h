#pragma once
// Long rows of numbers as short text that people and scripts can read: "5 1*40 0.25" is 5, forty times 1, and 0.25.
// Numbers stand apart by one blank, N*K is N repeated K times (K at least 2), no numbers are the empty text, and
// "Infinity" is a number.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace clusterbench {

std::string run_length_text(std::span<const std::uint32_t> numbers);
// Six significant digits, the same on every machine. No number may be NaN.
std::string run_length_text(std::span<const double> numbers);

// The first number and then what each is above the one before: short text for what ascends.
std::vector<std::uint32_t> gaps_of(std::span<const std::uint32_t> ascending);

}  // namespace clusterbench
