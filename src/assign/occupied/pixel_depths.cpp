#include "assign/occupied/pixel_depths.h"

#include <algorithm>
#include <cmath>

#include "assign/occupied/first_depth.h"
#include "core/error.h"

namespace clusterbench::assign {
namespace {

constexpr float k_inf = std::numeric_limits<float>::infinity();

// The first pixel of each of `count` tiles, and the end of the last one. tile_of is monotonic.
template <class TileOf>
std::vector<std::uint32_t> begins(int count, int pixels, const TileOf& tile_of) {
  std::vector<std::uint32_t> out(static_cast<std::size_t>(count) + 1, static_cast<std::uint32_t>(pixels));
  for (int pixel = pixels - 1; pixel >= 0; --pixel)
    out[static_cast<std::size_t>(tile_of(static_cast<float>(pixel) + 0.5f))] = static_cast<std::uint32_t>(pixel);
  for (std::size_t tile = out.size() - 1; tile-- > 0;) out[tile] = std::min(out[tile], out[tile + 1]);
  return out;
}

// The least depth whose lookup gives this slice or a later one. The lookup is monotonic.
float first_depth_in(const grid::Slices& slices, int slice) {
  const auto is_before = [&](float depth) {
    const int found = slices.slice_of(depth);
    return found >= 0 && found < slice;
  };
  const float first = slices.boundaries.front();
  return is_before(first) ? first_between(first, k_inf, [&](float depth) { return !is_before(depth); }) : first;
}

}  // namespace

void DepthRanges::close() {
  for (float& depth : hi) depth = depth > -k_inf ? std::nextafter(depth, k_inf) : depth;
}

const depth::DepthImage& checked(const depth::DepthImage* image, const grid::Tiles& tiles) {
  if (image == nullptr) throw Error("", "depth", "is not there, and the method needs it", ExitCode::internal);
  if (image->pixels.size != tiles.viewport || image->nearest.size() != image->pixels.count())
    throw Error("", "depth", "is not that of the picture's pixels", ExitCode::internal);
  return *image;
}

void PixelDepths::build(const grid::ScreenGrid& grid) {
  const grid::Tiles& tiles = grid.tiles;
  column_begins_ = begins(tiles.count.x, tiles.viewport.x, [&](float x) { return tiles.tile_of(x, 0.5f).x; });
  row_begins_ = begins(tiles.count.y, tiles.viewport.y, [&](float y) { return tiles.tile_of(0.5f, y).y; });
  slice_begins_.clear();
  for (int slice = 0; slice <= grid.slices.count(); ++slice)
    slice_begins_.push_back(slice == 0 ? -k_inf : first_depth_in(grid.slices, slice));
  nearest_.resize(width());
  farthest_.resize(width());
}

// A minimum and a maximum in each column of pixels, in a loop that compilers vectorise, then in each tile.
void PixelDepths::find_in_tiles(const depth::DepthImage& image, DepthRanges& out) {
  out.clear(columns() * rows());
  float* nearest = nearest_.data();
  float* farthest = farthest_.data();
  const std::size_t across = width();
  for (std::size_t row = 0; row < rows(); ++row) {
    std::fill(nearest_.begin(), nearest_.end(), k_inf);
    std::fill(farthest_.begin(), farthest_.end(), -k_inf);
    for (std::size_t y = row_begins_[row]; y < row_begins_[row + 1]; ++y) {
      const float* depths = image.nearest.data() + y * across;
      for (std::size_t x = 0; x < across; ++x) {
        const float depth = depths[x], shown = depth < k_inf ? depth : -k_inf;
        nearest[x] = depth < nearest[x] ? depth : nearest[x];
        farthest[x] = shown > farthest[x] ? shown : farthest[x];
      }
    }
    for (std::size_t column = 0; column < columns(); ++column)
      for (std::size_t x = column_begins_[column]; x < column_begins_[column + 1]; ++x)
        if (farthest[x] > -k_inf) {
          out.add(row * columns() + column, nearest[x]);
          out.add(row * columns() + column, farthest[x]);
        }
  }
  out.close();
}

void PixelDepths::find_in_cells(const depth::DepthImage& image, DepthRanges& out) const {
  const std::size_t tiles = columns() * rows(), slices = slice_begins_.size() - 1;
  out.clear(tiles * slices);
  const float* const begins = slice_begins_.data();
  std::size_t slice = 0;  // neighbours are mostly in the same slice, so one range is kept for all of them
  each_row(image, [&](std::size_t tile, const float* depth, const float* end) {
    while (depth < end) {
      if (!(*depth >= begins[slice] && *depth < begins[slice + 1])) {
        const auto next = std::upper_bound(slice_begins_.begin(), slice_begins_.end(), *depth);
        if (next == slice_begins_.end()) {  // beyond the grid, or no surface
          ++depth;
          continue;
        }
        slice = static_cast<std::size_t>(next - slice_begins_.begin()) - 1;
      }
      float lo = *depth, hi = *depth;
      for (++depth; depth < end && *depth >= begins[slice] && *depth < begins[slice + 1]; ++depth) {
        lo = *depth < lo ? *depth : lo;
        hi = *depth > hi ? *depth : hi;
      }
      out.add(slice * tiles + tile, lo);
      out.add(slice * tiles + tile, hi);
    }
  });
  out.close();
}

}  // namespace clusterbench::assign
