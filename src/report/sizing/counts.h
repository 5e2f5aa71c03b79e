#pragma once
// Arithmetic of counts that saturates at 64 bits: a hand-edited result may contain any number.

#include <cstdint>

namespace clusterbench::report {

std::uint64_t sum_of_counts(std::uint64_t a, std::uint64_t b);
std::uint64_t product_of_counts(std::uint64_t a, std::uint64_t b);
// `step`: above 0.
std::uint64_t up_to_multiple(std::uint64_t value, std::uint64_t step);
// Rounded down. `value`: not negative.
std::uint64_t as_count(double value);

}  // namespace clusterbench::report
