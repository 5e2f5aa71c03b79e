#pragma once
// How the viewport is cut into tiles. Row 0 is at the top, column 0 at the left. Edge tiles are clipped to the
// viewport.

#include <vector>

#include "geom/shapes/vec.h"
#include "view/frame.h"

namespace clusterbench::grid {

// Pixels per tile, tiles per screen, or an aspect from which tiles are computed; values that are not given are 0.
struct Tiling {
  Vec2i pixels{64, 64};
  Vec2i count{0, 0};
  // Ratio of depth to height of cells, for slices that grow by a factor: square tiles, a whole number of them down the
  // picture. 1: cubical cells.
  double aspect = 0.0;

  bool is_by_count() const { return count.x != 0 || count.y != 0; }
  friend bool operator==(const Tiling&, const Tiling&) = default;
};

// Tiles across and down the picture, including clipped ones at its edges. Not for tilings with an aspect, nor for sizes
// below 1.
Vec2i tile_counts(const Tiling& tiling, Vec2i viewport);

// Height of a tile that is not clipped, at depth 1 (perspective) or anywhere (orthographic, in metres). Not for tilings
// with an aspect.
double tile_height(const Tiling& tiling, const view::Projection& projection, Vec2i viewport);
// Tiles per screen of a tiling with an aspect, for slices that are as deep as `ratio` - 1 times their near boundary.
Tiling resolved_aspect(const Tiling& tiling, double ratio, const view::Projection& projection, Vec2i viewport);

struct Tiles {
  bool orthographic = false;
  Vec2i count{0, 0};
  Vec2i pixels{0, 0};  // of a tile that is not clipped; 0: a number per screen
  Vec2i viewport{0, 0};
  std::vector<float> x;  // count.x + 1 tile planes, ascending: slopes x/depth (perspective) or metres (orthographic)
  std::vector<float> y;  // count.y + 1 tile planes from the top: DEscending slopes y/depth or metres
  // The shader's lookup: tile = int(pixel * scale).
  float scale_x = 0.0f, scale_y = 0.0f;

  float y_min(int row) const { return y[static_cast<std::size_t>(row) + 1]; }
  float y_max(int row) const { return y[static_cast<std::size_t>(row)]; }
  // Tile of a pixel position (origin top left, pixel centres at .5), clamped to the grid.
  Vec2i tile_of(float pixel_x, float pixel_y) const;
  // Whether a position lies in the picture, its edges included. False for NaN, a point behind the eye.
  bool shows(float pixel_x, float pixel_y) const {
    return pixel_x >= 0.0f && pixel_x <= static_cast<float>(viewport.x) && pixel_y >= 0.0f &&
           pixel_y <= static_cast<float>(viewport.y);
  }
};

// Throws Error (where = "tiles.pixels" or "tiles.count") for sizes below 1 or more tiles than pixels.
Tiles make_tiles(const Tiling& tiling, const view::Projection& projection, Vec2i viewport);

}  // namespace clusterbench::grid
