#include "dump/lost_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geom/filter/light_filter.h"

namespace clusterbench::dump {
namespace {

// Calls lost(light) for each light of `wanted` that `listed` lacks, and returns how many it has; both ascend.
template <class Lost>
std::size_t each_lost(std::span<const std::uint32_t> wanted, std::span<const std::uint32_t> listed, Lost&& lost) {
  std::size_t next = 0, found = 0;
  for (const std::uint32_t light : wanted) {
    while (next < listed.size() && listed[next] < light) ++next;
    if (next < listed.size() && listed[next] == light)
      ++found;
    else
      lost(light);
  }
  return found;
}

// What single precision may do to a light, as a share of its range.
double rounding_share(const view::Frame& frame, const scene::WorldLight& light, const Rounding& rounding) {
  if (!(light.range_m > 0.0) || !std::isfinite(light.range_m)) return 0.0;
  const Vec3d p = frame.view_space.rotation * (light.position - frame.view_space.origin);
  const double size_m = std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + light.range_m;
  const double most_m = k_most_rounding_m / rounding.metres_per_unit;
  return std::min(std::min(rounding.roundoffs * 0x1p-24 * size_m, most_m) / light.range_m, k_most_rounding_share);
}

std::vector<double> rounding_shares(const view::Frame& frame, const Rounding& rounding) {
  std::vector<double> shares;
  for (const scene::WorldLight& light : frame.lights) shares.push_back(rounding_share(frame, light, rounding));
  return shares;
}

// Whether a spot's cone still meets the cell once its side is this much further in: moved along its axis. Other lights
// have no side.
bool meets_narrowed(const geom::LightVolume& light, const geom::Cell& cell, double in_m) {
  const auto* spot = std::get_if<geom::SpotVolume>(&light);
  if (spot == nullptr || in_m == 0.0) return true;
  const double sine = std::sin(spot->half_angle_rad);
  if (!(sine > 0.0) || !std::isfinite(in_m / sine)) return false;
  geom::SpotVolume narrowed = *spot;
  narrowed.apex.position += glm::normalize(spot->direction) * (in_m / sine);
  return geom::filter_meets(geom::LightVolume(narrowed), cell) != geom::Verdict::no;
}

// How far a light reaches into a cell, as a share of its range: from its end, for a spot from the side of its cone
// where that is less. Exact only above `above`.
double reach_of(const view::Frame& frame, const grid::Grid& grid, std::uint32_t cell, std::uint32_t light,
                double above) {
  const double from_end = 1.0 - measure::relative_distance(frame, grid, cell, light, 1.0 - above);
  const geom::LightVolume volume = view::volume_of(frame.lights[light], grid::space_of(grid, frame));
  const double range_m = geom::range_of(volume);
  const geom::Cell of_grid = grid.cell(cell);
  if (from_end <= above || std::isinf(range_m) || meets_narrowed(volume, of_grid, from_end * range_m)) return from_end;
  double low = 0.0, high = from_end;
  constexpr int k_halvings = 40;
  for (int i = 0; i < k_halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (meets_narrowed(volume, of_grid, middle * range_m) ? low : high) = middle;
  }
  return low;
}

bool reaches_beyond(const view::Frame& frame, const grid::Grid& grid, std::uint32_t cell, std::uint32_t light,
                    double share) {
  if (share >= 1.0) return false;
  const geom::LightVolume volume = view::volume_of(frame.lights[light], grid::space_of(grid, frame));
  if (std::isinf(geom::range_of(volume))) return true;
  const geom::Cell of_grid = grid.cell(cell);
  return geom::filter_meets(geom::with_range(volume, geom::range_of(volume) * (1.0 - share)), of_grid) !=
             geom::Verdict::no &&
         meets_narrowed(volume, of_grid, share * geom::range_of(volume));
}

// Shares that differ by less are equal: those of lights whose centres are in their cells are found by halving.
constexpr double k_same_share = 1e-6;

// Among equal shares the longer one.
bool is_deeper(const LostPair& a, const LostPair& b) {
  const double share_of_a = std::round(a.reach / k_same_share), share_of_b = std::round(b.reach / k_same_share);
  if (share_of_a != share_of_b) return share_of_a > share_of_b;
  if (a.reach_m != b.reach_m) return a.reach_m > b.reach_m;
  return a.cell != b.cell ? a.cell < b.cell : a.light < b.light;
}

// The deepest pairs, as a heap whose top is the least deep.
void keep_deepest(std::vector<LostPair>& kept, const LostPair& pair) {
  if (kept.size() == LostLights::k_most_kept) {
    if (!is_deeper(pair, kept.front())) return;
    std::pop_heap(kept.begin(), kept.end(), is_deeper);
    kept.pop_back();
  }
  kept.push_back(pair);
  std::push_heap(kept.begin(), kept.end(), is_deeper);
}

}  // namespace

LostLights find_lost(const view::Frame& frame, const grid::Grid& grid, const assign::Lists& truth,
                     const assign::Lists& listed, const Rounding& rounding) {
  LostLights out;
  const std::vector<double> shares = rounding_shares(frame, rounding);
  std::vector<bool> is_lost(frame.lights.size(), false), is_listed(frame.lights.size(), false);
  for (const std::uint32_t light : listed.lights) is_listed[light] = true;
  for (std::uint32_t cell = 0; cell < truth.cell_count(); ++cell) {
    const std::size_t found = each_lost(truth.of(cell), listed.of(cell), [&](std::uint32_t light) {
      ++out.lost_pairs;
      is_lost[light] = true;
      LostPair pair{cell, light, 0.0, 0.0, !reaches_beyond(frame, grid, cell, light, shares[light])};
      out.within_rounding += pair.is_within_rounding ? 1 : 0;
      const bool is_full = out.deepest.size() == LostLights::k_most_kept;
      const double above = is_full ? std::max(0.0, out.deepest.front().reach - 2.0 * k_same_share) : 0.0;
      pair.reach = reach_of(frame, grid, cell, light, above);
      pair.reach_m = pair.reach > 0.0 ? pair.reach * frame.lights[light].range_m : 0.0;
      keep_deepest(out.deepest, pair);
    });
    out.false_positives += listed.of(cell).size() - found;
  }
  std::ranges::sort(out.deepest, is_deeper);
  out.true_pairs = truth.pair_count();
  out.listed_pairs = listed.pair_count();
  for (std::size_t light = 0; light < is_lost.size(); ++light) {
    out.lights += is_lost[light] ? 1 : 0;
    out.absent_lights += is_lost[light] && !is_listed[light] ? 1 : 0;
  }
  return out;
}

std::uint64_t count_lost(const assign::Lists& truth, const assign::Lists& listed,
                         const std::function<std::uint32_t(std::uint32_t cell)>& source, std::uint64_t most) {
  std::uint64_t lost = 0;
  for (std::uint32_t cell = 0; cell < truth.cell_count() && lost <= most; ++cell)
    if (!truth.of(cell).empty()) each_lost(truth.of(cell), listed.of(source(cell)), [&lost](std::uint32_t) { ++lost; });
  return lost;
}

std::uint64_t count_lost_in(const assign::Lists& truth, const assign::Lists& listed,
                            const std::vector<bool>& are_counted) {
  std::uint64_t lost = 0;
  for (std::uint32_t cell = 0; cell < truth.cell_count(); ++cell)
    if (are_counted[cell]) each_lost(truth.of(cell), listed.of(cell), [&lost](std::uint32_t) { ++lost; });
  return lost;
}

}  // namespace clusterbench::dump
