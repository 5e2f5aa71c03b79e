#pragma once
// The capacity of each buffer of a structure.

#include <cstdint>

#include "report/sizing/sized_structure.h"

namespace clusterbench::report {

// Of an allocation's bytes: unchanged, whole pages of 4 KiB, or the next power of two.
enum class Rounding : std::uint8_t { none, page, power_of_two };

struct AllocationRules {
  double margin = 2.0;   // capacity / high water, before rounding
  double warn_at = 0.9;  // share of the capacity
  Rounding rounding = Rounding::page;
};

// Whether the method's lists depend on visible surfaces: then other frames can have other cells.
bool follows_surfaces(const result::Case& result_case);

// Sets `buffers`. Needs all other members of the structure.
void size_buffers(SizedStructure& structure, const AllocationRules& rules);

}  // namespace clusterbench::report
