#include "measure/shadows/shadow_cull.h"

#include <algorithm>
#include <cmath>

#include "core/memory.h"
#include "geom/ball/nearest_depth.h"
#include "geom/shapes/corners.h"

namespace clusterbench::measure {
namespace {

// A frustum around a shell cell: the cell's pyramid between its smallest and largest depth.
geom::FrustumCell frustum_around_shell(const geom::ShellCell& cell) {
  const double x = std::max(std::fabs(cell.x0), std::fabs(cell.x1)),
               y = std::max(std::fabs(cell.y0), std::fabs(cell.y1));
  const auto near = static_cast<float>(static_cast<double>(cell.distance0) / std::sqrt(1.0 + x * x + y * y));
  return {cell.x0, cell.x1, cell.y0, cell.y1, std::nextafter(near, 0.0f), cell.distance1, false};
}

double gap(double lo, double at, double hi) {
  return std::max({lo - at, at - hi, 0.0});
}

// Corners of the cell, or of a body around it.
struct Corners {
  geom::Corners operator()(const geom::FrustumCell& cell) const { return geom::exact_corners(cell); }
  geom::Corners operator()(const geom::ShellCell& cell) const {
    return geom::exact_corners(frustum_around_shell(cell));
  }
  geom::Corners operator()(const geom::Box& cell) const { return geom::exact_corners(cell); }
};

// Lower bound of the distance from a point to the cell.
struct Distance {
  Vec3d from;

  double operator()(const geom::Box& cell) const {
    const Vec3d apart(gap(cell.lo.x, from.x, cell.hi.x), gap(cell.lo.y, from.y, cell.hi.y),
                      gap(cell.lo.z, from.z, cell.hi.z));
    return least(apart);
  }
  double operator()(const geom::FrustumCell& cell) const {
    if (cell.orthographic)
      return (*this)(geom::Box{{cell.x0, cell.y0, -cell.depth1}, {cell.x1, cell.y1, -cell.depth0}});
    const geom::PyramidSlab slab{cell.x0, cell.x1, cell.y0, cell.y1, cell.depth0, cell.depth1};
    const double at = geom::nearest_depth(from.x, from.y, -from.z, slab);
    return least({gap(cell.x0 * at, from.x, cell.x1 * at), gap(cell.y0 * at, from.y, cell.y1 * at), at + from.z});
  }
  double operator()(const geom::ShellCell& cell) const { return (*this)(frustum_around_shell(cell)); }

 private:
  // Below the exact length by more than all roundoff, and by more than the error of an approximate nearest depth.
  static double least(const Vec3d& apart) { return glm::length(apart) * (1.0 - 1e-9); }
};

bool contains(std::span<const std::uint32_t> list, std::uint32_t light) {
  return std::ranges::find(list, light) != list.end();
}

}  // namespace

void remove_shadowed(const view::Frame& frame, const grid::Grid& grid, const assign::Lists& lists,
                     std::span<const depth::ShadowMap* const> maps, double bias_m, assign::Lists& kept) {
  const view::Space space = grid::space_of(grid, frame);
  const Mat3d world_from_local = glm::transpose(space.rotation);
  std::vector<Vec3d> in_world, local;  // positions of lights, relative to the space's origin
  for (const scene::WorldLight& light : frame.lights) {
    in_world.push_back(light.position - space.origin);
    local.push_back(space.rotation * in_world.back());
  }
  kept.begin.assign(1, 0);
  kept.lights.clear();
  for (std::uint32_t index = 0; index < lists.cell_count(); ++index) {
    const std::span<const std::uint32_t> list = lists.of(index);
    if (!list.empty()) {
      const geom::Cell cell = grid.cell(index);
      const geom::Corners corners = std::visit(Corners(), cell);
      std::array<Vec3d, 8> turned;
      for (std::size_t i = 0; i < 8; ++i)
        turned[i] = world_from_local * Vec3d(corners[i].x, corners[i].y, corners[i].z);
      for (const std::uint32_t light : list) {
        std::array<Vec3d, 8> from_light = turned;
        for (Vec3d& corner : from_light) corner -= in_world[light];
        const bool is_hidden =
            maps[light] != nullptr && maps[light]->hides(from_light, std::visit(Distance{local[light]}, cell), bias_m);
        if (!is_hidden) kept.lights.push_back(light);
      }
    }
    kept.begin.push_back(static_cast<std::uint32_t>(kept.lights.size()));
  }
}

void add_pairs(ShadowCullCounts& counts, const assign::Lists& lists, const assign::Lists& kept,
               const assign::Lists* truth) {
  counts.pairs += lists.pair_count();
  counts.kept += kept.pair_count();
  if (truth == nullptr) return;
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    const std::span<const std::uint32_t> reaching = truth->of(cell);
    const auto is_true = [&](std::uint32_t light) { return std::ranges::binary_search(reaching, light); };
    counts.true_pairs += static_cast<std::uint64_t>(std::ranges::count_if(lists.of(cell), is_true));
    counts.true_kept += static_cast<std::uint64_t>(std::ranges::count_if(kept.of(cell), is_true));
  }
}

void add_samples(ShadowCullCounts& counts, const grid::Grid& grid, std::span<const grid::Sample> samples,
                 const NeededLights& needed, const std::vector<bool>& is_lit, const assign::Lists& lists,
                 const assign::Lists& kept) {
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    const std::int64_t found = grid::lookup(grid, samples[i]);
    if (found < 0) continue;
    const auto cell = static_cast<std::uint32_t>(found);
    ++counts.samples;
    counts.evaluated += lists.of(cell).size();
    counts.evaluated_kept += kept.of(cell).size();
    for (std::uint32_t k = needed.lists.begin[i]; k < needed.lists.begin[i + 1]; ++k) {
      const std::uint32_t light = needed.lists.lights[k];
      if (!contains(lists.of(cell), light)) continue;  // already missing
      ++counts.needed;
      if (!is_lit[k]) continue;
      ++counts.lit;
      counts.lit_lux += needed.lux[k];
      if (contains(kept.of(cell), light)) continue;
      ++counts.wrong;
      counts.lost_lux += needed.lux[k];
    }
  }
}

}  // namespace clusterbench::measure
