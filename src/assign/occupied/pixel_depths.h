#pragma once
// Depths of a depth buffer per tile and per cell: the least and the greatest depth of their pixels.

#include <cstdint>
#include <limits>
#include <vector>

#include "core/arrays.h"
#include "depth/depth_image.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// Ranges of depth, one for each cell: from the least depth of its pixels up to the float after the greatest, so that
// even a single depth gives a cell with an inside. Empty for cells without a visible surface.
struct DepthRanges {
  std::vector<float> lo, hi;

  // All empty.
  void clear(std::size_t count) {
    lo.assign(count, std::numeric_limits<float>::infinity());
    hi.assign(count, -std::numeric_limits<float>::infinity());
  }
  bool empty(std::size_t cell) const { return !(lo[cell] <= hi[cell]); }
  void add(std::size_t cell, float depth) {
    if (depth < lo[cell]) lo[cell] = depth;
    if (depth > hi[cell]) hi[cell] = depth;
  }
  // To be called after the last depth.
  void close();
  std::size_t size() const { return lo.size(); }
  std::size_t capacity_bytes() const { return bytes_of(lo, hi); }
};

// Throws Error (ExitCode::internal) if a method that needs the depths of all pixels gets none, or those of another
// picture.
const depth::DepthImage& checked(const depth::DepthImage* image, const grid::Tiles& tiles);

// Assigns pixels to tiles and depths to slices as the shader's lookup does. Made once per grid.
class PixelDepths {
 public:
  void build(const grid::ScreenGrid& grid);

  // The ranges of the tiles.
  void find_in_tiles(const depth::DepthImage& image, DepthRanges& out);
  // The ranges of the cells.
  void find_in_cells(const depth::DepthImage& image, DepthRanges& out) const;

  // The first pixel of each column and each row of tiles, and the end of the last one.
  const std::vector<std::uint32_t>& column_begins() const { return column_begins_; }
  const std::vector<std::uint32_t>& row_begins() const { return row_begins_; }

  // Calls visit(tile, begin, end) for each row of pixels of each tile, with their depths.
  template <class Visit>
  void each_row(const depth::DepthImage& image, Visit&& visit) const;

  std::size_t capacity_bytes() const {
    return bytes_of(column_begins_, row_begins_, slice_begins_, nearest_, farthest_);
  }

 private:
  std::size_t columns() const { return column_begins_.size() - 1; }
  std::size_t rows() const { return row_begins_.size() - 1; }
  std::size_t width() const { return column_begins_.back(); }

  std::vector<std::uint32_t> column_begins_, row_begins_;
  std::vector<float> slice_begins_;
  std::vector<float> nearest_, farthest_;  // of a row of tiles, pixel column by pixel column
};

template <class Visit>
void PixelDepths::each_row(const depth::DepthImage& image, Visit&& visit) const {
  for (std::size_t row = 0; row < rows(); ++row)
    for (std::size_t y = row_begins_[row]; y < row_begins_[row + 1]; ++y) {
      const float* depths = image.nearest.data() + y * width();
      for (std::size_t column = 0; column < columns(); ++column)
        visit(row * columns() + column, depths + column_begins_[column], depths + column_begins_[column + 1]);
    }
}

}  // namespace clusterbench::assign
