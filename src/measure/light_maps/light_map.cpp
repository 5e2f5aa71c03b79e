#include "measure/light_maps/light_map.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_map>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "measure/light_maps/unwrap.h"
#include "scene/animation.h"
#include "scene/domain_check.h"

namespace clusterbench::measure {
namespace {

using LightSet = std::span<const std::uint32_t>;

struct HashSet {
  std::size_t operator()(LightSet set) const {
    std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a, one light at a time
    for (const std::uint32_t light : set) hash = (hash ^ light) * 0x100000001b3U;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};
struct EqualSets {
  bool operator()(LightSet a, LightSet b) const { return std::ranges::equal(a, b); }
};

// The lights of the scene that a map has, and the counts that depend on the sets alone.
class SetCounter {
 public:
  SetCounter(const TexelCover& cover, const TexelLights& sets, std::uint64_t lights)
      : cover_(cover), sets_(sets), mark_(lights, k_nowhere) {}

  void count_texels(LightMapCounts& counts) const {
    counts.covered = cover_.covered;
    counts.overlapping = cover_.overlapping;
    counts.texels = cover_.grid.count();
    counts.pairs = sets_.lights.size();
    counts.left = sets_.left;
    for (std::size_t texel = 0; texel < counts.texels; ++texel) {
      if (cover_.of(texel).empty()) continue;
      const std::size_t size = sets_.of(texel).size();
      if (size >= counts.histogram.size()) counts.histogram.resize(size + 1);
      ++counts.histogram[size];
      counts.lit += size > 0 ? 1 : 0;
    }
  }

  std::uint64_t own_lights() const {
    std::vector<bool> is_own(mark_.size(), false);
    for (const std::uint32_t light : sets_.lights) is_own[light] = true;
    return static_cast<std::uint64_t>(std::ranges::count(is_own, true));
  }

  std::uint64_t distinct_sets() const {
    constexpr std::uint64_t k_bytes_of_set = 64;
    std::unordered_map<LightSet, bool, HashSet, EqualSets> known;
    known.emplace(LightSet{}, true);
    for (std::size_t texel = 0; texel < cover_.grid.count(); ++texel) {
      known.emplace(sets_.of(texel), true);
      check_memory("distinct sets of lights", known.size(), k_bytes_of_set, "use fewer texels");
    }
    return known.size();
  }

  // Texels in blocks that share the union of their sets.
  void count_tiles(std::size_t side, LightMapCounts& counts) {
    const auto width = static_cast<std::size_t>(cover_.grid.width),
               height = static_cast<std::size_t>(cover_.grid.height);
    std::uint64_t tile = 0;
    for (std::size_t y = 0; y < height; y += side)
      for (std::size_t x = 0; x < width; x += side, ++tile) {
        std::uint64_t covered = 0, in_union = 0;
        for (std::size_t row = y; row < std::min(height, y + side); ++row)
          for (std::size_t column = x; column < std::min(width, x + side); ++column) {
            covered += cover_.of(row * width + column).empty() ? 0 : 1;
            for (const std::uint32_t light : sets_.of(row * width + column))
              in_union += std::exchange(mark_[light], tile) != tile ? 1 : 0;
          }
        counts.tiles += covered > 0 ? 1 : 0;
        counts.tile_pairs += in_union;
        counts.tile_evaluated += covered * in_union;
      }
  }

 private:
  static constexpr std::uint64_t k_nowhere = std::numeric_limits<std::uint64_t>::max();

  const TexelCover& cover_;
  const TexelLights& sets_;
  std::vector<std::uint64_t> mark_;  // by light: the last tile with it
};

std::uint64_t divided_up(std::uint64_t a, std::uint64_t b) {
  return (a + b - 1) / b;
}

std::uint64_t bit_field_bytes(std::uint64_t lights) {
  return 4 * divided_up(lights, 32);
}

LightMapBytes bytes_of(const LightMapCounts& counts, const TexelGrid& grid, std::uint64_t lights, std::uint64_t own,
                       std::uint64_t side) {
  LightMapBytes out;
  out.bits_of_all = counts.texels * bit_field_bytes(lights);
  out.bits_of_own = counts.texels * bit_field_bytes(own);
  const std::uint64_t begins = 4 * (counts.texels + 1);
  if (own <= 256) out.lists_8 = begins + counts.pairs;
  if (own <= 65536) out.lists_16 = begins + 2 * counts.pairs;
  const std::uint64_t index = counts.sets <= 256 ? 1 : counts.sets <= 65536 ? 2 : 4;
  out.palette = counts.texels * index + counts.sets * bit_field_bytes(own);
  out.tiles = divided_up(static_cast<std::uint64_t>(grid.width), side) *
              divided_up(static_cast<std::uint64_t>(grid.height), side) * bit_field_bytes(own);
  return out;
}

void add_to(std::optional<std::uint64_t>& sum, const std::optional<std::uint64_t>& other) {
  if (sum && other)
    *sum += *other;
  else
    sum.reset();
}

double area_of(const MapTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

double area_of(const UvTriangle& triangle) {
  const Vec2d a(triangle[0]), b = Vec2d(triangle[1]) - a, c = Vec2d(triangle[2]) - a;
  return 0.5 * std::abs(b.x * c.y - b.y * c.x);
}

template <class Triangles>
double whole_area(const Triangles& triangles) {
  double sum = 0.0;
  for (const auto& triangle : triangles) sum += area_of(triangle);
  return sum;
}

// Lights that stand still; counts the others in `out`.
std::vector<scene::WorldLight> still_lights(const scene::Scene& scene, LightMaps& out) {
  const std::vector<bool> moving = scene::moving_nodes(scene);
  std::vector<scene::WorldLight> lights = world_lights(scene, 0.0);
  scene::check_domain(scene, lights, 0.0);
  out.moving_lights = std::erase_if(lights, [&](const scene::WorldLight& light) {
    return moving[static_cast<std::size_t>(scene.lights[static_cast<std::size_t>(light.rig_index)].node)];
  });
  out.spots = static_cast<std::uint64_t>(std::ranges::count(lights, scene::LightType::spot, &scene::WorldLight::type));
  out.points = lights.size() - out.spots;
  out.directional =
      static_cast<std::uint64_t>(std::ranges::count(scene.lights, scene::LightType::directional, &scene::Light::type));
  return lights;
}

// The middle of all triangles: rays then have the same precision in each mesh.
Vec3d middle_of(const StaticMeshes& meshes) {
  Vec3d lo(std::numeric_limits<double>::infinity()), hi = -lo;
  for (const MapMesh& mesh : meshes.meshes)
    for (const MapTriangle& triangle : mesh.triangles)
      for (const Vec3d& corner : triangle.corners) {
        lo = glm::min(lo, corner);
        hi = glm::max(hi, corner);
      }
  return meshes.meshes.empty() ? Vec3d(0.0) : glm::round(0.5 * lo + 0.5 * hi);
}

LightMap light_map_of(MapMesh& mesh, std::span<const scene::WorldLight> lights, const TexelTests& tests,
                      const LightMapRequest& request) {
  LightMap out;
  out.name = mesh.name;
  out.uv_set = mesh.uv_set;
  out.area_m2 = whole_area(mesh.triangles);
  if (request.unwrap) {
    Unwrapped made = unwrapped(mesh, request.texels_per_metre);
    out.grid = made.grid;
    mesh.uvs = std::move(made.uvs);
  } else {
    out.grid = grid_of(mesh, request);
  }
  const TexelCover cover = cover_texels(mesh.uvs, out.grid, request.coverage);
  const TexelLights sets = texel_lights(mesh, cover, lights, tests, request.threads);
  out.counts = count_light_map(cover, sets, lights.size(), request.tile);
  out.lights = SetCounter(cover, sets, lights.size()).own_lights();
  out.counts.triangles = mesh.triangles.size();
  return out;
}

}  // namespace

LightMapCounts count_light_map(const TexelCover& cover, const TexelLights& sets, std::uint64_t lights, int tile) {
  LightMapCounts out;
  SetCounter counter(cover, sets, lights);
  out.wrapped_triangles = cover.wrapped_triangles;
  out.degenerate_triangles = cover.degenerate_triangles;
  out.missed_triangles = cover.missed_triangles;
  counter.count_texels(out);
  out.sets = counter.distinct_sets();
  const auto side = static_cast<std::uint64_t>(tile);
  counter.count_tiles(side, out);
  out.bytes = bytes_of(out, cover.grid, lights, counter.own_lights(), side);
  return out;
}

void LightMapCounts::add(const LightMapCounts& other) {
  for (const auto member :
       {&LightMapCounts::triangles, &LightMapCounts::wrapped_triangles, &LightMapCounts::degenerate_triangles,
        &LightMapCounts::missed_triangles, &LightMapCounts::texels, &LightMapCounts::covered,
        &LightMapCounts::overlapping, &LightMapCounts::lit, &LightMapCounts::pairs, &LightMapCounts::sets,
        &LightMapCounts::tiles, &LightMapCounts::tile_pairs, &LightMapCounts::tile_evaluated})
    this->*member += other.*member;
  for (std::size_t test = 0; test < k_texel_tests; ++test) left[test] += other.left[test];
  if (histogram.size() < other.histogram.size()) histogram.resize(other.histogram.size());
  for (std::size_t n = 0; n < other.histogram.size(); ++n) histogram[n] += other.histogram[n];
  for (const auto member :
       {&LightMapBytes::bits_of_all, &LightMapBytes::bits_of_own, &LightMapBytes::palette, &LightMapBytes::tiles})
    bytes.*member += other.bytes.*member;
  add_to(bytes.lists_8, other.bytes.lists_8);
  add_to(bytes.lists_16, other.bytes.lists_16);
}

TexelGrid grid_of(const MapMesh& mesh, const LightMapRequest& request) {
  if (request.resolution) return {request.resolution->x, request.resolution->y};
  const double side =
      std::max(1.0, std::ceil(request.texels_per_metre * std::sqrt(whole_area(mesh.triangles) / whole_area(mesh.uvs))));
  if (!(side <= k_longest_map_side))
    throw Error("", "--texels-per-metre",
                "its map would be more than " + std::to_string(k_longest_map_side) +
                    " texels wide: use fewer texels per metre, or --resolution");
  return {static_cast<int>(side), static_cast<int>(side)};
}

LightMaps measure_light_maps(const scene::Scene& scene, const scene::Geometry& geometry,
                             const LightMapRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  LightMaps out;
  const std::vector<scene::WorldLight> lights = still_lights(scene, out);
  StaticMeshes meshes = static_meshes(scene, geometry, !request.unwrap);
  out.left_out = std::move(meshes.left_out);
  TexelTests tests;
  tests.facing = request.facing;
  tests.lamp_radius_m = request.lamp_radius_m;
  std::optional<scene::Geometry> walls;
  std::optional<depth::RayCaster> shadows;
  if (request.visibility) {
    walls = static_geometry(scene, geometry);
    shadows.emplace(scene, *walls);
    shadows->pose(0.0, middle_of(meshes));
    tests.shadows = &*shadows;
  }
  out.all.bytes.lists_8 = out.all.bytes.lists_16 = 0;
  for (MapMesh& mesh : meshes.meshes) {
    if (!request.unwrap && !(whole_area(mesh.uvs) > 0.0)) {
      out.left_out.push_back({mesh.name, "has texture coordinates without area"});
      continue;
    }
    try {
      out.maps.push_back(light_map_of(mesh, lights, tests, request));
    } catch (const Error& error) {
      if (!error.file().empty()) throw;
      throw Error(scene.path.string(), error.where(), "mesh '" + printable(mesh.name) + "': " + error.message());
    }
    out.all.add(out.maps.back().counts);
    mesh = {};
  }
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace clusterbench::measure
