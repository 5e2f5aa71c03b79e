#pragma once
// Removes pairs from light lists whose cell is completely in the shadow of the light (depth/shadow_map.h), and counts
// the savings and the losses.

#include <cstdint>
#include <span>
#include <vector>

#include "assign/contract/lists.h"
#include "depth/shadow_map.h"
#include "grid/grid.h"
#include "measure/samples/shading.h"
#include "view/frame.h"

namespace clusterbench::measure {

// `maps`: one per light of the frame, reduced; null: the light keeps its pairs. Lists keep their order.
void remove_shadowed(const view::Frame& frame, const grid::Grid& grid, const assign::Lists& lists,
                     std::span<const depth::ShadowMap* const> maps, double bias_m, assign::Lists& kept);

// Sums over frames.
struct ShadowCullCounts {
  std::uint64_t pairs = 0, kept = 0;
  std::uint64_t true_pairs = 0, true_kept = 0;  // of these, the true ones, if the truth is known
  // At samples within the grid's cells.
  std::uint64_t samples = 0;
  std::uint64_t evaluated = 0, evaluated_kept = 0;  // entries of the samples' lists
  std::uint64_t needed = 0;                         // of these lights, those whose volume contains the sample
  std::uint64_t lit = 0;                            // of those, not shadowed by any surface: the minimum
  std::uint64_t wrong = 0;                          // of those, removed
  double lit_lux = 0.0, lost_lux = 0.0;             // irradiance of `lit`, of `wrong`
};

// `truth`: the true lists, ascending; null if unknown.
void add_pairs(ShadowCullCounts& counts, const assign::Lists& lists, const assign::Lists& kept,
               const assign::Lists* truth);
// `is_lit`: for each entry of `needed`, whether no surface is between sample and light.
void add_samples(ShadowCullCounts& counts, const grid::Grid& grid, std::span<const grid::Sample> samples,
                 const NeededLights& needed, const std::vector<bool>& is_lit, const assign::Lists& lists,
                 const assign::Lists& kept);

}  // namespace clusterbench::measure
