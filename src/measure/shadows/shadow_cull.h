#pragma once
// Takes the pairs out of light lists whose cell lies wholly in the shadow of the light (depth/shadow_map.h), and counts
// what that saves and what it loses.

#include <cstdint>
#include <span>
#include <vector>

#include "assign/contract/lists.h"
#include "depth/shadow_map.h"
#include "grid/grid.h"
#include "measure/samples/shading.h"
#include "view/frame.h"

namespace clusterbench::measure {

// `maps`: of each of the frame's lights, reduced; null: the light keeps its pairs. Lists keep their order.
void remove_shadowed(const view::Frame& frame, const grid::Grid& grid, const assign::Lists& lists,
                     std::span<const depth::ShadowMap* const> maps, double bias_m, assign::Lists& kept);

// Sums over frames.
struct ShadowCullCounts {
  std::uint64_t pairs = 0, kept = 0;
  std::uint64_t true_pairs = 0, true_kept = 0;  // of these, where there is a truth
  // At samples within the grid's cells.
  std::uint64_t samples = 0;
  std::uint64_t evaluated = 0, evaluated_kept = 0;  // lights of their lists
  std::uint64_t needed = 0;                         // of these lights, those whose volume holds the sample
  std::uint64_t lit = 0;                            // of those, not shadowed by any surface: the least that is possible
  std::uint64_t wrong = 0;                          // of those, taken out
  double lit_lux = 0.0, lost_lux = 0.0;             // irradiance of `lit`, of `wrong`
};

// `truth`: the true lists, ascending; null where they are not known.
void add_pairs(ShadowCullCounts& counts, const assign::Lists& lists, const assign::Lists& kept,
               const assign::Lists* truth);
// `is_lit`: of each entry of `needed`, whether no surface stands between sample and light.
void add_samples(ShadowCullCounts& counts, const grid::Grid& grid, std::span<const grid::Sample> samples,
                 const NeededLights& needed, const std::vector<bool>& is_lit, const assign::Lists& lists,
                 const assign::Lists& kept);

}  // namespace clusterbench::measure
