#pragma once
// Which cases nothing else beats.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace clusterbench::measure {

// What a case costs in each respect; smaller is better. NaN: not known, counts as the worst.
using Costs = std::array<double, 3>;

// Places of the cases that no other case equals or beats in every respect while beating it in one. Of equal ones all
// stay.
std::vector<std::size_t> pareto_front(std::span<const Costs> cases);

}  // namespace clusterbench::measure
