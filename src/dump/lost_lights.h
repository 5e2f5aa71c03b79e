#pragma once
// Lost lights: pairs of a cell and a light that are true and not listed, and how far the light reaches into the cell.

#include <cstdint>
#include <functional>
#include <vector>

#include "measure/truth/truth.h"

namespace clusterbench::dump {

struct LostPair {
  std::uint32_t cell = 0, light = 0;  // of the frame
  double reach = 0.0;                 // share of the range: 1 - distance / range
  double reach_m = 0.0;               // not finite: of a light whose range has no end
  bool is_within_rounding = false;
};

struct LostLights {
  static constexpr std::size_t k_most_kept = 1000;

  std::uint64_t true_pairs = 0, listed_pairs = 0, false_positives = 0;
  std::uint64_t lost_pairs = 0, within_rounding = 0, lights = 0, absent_lights = 0;
  std::vector<LostPair> deepest;  // the deepest first
};

// Most listed pairs: as if they were of another frame, or the lights larger.
inline bool are_for_nothing(const LostLights& found) {
  return found.false_positives > found.listed_pairs / 2;
}

// No rounding of an engine explains more than this, whatever a dump allows for: of a light's range, and in metres.
inline constexpr double k_most_rounding_share = 0.01, k_most_rounding_m = 0.1;

// Roundoffs that are allowed for, up to these two limits.
struct Rounding {
  double roundoffs = 0.0, metres_per_unit = 1.0;
};

// Both lists ascend.
LostLights find_lost(const view::Frame& frame, const grid::Grid& grid, const assign::Lists& truth,
                     const assign::Lists& listed, const Rounding& rounding);

// Only their number, where the list of cell c is that of cell source(c). Stops above `most`.
std::uint64_t count_lost(const assign::Lists& truth, const assign::Lists& listed,
                         const std::function<std::uint32_t(std::uint32_t cell)>& source, std::uint64_t most);

// Their number in the cells that are_counted.
std::uint64_t count_lost_in(const assign::Lists& truth, const assign::Lists& listed,
                            const std::vector<bool>& are_counted);

}  // namespace clusterbench::dump
