#pragma once
// The visible cubes of a world grid, as bits.

#include <array>
#include <cstdint>
#include <vector>

#include "geom/shapes/vec.h"

namespace clusterbench::cull {

using VoxelIndex = std::array<std::int64_t, 3>;

// The cube of this size, along the world's axes, that contains a point.
VoxelIndex voxel_of(const Vec3d& place, double size_m);

class Voxels {
 public:
  Voxels() = default;
  // The voxels that meet the box from lo to hi; none is marked. Throws Error beyond the limit on memory.
  Voxels(const Vec3d& lo, const Vec3d& hi, double size_m);

  // Marks the voxels along a ray of this length, from its beginning to just before its end: a wall between two voxels
  // does not open the one behind it. `along` is of unit length; the length may be +inf (Amanatides and Woo 1987, A Fast
  // Voxel Traversal Algorithm for Ray Tracing).
  void mark_way(const Vec3d& from, const Vec3d& along, double length_m);

  // Whether a ball touches a marked voxel.
  bool are_touched_by(const Vec3d& center, double radius_m) const;

  bool is_marked(const VoxelIndex& voxel) const;  // false outside
  std::uint64_t marked_count() const;
  std::uint64_t bytes() const { return words_.size() * sizeof(std::uint64_t); }

 private:
  std::uint64_t bit_of(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::uint64_t>((z * counts_[1] + y) * counts_[0] + x);
  }
  bool any_in(std::uint64_t begin, std::uint64_t end) const;

  double size_m_ = 1.0;
  VoxelIndex first_{0, 0, 0}, counts_{0, 0, 0};
  std::vector<std::uint64_t> words_;  // x fastest, then y, then z
};

}  // namespace clusterbench::cull
