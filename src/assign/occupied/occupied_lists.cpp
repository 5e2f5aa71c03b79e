#include "assign/occupied/occupied_lists.h"

#include <cmath>

#include "assign/occupied/depth_parts.h"

namespace clusterbench::assign {
namespace {

// The least depth in this part or a later one, between a depth that is before it and one that is in it or behind it.
float first_depth_in(const DepthParts& parts, int part, float before, float behind) {
  while (std::nextafter(before, behind) < behind) {
    float middle = before + (behind - before) / 2;
    if (!(middle > before && middle < behind)) middle = std::nextafter(before, behind);
    (parts.part_of(middle) < part ? before : behind) = middle;
  }
  return behind;
}

// Neighbouring bits form one convex part. No depth lies between two parts, so both meet where the farther one begins.
void add_masked(geom::FrustumCell tile, std::uint32_t mask, std::vector<geom::FrustumCell>& out) {
  const float lo = tile.depth0, hi = tile.depth1;
  const DepthParts parts(lo, hi);
  const auto begin_of = [&](int part) {
    return part == 0 ? lo : part > parts.part_of(hi) ? hi : first_depth_in(parts, part, lo, hi);
  };
  for (int part = 0; part < DepthParts::k_parts; ++part) {
    if ((mask >> part & 1u) == 0) continue;
    int end = part + 1;
    while (end < DepthParts::k_parts && (mask >> end & 1u) != 0) ++end;
    tile.depth0 = begin_of(part);
    tile.depth1 = end == DepthParts::k_parts ? hi : begin_of(end);
    out.push_back(tile);
    part = end;
  }
}

}  // namespace

OccupiedLists::OccupiedLists() {
  const StorageDescriptor& packed = *find_storage("packed");
  packed_ = packed.make(Params(packed.params));
}

void OccupiedLists::store(const grid::Grid& grid, CellBounds bounds, const FrameCells& cells, const Lists& lists,
                          const view::LightRanges& lights) {
  grid_ = &grid;
  bounds_ = bounds;
  cells_ = cells;
  packed_->start(lists.cell_count(), lights);
  packed_->store(lists);
}

std::int64_t OccupiedLists::cell_of(const grid::Sample& sample, grid::Log2 way) const {
  if (has_slices(bounds_)) return grid::lookup(*grid_, sample, way);
  const grid::Tiles& tiles = grid_->screen().tiles;
  if (!tiles.shows(sample.pixel_x, sample.pixel_y)) return -1;
  if (!tiles.orthographic && !(sample.view.z < 0.0f)) return -1;
  const Vec2i tile = tiles.tile_of(sample.pixel_x, sample.pixel_y);
  return std::int64_t{tile.y} * tiles.count.x + tile.x;
}

bool OccupiedLists::lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const {
  out.clear();
  const std::int64_t cell = cell_of(sample, way);
  if (cell < 0) return false;
  packed_->read_cell(static_cast<std::uint32_t>(cell), out);
  return true;
}

Reads OccupiedLists::reads_at(const grid::Sample& sample, grid::Log2 way) const {
  const std::int64_t cell = cell_of(sample, way);
  return cell < 0 ? Reads{} : packed_->reads_of_cell(static_cast<std::uint32_t>(cell));
}

bool OccupiedLists::fill_shader_buffers(ShaderBuffers& shader) const {
  packed_->fill_shader_buffers(shader);
  if (!has_slices(bounds_)) shader.looked_up = LookedUp::tile;
  return true;
}

grid::OccupiedCells OccupiedLists::occupied_cells() const {
  grid::OccupiedCells out;
  out.counts = grid_->cells();
  if (!has_slices(bounds_)) out.counts.z = 1;
  for (std::uint32_t cell = 0; cell < cells_.depths.size(); ++cell) {
    if (!cells_.depths.empty(cell)) {
      geom::FrustumCell part = std::get<geom::FrustumCell>(grid_->cell(cell));
      if (bounds_ != CellBounds::cell) {
        part.depth0 = cells_.depths.lo[cell];
        part.depth1 = cells_.depths.hi[cell];
      }
      if (bounds_ == CellBounds::masked_tile)
        add_masked(part, cells_.masks[cell], out.parts);
      else
        out.parts.push_back(part);
    }
    out.end_cell();
  }
  return out;
}

}  // namespace clusterbench::assign
