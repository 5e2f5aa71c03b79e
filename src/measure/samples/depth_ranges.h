#pragma once
// How much depth the list of a visible pixel covers, by the kind of list: all lights in that much depth are looped over
// at one point (Persson, SIGGRAPH 2015, "wide depths").

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "depth/depth_image.h"
#include "grid/grid.h"

namespace clusterbench::measure {

enum class ListKind : std::uint8_t {
  tiled,              // one list per tile, from its nearest to its farthest surface
  tiled_2_5d,         // of the 32 equal parts of that range, those that hold a surface (Harada 2012)
  clusters,           // the slice of the cell, as it is
  explicit_clusters,  // in the cell, from its nearest to its farthest surface
};
inline constexpr std::size_t k_list_kind_count = 4;
const char* name_of(ListKind kind);

// Lengths in metres, as many as there were pixels.
class LengthDistribution {
 public:
  // A length that is finite and not negative, of so many pixels.
  void add(double length_m, std::uint64_t pixels);

  std::uint64_t count() const { return count_; }
  double mean_m() const;  // NaN without pixels, as all of these
  double max_m() const;
  // The shortest length that is at least as long as this share of all: never too short, too long by a sixteenth at
  // most, or by 2^-30 m.
  double quantile_m(double share) const;

 private:
  std::vector<std::uint64_t> counts_;  // by length, sixteen steps from one power of two to the next
  std::uint64_t count_ = 0;
  double sum_m_ = 0.0, max_m_ = 0.0;
};

struct DepthRanges {
  // Tiles of one kind, and their pixels.
  struct Tiles {
    std::uint64_t tiles = 0, pixels = 0;
    std::array<LengthDistribution, k_list_kind_count> lengths;  // by ListKind
  };
  Tiles slopes;  // from each pixel to the next, depth changes by little of what it changes by in the tile
  // Some neighbours are apart by a quarter of it more than on an even slope. Two pixels do not tell.
  Tiles discontinuities;
  std::uint64_t outside = 0;  // visible pixels beside the grid, in none of the tiles
};

// A picture of surfaces with its samples (opaque_samples()), in a frustum grid. What changes along a plane by the same
// amount from pixel to pixel is 1 / depth (orthographic: depth), and it is this that neighbours are compared by.
void add_frame(DepthRanges& ranges, const depth::DepthImage& image, std::span<const grid::Sample> samples,
               const grid::ScreenGrid& grid);

}  // namespace clusterbench::measure
