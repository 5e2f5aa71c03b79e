#pragma once
// Samples on the device, one for each invocation of a reading.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "depth/depth_image.h"
#include "gpu/reading/reading_mode.h"
#include "grid/grid.h"

namespace clusterbench::gpu {

// The sample of each invocation, or k_idle: as in a picture, where a wave's lanes beyond its edge or without a surface
// do nothing.
using WaveOrder = std::vector<std::uint32_t>;
inline constexpr std::uint32_t k_idle = 0xffffffff;

// As many samples, as they come.
WaveOrder in_given_order(std::size_t samples);
// The samples of a picture's pixels with a surface, row by row: in blocks of 8 x 8 pixels, and within a block 2 x 2 by
// 2 x 2, so that a wave of any size is a compact part of the picture.
WaveOrder in_pixel_blocks(const depth::DepthImage& image);

class ReadingSamples {
 public:
  // Refers to the samples. `grid`: any with the same space, that is with the same world_origin().
  ReadingSamples(std::span<const grid::Sample> samples, WaveOrder order, const grid::Grid& grid);

  std::uint32_t invocations() const { return static_cast<std::uint32_t>(order_.size()); }
  // Null: an idle invocation.
  const grid::Sample* sample_of(std::uint32_t invocation) const {
    return order_[invocation] == k_idle ? nullptr : &samples_[order_[invocation]];
  }
  const std::optional<Vec3d>& world_origin() const { return world_origin_; }

  // The cells that readings with ReadingLookup::given take, one for each invocation.
  void give_cells(std::span<const std::int32_t> cells);
  // Memory to be filled before a cold reading; less where the device or the memory limit allows less. Returns its size.
  std::uint64_t reserve_flushed(std::uint64_t bytes);

  Buffers& buffers() { return buffers_; }

 private:
  void upload();

  std::span<const grid::Sample> samples_;
  WaveOrder order_;
  std::optional<Vec3d> world_origin_;
  Buffers buffers_;
};

}  // namespace clusterbench::gpu
