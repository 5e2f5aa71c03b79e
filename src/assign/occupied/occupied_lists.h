#pragma once
// Packed lists of the cells that contain the depths of a frame.

#include <memory>
#include <vector>

#include "assign/contract/storage.h"
#include "assign/occupied/pixel_depths.h"

namespace clusterbench::assign {

// The shape of a cell that shows a visible surface.
enum class CellBounds : std::uint8_t {
  tile,         // a tile between the depths of its pixels
  masked_tile,  // of 32 equal parts between these depths, those with depths of pixels
  samples,      // a cell of the grid between the depths of its pixels
  cell          // a cell of the grid, unchanged
};
inline bool has_slices(CellBounds bounds) {
  return bounds == CellBounds::samples || bounds == CellBounds::cell;
}

// The cells of a frame.
struct FrameCells {
  DepthRanges depths;
  std::vector<std::uint32_t> masks;  // of masked tiles

  std::size_t capacity_bytes() const { return depths.capacity_bytes() + bytes_of(masks); }
};

class OccupiedLists final : public LightStructure {
 public:
  OccupiedLists();

  // No allocation in a steady state. `grid` must outlive the structure.
  void store(const grid::Grid& grid, CellBounds bounds, const FrameCells& cells, const Lists& lists,
             const view::LightRanges& lights);

  // A tile's list for every depth of the sample, as a shader reads it: samples in front of the tile's visible surfaces
  // or behind them may lack lights. A tile or a cell without a surface has an empty list.
  bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const override;
  Reads reads_at(const grid::Sample& sample, grid::Log2 way) const override;
  StructureUse use() const override { return packed_->use(); }
  StructureLimit limit() const override { return packed_->limit(); }
  std::vector<BufferNeed> buffers() const override { return packed_->buffers(); }
  bool fill_shader_buffers(ShaderBuffers& shader) const override;
  std::uint32_t index_bits() const override { return packed_->index_bits(); }
  bool has_cells() const override { return true; }
  bool has_occupied_cells() const override { return true; }
  grid::OccupiedCells occupied_cells() const override;
  void expand(Lists& out) const override { packed_->expand(out); }

 private:
  // -1: in no cell.
  std::int64_t cell_of(const grid::Sample& sample, grid::Log2 way) const;

  std::unique_ptr<Storage> packed_;
  const grid::Grid* grid_ = nullptr;
  CellBounds bounds_ = CellBounds::tile;
  FrameCells cells_;
};

}  // namespace clusterbench::assign
