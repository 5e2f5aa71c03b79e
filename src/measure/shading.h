#pragma once
// Samples ask the light structure, and what it gives is compared with the lights that reach them: comparable between
// grids and methods.

#include <cstdint>
#include <span>
#include <vector>

#include "assign/contract/light_structure.h"
#include "grid/grid.h"
#include "measure/truth.h"

namespace clusterbench::measure {

// Lists that lack more of the lights that are needed at the samples are no lists to compare with: rounding at cell
// boundaries misses far fewer.
inline constexpr double k_most_unlit = 1e-3;
// Of fewer lights that samples need nothing is said.
inline constexpr std::uint64_t k_least_needed = 100;

struct ShadingCounts {
  std::uint64_t samples = 0;
  std::uint64_t evaluated = 0;       // lights that the structure gives at the samples
  std::uint64_t needed = 0;          // lights that reach the samples
  std::uint64_t missed = 0;          // of those, not given, whatever the reason
  std::uint64_t missed_outside = 0;  // of the missed, at samples that lie outside of the grid
  // Share of the irradiance that missed lights carry, 0 where there is none. Irradiance is photometric, in lux on a
  // surface that faces the light: intensity times the colour's luminance, by KHR_lights_punctual's attenuation with the
  // range's window and a spot's falloff.
  double lost_irradiance = 0.0;
  double lost_lux = 0.0, total_lux = 0.0;  // sums over the samples

  double overshade() const;  // evaluated / needed; NaN when nothing is needed
  // NaN also where it compares with nothing: few lights are needed, or some are not given, which makes it small.
  double comparable_overshade() const;
  double unlit() const;  // missed / needed; NaN when nothing is needed
};

// The point on a pixel's ray at a depth. Pixels from the top left.
grid::Sample sample_at(const view::Frame& frame, double pixel_x, double pixel_y, double depth);

// Seeded points in the frame's view: pixels uniform, depth uniform in log from near to far_m.
std::vector<grid::Sample> volume_samples(const view::Frame& frame, double far_m, int count, std::uint64_t seed);

// Which lights reach each of the frame's samples, in exact terms (double-precision distance with the tie counted as
// reached), CSR like lists.
assign::Lists lights_reaching(const view::Frame& frame, std::span<const grid::Sample> samples);

// `is_outside`: of each sample, whether it lies outside of the grid; empty: none does.
void add_frame(ShadingCounts& counts, const view::Frame& frame, std::span<const grid::Sample> samples,
               const assign::Lists& reaching, const assign::LightStructure& structure,
               const std::vector<bool>& is_outside = {});

}  // namespace clusterbench::measure
