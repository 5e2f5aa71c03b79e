#include "measure/light_maps/texel_lights.h"

#include <algorithm>
#include <atomic>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "core/memory.h"
#include "core/parallel.h"
#include "geom/shapes/plane_side.h"
#include "measure/truth/light_reaches_point.h"

namespace clusterbench::measure {
namespace {

// Edge length in texels of a block: lights that miss the box around a block are rejected for all its texels.
constexpr std::size_t k_block = 8;

struct Bounds {
  Vec3d lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};

  void add(const Vec3d& point) {
    lo = glm::min(lo, point);
    hi = glm::max(hi, point);
  }
  void add(const Bounds& box) {
    lo = glm::min(lo, box.lo);
    hi = glm::max(hi, box.hi);
  }
  // False only if no point of the box is in the light's range.
  bool may_meet(const scene::WorldLight& light) const {
    constexpr double k_slack = 1e-9;  // far more than any rounding of distances
    const Vec3d gap = glm::max(Vec3d(0.0), glm::max(lo - light.position, light.position - hi));
    return glm::length(gap) <= light.range_m * (1.0 + k_slack);
  }
};

std::vector<std::uint32_t> lights_near(const Bounds& bounds, std::span<const scene::WorldLight> lights,
                                       std::span<const std::uint32_t> among) {
  std::vector<std::uint32_t> out;
  for (const std::uint32_t light : among)
    if (bounds.may_meet(lights[light])) out.push_back(light);
  return out;
}

// Rows of blocks, with consecutive texels.
struct Band {
  std::vector<std::uint32_t> lights;
  std::array<std::uint64_t, k_texel_tests> left{};
};

class BandMaker {
 public:
  BandMaker(const MapMesh& mesh, const TexelCover& cover, std::span<const scene::WorldLight> lights,
            const TexelTests& tests)
      : mesh_(mesh), cover_(cover), lights_(lights), tests_(tests), all_(lights.size()) {
    std::iota(all_.begin(), all_.end(), 0U);
  }

  std::size_t count() const { return (static_cast<std::size_t>(cover_.grid.height) + k_block - 1) / k_block; }

  // Writes the number of lights of each texel of the band to counts[texel].
  Band make(std::size_t band, std::uint64_t* counts) {
    const auto width = static_cast<std::size_t>(cover_.grid.width),
               height = static_cast<std::size_t>(cover_.grid.height);
    const std::size_t first = band * k_block * width, last = std::min(height, (band + 1) * k_block) * width;
    std::vector<Vec3d> positions;
    positions.reserve(cover_.begin[last] - cover_.begin[first]);
    std::vector<Bounds> bounds((width + k_block - 1) / k_block);
    for (std::size_t texel = first; texel < last; ++texel)
      for (const TexelSample& sample : cover_.of(texel)) {
        positions.push_back(position_of(sample));
        bounds[texel % width / k_block].add(positions.back());
      }
    Bounds whole;
    for (const Bounds& box : bounds) whole.add(box);
    const std::vector<std::uint32_t> near_band = lights_near(whole, lights_, all_);
    std::vector<std::vector<std::uint32_t>> near;
    for (const Bounds& box : bounds) near.push_back(lights_near(box, lights_, near_band));
    Band out;
    const Vec3d* at = positions.data();
    for (std::size_t texel = first; texel < last; ++texel) {
      counts[texel] = add_texel(cover_.of(texel), at, near[texel % width / k_block], out);
      at += cover_.of(texel).size();
      // The factor 2: the bands, and the array that they are joined into.
      check_memory("lights of texels", found_ += counts[texel], 2 * sizeof(std::uint32_t), "use fewer texels");
    }
    return out;
  }

 private:
  Vec3d position_of(const TexelSample& sample) const {
    const std::array<Vec3d, 3>& corners = mesh_.triangles[sample.triangle].corners;
    return corners[0] + sample.weight_b * (corners[1] - corners[0]) + sample.weight_c * (corners[2] - corners[0]);
  }

  std::uint64_t add_texel(std::span<const TexelSample> samples, const Vec3d* at, std::span<const std::uint32_t> near,
                          Band& out) const {
    const std::size_t before = out.lights.size();
    for (const std::uint32_t light : near) {
      std::size_t passed = 0;
      for (std::size_t i = 0; i < samples.size() && passed < k_texel_tests; ++i)
        passed = std::max(passed, tests_passed(mesh_.triangles[samples[i].triangle], at[i], lights_[light]));
      for (std::size_t test = 0; test < passed; ++test) ++out.left[test];
      if (passed == k_texel_tests) out.lights.push_back(light);
    }
    return out.lights.size() - before;
  }

  // Number of tests passed, in their order; a disabled test counts as passed.
  std::size_t tests_passed(const MapTriangle& triangle, const Vec3d& at, const scene::WorldLight& light) const {
    const Vec3d to_point = at - light.position;
    if (!is_in_range(light, to_point)) return 0;
    if (!is_in_cone(light, to_point)) return 1;
    if (!tests_.facing && tests_.shadows == nullptr) return k_texel_tests;
    const auto& [a, b, c] = triangle.corners;
    const int side = geom::side_of_plane(a, b, c, light.position);
    if (tests_.facing && !(triangle.double_sided ? side != 0 : side > 0)) return 2;
    if (tests_.shadows == nullptr) return k_texel_tests;
    const Vec3d normal = glm::cross(b - a, c - a);
    const double size = glm::length(normal), turn = triangle.double_sided && side < 0 ? -1.0 : 1.0;
    const Vec3d from = size > 0.0 ? at + (turn * tests_.shadows->clearance_m(at) / size) * normal : at;
    return tests_.shadows->is_hidden(from, light.position, tests_.lamp_radius_m) ? 3 : k_texel_tests;
  }

  const MapMesh& mesh_;
  const TexelCover& cover_;
  std::span<const scene::WorldLight> lights_;
  const TexelTests& tests_;
  std::vector<std::uint32_t> all_;
  std::atomic<std::uint64_t> found_ = 0;
};

}  // namespace

TexelLights texel_lights(const MapMesh& mesh, const TexelCover& cover, std::span<const scene::WorldLight> lights,
                         const TexelTests& tests, int threads) {
  TexelLights out;
  out.begin.assign(cover.grid.count() + 1, 0);
  BandMaker maker(mesh, cover, lights, tests);
  std::vector<Band> bands(maker.count());
  parallel_ranges(bands.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t band = begin; band < end; ++band) bands[band] = maker.make(band, out.begin.data() + 1);
  });
  for (std::size_t texel = 0; texel < cover.grid.count(); ++texel) out.begin[texel + 1] += out.begin[texel];
  out.lights.reserve(out.begin.back());
  for (Band& band : bands) {
    out.lights.insert(out.lights.end(), band.lights.begin(), band.lights.end());
    band.lights = {};
    for (std::size_t test = 0; test < k_texel_tests; ++test) out.left[test] += band.left[test];
  }
  return out;
}

}  // namespace clusterbench::measure
