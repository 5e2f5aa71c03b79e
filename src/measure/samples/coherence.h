#pragma once
// Light lists of pixels that a GPU shades together: how long lanes of a wave wait for each other.

#include <array>
#include <cstdint>
#include <span>

#include "assign/contract/light_structure.h"
#include "depth/depth_image.h"
#include "grid/grid.h"

namespace clusterbench::measure {

// Waves of one size. Counts of a wave include only its lanes with a surface; waves without any are skipped.
struct WaveCounts {
  int width = 8, height = 8;  // pixels
  std::uint64_t waves = 0;
  std::uint64_t distinct_lists = 0;  // sum over the waves
  std::uint64_t most_distinct = 0;   // in one wave
  std::uint64_t longest = 0;         // sum over the waves of their longest list: loop steps until the last lane is done
  std::uint64_t united = 0;          // sum over the waves of distinct lights of all lanes: steps of a scalarised loop
  double mean = 0.0;                 // sum over the waves of their mean list length: steps if no lane waited

  int lanes() const { return width * height; }
  double divergence() const;  // longest / mean; NaN if all lists are empty
  double scalarised() const;  // united / mean
  double mean_distinct() const;
};

// Waves of 32 and of 64 lanes.
struct Coherence {
  std::array<WaveCounts, 2> sizes{WaveCounts{8, 4}, WaveCounts{8, 8}};
};

// Adds a picture at full resolution. `samples`: of its pixels with a surface, in their order (opaque_samples()).
void add_frame(Coherence& coherence, const depth::DepthImage& image, std::span<const grid::Sample> samples,
               const assign::LightStructure& structure);

}  // namespace clusterbench::measure
