#pragma once
// Which texels of a UV map a mesh's triangles cover. Corners are snapped to 1/256 of a texel, as Direct3D 11.3 (3.4.1)
// has rasterizers do, so that coverage is decided in whole numbers: no texel is lost or taken twice along an edge that
// two triangles share, and the answer is the same everywhere. UVs repeat: what lies outside of 0..1 falls on the texel
// that a sampler with repeating coordinates would read.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/geometry.h"

namespace clusterbench::measure {

struct TexelGrid {
  int width = 0, height = 0;

  std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

inline constexpr int k_longest_map_side = 16384;
// How far one triangle may reach across the map, repeated or not.
inline constexpr std::int64_t k_longest_triangle_texels = 1 << 20;

using UvTriangle = std::array<scene::Vec2f, 3>;

// By its centre (a centre on an edge belongs to one of the two triangles there), or a texel of which any part with an
// area is covered.
enum class TexelCoverage : std::uint8_t { centres, conservative };

// A triangle in a texel.
struct TexelSample {
  std::uint32_t triangle = 0;
  bool is_centre = true;  // the texel's centre lies in the triangle
  // Of the triangle's second and third corner: of the texel's centre, or else of the triangle's nearest point to it.
  double weight_b = 0.0, weight_c = 0.0;
};

// The samples of texel t (row by row from v = 0) are samples[begin[t]] .. samples[begin[t + 1] - 1], by triangle.
struct TexelCover {
  TexelGrid grid;
  std::vector<std::uint64_t> begin;
  std::vector<TexelSample> samples;
  std::uint64_t covered = 0;               // texels with a sample
  std::uint64_t overlapping = 0;           // texels whose centre lies in more than one triangle
  std::uint64_t wrapped_triangles = 0;     // outside of 0..1
  std::uint64_t degenerate_triangles = 0;  // without area once snapped: in no texel
  std::uint64_t missed_triangles = 0;      // with area, and in no texel: too small for its centres

  std::span<const TexelSample> of(std::size_t texel) const {
    return {samples.data() + begin[texel], samples.data() + begin[texel + 1]};
  }
};

// Throws Error for a triangle that reaches farther than k_longest_triangle_texels, and beyond the limit on memory.
// UVs: within scene::k_farthest_uv.
TexelCover cover_texels(std::span<const UvTriangle> triangles, const TexelGrid& grid, TexelCoverage coverage);

}  // namespace clusterbench::measure
