#pragma once
// Clustered light maps (Persson, "Practical Clustered Shading", SIGGRAPH 2015): a bit per light and texel of a static
// UV map says which precomputed shadow factors a shader has to fetch. Computes the size of such maps for a scene, and
// the number of lights per texel.

#include <optional>
#include <string>
#include <vector>

#include "measure/light_maps/texel_lights.h"
#include "measure/lists/occupancy.h"

namespace clusterbench::measure {

struct LightMapRequest {
  double texels_per_metre = 4.0;    // mean over a mesh; its map is square
  std::optional<Vec2i> resolution;  // of every map, replaces texels_per_metre
  bool unwrap = false;              // UVs are generated (unwrap.h); those of the file are not read
  TexelCoverage coverage = TexelCoverage::centres;
  bool facing = false, visibility = false;
  double lamp_radius_m = 0.0;
  int tile = 8;  // edge length in texels of a tile that shares a bit field
  int threads = 1;
};

// Size in bytes of the same sets in several formats. A bit field has whole 32-bit words. `own` lights are those that
// reach the map at all; the list of 8 or 16 bits that maps them to lights of the scene is not counted.
struct LightMapBytes {
  std::uint64_t bits_of_all = 0;                   // a bit per light of the scene and texel
  std::uint64_t bits_of_own = 0;                   // a bit per own light and texel
  std::optional<std::uint64_t> lists_8, lists_16;  // 32-bit begin per texel, and an index per pair
  std::uint64_t palette = 0;                       // 8, 16 or 32 bits per texel, and a bit field per distinct set
  std::uint64_t tiles = 0;                         // a bit field of own lights per tile
};

// Counts of one map, or sums over several.
struct LightMapCounts {
  std::uint64_t triangles = 0;
  std::uint64_t wrapped_triangles = 0, degenerate_triangles = 0, missed_triangles = 0;  // as in TexelCover
  std::uint64_t texels = 0, covered = 0, overlapping = 0;
  std::uint64_t lit = 0;                            // texels with at least one light
  std::uint64_t pairs = 0;                          // set bits
  std::array<std::uint64_t, k_texel_tests> left{};  // after each test
  std::vector<std::uint64_t> histogram;             // [n] = covered texels with n lights
  std::uint64_t sets = 0;                           // distinct sets; dead and dark texels share the empty set
  std::uint64_t tiles = 0, tile_pairs = 0;          // tiles with a covered texel; bits set in their unions
  std::uint64_t tile_evaluated = 0;                 // sum over covered texels of the lights in their tile's union
  LightMapBytes bytes;

  std::uint64_t dead() const { return texels - covered; }
  std::uint64_t tile_false_positives() const { return tile_evaluated - pairs; }
  void add(const LightMapCounts& other);
};

struct LightMap {
  std::string name;
  int uv_set = -1;  // -1: generated
  TexelGrid grid;
  double area_m2 = 0.0;      // of its triangles
  std::uint64_t lights = 0;  // own lights: those that reach the map
  LightMapCounts counts;
};

struct LightMaps {
  std::uint64_t points = 0, spots = 0;               // with a bit
  std::uint64_t moving_lights = 0, directional = 0;  // without a bit
  std::vector<LightMap> maps;
  std::vector<LeftOut> left_out;
  LightMapCounts all;
  double seconds = 0.0;  // wall time, from triangles to sets and their sizes
};

// Counts one map. `lights`: number of lights of the scene.
LightMapCounts count_light_map(const TexelCover& cover, const TexelLights& sets, std::uint64_t lights, int tile);
// Side lengths of the map of a mesh whose UVs have an area. Throws Error for sides above k_longest_map_side.
TexelGrid grid_of(const MapMesh& mesh, const LightMapRequest& request);

// Measures a scene with resolved ranges at time 0. The geometry must have UVs unless they are generated.
LightMaps measure_light_maps(const scene::Scene& scene, const scene::Geometry& geometry,
                             const LightMapRequest& request);

}  // namespace clusterbench::measure
