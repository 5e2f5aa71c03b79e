#pragma once
// Light lists among pixels that a GPU shades together: what lanes of a wave wait for each other.

#include <array>
#include <cstdint>
#include <span>

#include "assign/contract/light_structure.h"
#include "depth/depth_image.h"
#include "grid/grid.h"

namespace clusterbench::measure {

// Waves of one size. Of a wave all counts are over its lanes that show a surface; waves without any are left out.
struct WaveCounts {
  int width = 8, height = 8;  // pixels
  std::uint64_t waves = 0;
  std::uint64_t distinct_lists = 0;  // sum over the waves
  std::uint64_t most_distinct = 0;   // of a wave
  std::uint64_t longest = 0;         // sum over the waves of their longest list: steps until the last lane is done
  std::uint64_t united = 0;          // sum over the waves of the lights that any lane has: steps of a scalarised loop
  double mean = 0.0;                 // sum over the waves of their mean list length: steps if no lane waited

  int lanes() const { return width * height; }
  double divergence() const;  // longest / mean; NaN where all lists are empty
  double scalarised() const;  // united / mean
  double mean_distinct() const;
};

// Waves of 32 and of 64 lanes.
struct Coherence {
  std::array<WaveCounts, 2> sizes{WaveCounts{8, 4}, WaveCounts{8, 8}};
};

// A picture at full resolution. `samples`: of its pixels that show a surface, in their order (opaque_samples()).
void add_frame(Coherence& coherence, const depth::DepthImage& image, std::span<const grid::Sample> samples,
               const assign::LightStructure& structure);

}  // namespace clusterbench::measure
