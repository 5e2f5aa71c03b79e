#pragma once
// The depth range of a visible pixel's light list, by the kind of list: a shader loops over all lights of that range at
// one point (Persson, SIGGRAPH 2015, "wide depths").

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "depth/depth_image.h"
#include "grid/grid.h"

namespace clusterbench::measure {

enum class ListKind : std::uint8_t {
  tiled,              // one list per tile, from its nearest to its farthest surface
  tiled_2_5d,         // those of the 32 equal parts of that range that contain a surface (Harada 2012)
  clusters,           // the whole slice of the cell
  explicit_clusters,  // within the cell, from its nearest to its farthest surface
};
inline constexpr std::size_t k_list_kind_count = 4;
const char* name_of(ListKind kind);

// A histogram of lengths in metres, weighted by pixels.
class LengthDistribution {
 public:
  // `length_m` must be finite and not negative.
  void add(double length_m, std::uint64_t pixels);

  std::uint64_t count() const { return count_; }
  double mean_m() const;  // NaN without pixels, also max_m() and quantile_m()
  double max_m() const;
  // The shortest length that is at least as long as this share of all. Rounded up to a step of the histogram: at most
  // by a sixteenth, or by 2^-30 m.
  double quantile_m(double share) const;

 private:
  std::vector<std::uint64_t> counts_;  // by length, sixteen steps per power of two
  std::uint64_t count_ = 0;
  double sum_m_ = 0.0, max_m_ = 0.0;
};

struct DepthRanges {
  // Tiles of one kind, and their pixels.
  struct Tiles {
    std::uint64_t tiles = 0, pixels = 0;
    std::array<LengthDistribution, k_list_kind_count> lengths;  // by ListKind
  };
  Tiles slopes;  // all neighbour steps are small compared with the depth range of the tile
  // One step is larger than an even slope's by more than a quarter of the tile's range. A tile of at most two pixels
  // across and down counts as a slope.
  Tiles discontinuities;
  std::uint64_t outside = 0;  // visible pixels outside of the grid, in none of the tiles
};

// Adds a picture of surfaces with its samples (opaque_samples()), in a frustum grid. Neighbours are compared by 1 /
// depth (orthographic: depth), which changes by the same amount from pixel to pixel along a plane.
void add_frame(DepthRanges& ranges, const depth::DepthImage& image, std::span<const grid::Sample> samples,
               const grid::ScreenGrid& grid);

}  // namespace clusterbench::measure
