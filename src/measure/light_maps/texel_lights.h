#pragma once
// Which lights reach each texel of a light map.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "depth/ray_caster.h"
#include "measure/light_maps/static_meshes.h"

namespace clusterbench::measure {

// In this order; a light that fails one test skips the rest.
enum class TexelTest : std::uint8_t { range, cone, facing, visibility };
inline constexpr std::size_t k_texel_tests = 4;
inline constexpr std::array<const char*, k_texel_tests> k_texel_test_names{"range", "cone", "facing", "visibility"};

// Tests of a light and a texel besides range and cone, which are those of `needed` samples (light_reaches_point.h).
struct TexelTests {
  // The light is in front of the triangle's plane; for a double-sided triangle, not in the plane. Exact test
  // (geom/shapes/plane_side.h).
  bool facing = false;
  // No opaque surface blocks one ray from RayCaster::clearance_m() above the triangle to lamp_radius_m before the
  // light. Rays are cast in single precision, and are not exact at triangle edges.
  const depth::RayCaster* shadows = nullptr;
  double lamp_radius_m = 0.0;

  bool is_done(TexelTest test) const {
    return test == TexelTest::facing ? facing : test == TexelTest::visibility ? shadows != nullptr : true;
  }
};

// The lights of texel t are lights[begin[t]] .. lights[begin[t + 1] - 1], ascending. A texel covered by several
// triangles has the lights of all of them.
struct TexelLights {
  std::vector<std::uint64_t> begin;
  std::vector<std::uint32_t> lights;
  std::array<std::uint64_t, k_texel_tests> left{};  // (texel, light) pairs after each test

  std::span<const std::uint32_t> of(std::size_t texel) const {
    return {lights.data() + begin[texel], lights.data() + begin[texel + 1]};
  }
};

// The result does not depend on the number of threads. Throws Error beyond the memory limit.
TexelLights texel_lights(const MapMesh& mesh, const TexelCover& cover, std::span<const scene::WorldLight> lights,
                         const TexelTests& tests, int threads);

}  // namespace clusterbench::measure
