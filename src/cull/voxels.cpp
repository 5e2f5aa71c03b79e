#include "cull/voxels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/memory.h"

namespace clusterbench::cull {
namespace {

constexpr std::uint64_t k_voxels_per_word = 64;
// In voxel sizes: rays are shortened by this, more than the single-precision error of surface positions.
constexpr double k_before_end = 1e-3;
// Relative to a ball's size and position: more than the double-precision error of its extents and squares.
constexpr double k_slack = 0x1p-40;

double low_side(std::int64_t index, double size_m) {
  return static_cast<double>(index) * size_m;
}

// Distance of a coordinate outside of [lo, hi].
double outside(double coordinate, double lo, double hi) {
  return std::max({lo - coordinate, coordinate - hi, 0.0});
}

}  // namespace

VoxelIndex voxel_of(const Vec3d& place, double size_m) {
  VoxelIndex index{};
  for (int axis = 0; axis < 3; ++axis)
    index[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(place[axis] / size_m));
  return index;
}

Voxels::Voxels(const Vec3d& lo, const Vec3d& hi, double size_m) : size_m_(size_m), first_(voxel_of(lo, size_m)) {
  const VoxelIndex last = voxel_of(hi, size_m);
  double all = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    counts_[axis] = last[axis] - first_[axis] + 1;
    all *= static_cast<double>(counts_[axis]);
  }
  constexpr double k_surely_too_many = 0x1p60;
  if (all >= k_surely_too_many)
    throw Error("", "limits.memory_mib",
                "the voxels of a visible set would be more than 2^60; use larger ones (pre_cull: visible_set.voxel_m)");
  const auto words = static_cast<std::uint64_t>(all) / k_voxels_per_word + 1;
  check_memory("words of a visible set's voxels", words, sizeof(std::uint64_t),
               "use larger voxels (pre_cull: visible_set.voxel_m)");
  words_.assign(words, 0);
}

void Voxels::mark_way(const Vec3d& from, const Vec3d& along, double length_m) {
  double begin = 0.0, end = length_m - k_before_end * size_m_;
  for (int axis = 0; axis < 3; ++axis) {  // the part within the box
    const auto a = static_cast<std::size_t>(axis);
    const double lo = low_side(first_[a], size_m_), hi = low_side(first_[a] + counts_[a], size_m_);
    if (along[axis] == 0.0) {
      if (from[axis] < lo || from[axis] >= hi) return;
      continue;
    }
    const double to_lo = (lo - from[axis]) / along[axis], to_hi = (hi - from[axis]) / along[axis];
    begin = std::max(begin, std::min(to_lo, to_hi));
    end = std::min(end, std::max(to_lo, to_hi));
  }
  if (!(begin <= end)) return;
  VoxelIndex at = voxel_of(from + begin * along, size_m_);
  Vec3d next(std::numeric_limits<double>::infinity());  // where the ray leaves the voxel along each axis
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    at[a] = std::clamp(at[a] - first_[a], std::int64_t{0}, counts_[a] - 1);
    if (along[axis] != 0.0)
      next[axis] = (low_side(first_[a] + at[a] + (along[axis] > 0.0 ? 1 : 0), size_m_) - from[axis]) / along[axis];
  }
  while (true) {
    const std::uint64_t bit = bit_of(at[0], at[1], at[2]);
    words_[bit / k_voxels_per_word] |= std::uint64_t{1} << bit % k_voxels_per_word;
    const int axis = next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2);
    const auto a = static_cast<std::size_t>(axis);
    if (next[axis] >= end) return;
    at[a] += along[axis] > 0.0 ? 1 : -1;
    if (at[a] < 0 || at[a] >= counts_[a]) return;
    next[axis] = (low_side(first_[a] + at[a] + (along[axis] > 0.0 ? 1 : 0), size_m_) - from[axis]) / along[axis];
  }
}

bool Voxels::any_in(std::uint64_t begin, std::uint64_t end) const {
  while (begin < end) {
    const std::uint64_t in_word = begin % k_voxels_per_word, bits = std::min(k_voxels_per_word - in_word, end - begin);
    const std::uint64_t mask = (bits == k_voxels_per_word ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1)
                               << in_word;
    if ((words_[begin / k_voxels_per_word] & mask) != 0) return true;
    begin += bits;
  }
  return false;
}

bool Voxels::are_touched_by(const Vec3d& center, double radius_m) const {
  const double r = radius_m + k_slack * (std::fabs(center.x) + std::fabs(center.y) + std::fabs(center.z) + radius_m);
  const VoxelIndex lowest = voxel_of(center - r, size_m_), highest = voxel_of(center + r, size_m_);
  const auto from = [&](std::size_t axis) { return std::max(lowest[axis] - first_[axis], std::int64_t{0}); };
  const auto to = [&](std::size_t axis) { return std::min(highest[axis] - first_[axis], counts_[axis] - 1); };
  for (std::int64_t z = from(2); z <= to(2); ++z) {
    const double dz = outside(center.z, low_side(first_[2] + z, size_m_), low_side(first_[2] + z + 1, size_m_));
    for (std::int64_t y = from(1); y <= to(1); ++y) {
      const double dy = outside(center.y, low_side(first_[1] + y, size_m_), low_side(first_[1] + y + 1, size_m_));
      const double left = r * r - dy * dy - dz * dz;
      if (left < 0.0) continue;
      // A row of voxels: from the ball's smallest x in it to its largest.
      const double half = std::sqrt(left);
      const auto voxel = [&](double x) { return static_cast<std::int64_t>(std::floor(x / size_m_)) - first_[0]; };
      const std::int64_t begin = std::max(voxel(center.x - half), std::int64_t{0}),
                         end = std::min(voxel(center.x + half), counts_[0] - 1) + 1;
      if (begin < end && any_in(bit_of(begin, y, z), bit_of(end - 1, y, z) + 1)) return true;
    }
  }
  return false;
}

bool Voxels::is_marked(const VoxelIndex& voxel) const {
  VoxelIndex at{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    at[axis] = voxel[axis] - first_[axis];
    if (at[axis] < 0 || at[axis] >= counts_[axis]) return false;
  }
  const std::uint64_t bit = bit_of(at[0], at[1], at[2]);
  return (words_[bit / k_voxels_per_word] >> bit % k_voxels_per_word & 1) != 0;
}

std::uint64_t Voxels::marked_count() const {
  std::uint64_t count = 0;
  for (const std::uint64_t word : words_) count += static_cast<std::uint64_t>(std::popcount(word));
  return count;
}

}  // namespace clusterbench::cull
