#pragma once
// What a depth buffer says of tiles and of cells: the least and the greatest depth of their pixels.

#include <cstdint>
#include <limits>
#include <vector>

#include "core/arrays.h"
#include "depth/depth_image.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// Ranges of depth, one for each cell: from the least depth of its pixels up to the number that follows the greatest, so
// that even a single depth leaves a cell with an inside. Of cells without a visible surface they are empty.
struct DepthRanges {
  std::vector<float> lo, hi;

  // All empty.
  void clear(std::size_t count) {
    lo.assign(count, std::numeric_limits<float>::infinity());
    hi.assign(count, -std::numeric_limits<float>::infinity());
  }
  bool empty(std::size_t cell) const { return !(lo[cell] <= hi[cell]); }
  void take(std::size_t cell, float depth) {
    if (depth < lo[cell]) lo[cell] = depth;
    if (depth > hi[cell]) hi[cell] = depth;
  }
  // After all depths are taken.
  void close();
  std::size_t size() const { return lo.size(); }
  std::size_t capacity_bytes() const { return bytes_of(lo, hi); }
};

// Throws Error (ExitCode::internal) where a method that needs the depths of all pixels is given none, or others.
const depth::DepthImage& checked(const depth::DepthImage* image, const grid::Tiles& tiles);

// Which pixels are whose. Made once per grid; a pixel belongs to the tile, and a depth to the slice, that the shader's
// lookup gives.
class PixelDepths {
 public:
  void build(const grid::ScreenGrid& grid);

  // Of the tiles.
  void find_in_tiles(const depth::DepthImage& image, DepthRanges& out);
  // Of the cells.
  void find_in_cells(const depth::DepthImage& image, DepthRanges& out) const;

  // The depths at which the lookup goes on to another slice: the first of each, and where the last one ends.
  const std::vector<float>& slice_begins() const { return slice_begins_; }
  // The first pixel of each column and each row of tiles, and where the last one ends.
  const std::vector<std::uint32_t>& column_begins() const { return column_begins_; }
  const std::vector<std::uint32_t>& row_begins() const { return row_begins_; }

  // Calls take(tile, begin, end) for each row of pixels of each tile, with their depths.
  template <class Take>
  void each_row(const depth::DepthImage& image, Take&& take) const;

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

template <class Take>
void PixelDepths::each_row(const depth::DepthImage& image, Take&& take) const {
  for (std::size_t row = 0; row < rows(); ++row)
    for (std::size_t y = row_begins_[row]; y < row_begins_[row + 1]; ++y) {
      const float* depths = image.nearest.data() + y * width();
      for (std::size_t column = 0; column < columns(); ++column)
        take(row * columns() + column, depths + column_begins_[column], depths + column_begins_[column + 1]);
    }
}

}  // namespace clusterbench::assign
