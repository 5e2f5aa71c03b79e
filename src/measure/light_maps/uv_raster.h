#pragma once
// Texels of a UV map that the triangles of a mesh cover. Corners are snapped to 1/256 of a texel, as Direct3D 11.3
// (3.4.1) requires of rasterizers, so coverage is computed in integers: along an edge that two triangles share no texel
// is lost or counted twice, and the result is the same on every machine. UVs repeat: a point outside of 0..1 falls on
// the texel that a sampler with repeat wrapping would read.

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
// Largest extent of one triangle across the map, in texels, repeated or not.
inline constexpr std::int64_t k_longest_triangle_texels = 1 << 20;

using UvTriangle = std::array<scene::Vec2f, 3>;

// centres: the texel's centre is covered (a centre on an edge belongs to one of the two triangles there). conservative:
// any part of the texel with an area is covered.
enum class TexelCoverage : std::uint8_t { centres, conservative };

// A triangle in a texel.
struct TexelSample {
  std::uint32_t triangle = 0;
  bool is_centre = true;  // the texel's centre lies in the triangle
  // Barycentric weights of the second and third corner, at the texel's centre, or at the triangle's nearest point to
  // it.
  double weight_b = 0.0, weight_c = 0.0;
};

// The samples of texel t (row by row from v = 0) are samples[begin[t]] .. samples[begin[t + 1] - 1], by triangle.
struct TexelCover {
  TexelGrid grid;
  std::vector<std::uint64_t> begin;
  std::vector<TexelSample> samples;
  std::uint64_t covered = 0;               // texels with a sample
  std::uint64_t overlapping = 0;           // texels whose centre lies in more than one triangle
  std::uint64_t wrapped_triangles = 0;     // reach outside of 0..1
  std::uint64_t degenerate_triangles = 0;  // without area after snapping: in no texel
  std::uint64_t missed_triangles = 0;      // with area but in no texel: too small to cover a centre

  std::span<const TexelSample> of(std::size_t texel) const {
    return {samples.data() + begin[texel], samples.data() + begin[texel + 1]};
  }
};

// Throws Error for a triangle that extends farther than k_longest_triangle_texels, and beyond the memory limit. UVs
// must be within scene::k_farthest_uv.
TexelCover cover_texels(std::span<const UvTriangle> triangles, const TexelGrid& grid, TexelCoverage coverage);

}  // namespace clusterbench::measure
