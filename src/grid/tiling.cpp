#include "grid/tiling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"

namespace clusterbench::grid {
namespace {

// Pixel position of edge i of `count` tiles. Tiles of a size in pixels are clipped at the last one.
double edge_pixel(int i, int count, int tile_pixels, int viewport_pixels) {
  if (i == count) return viewport_pixels;
  if (tile_pixels > 0) return static_cast<double>(i) * tile_pixels;
  return static_cast<double>(viewport_pixels) * i / count;
}

// Tile planes from `from` (pixel 0) to `to` (the last pixel's far edge); the outermost ones are rounded outward, so
// that no point of the view lies outside of the grid.
std::vector<float> tile_planes(int count, int tile_pixels, int viewport_pixels, double from, double to) {
  const bool ascending = from < to;
  constexpr float k_infinity = std::numeric_limits<float>::infinity();
  std::vector<float> planes;
  for (int i = 0; i <= count; ++i) {
    const double at = from + (to - from) * edge_pixel(i, count, tile_pixels, viewport_pixels) / viewport_pixels;
    auto plane = static_cast<float>(at);
    if (i == 0 && (ascending ? plane > from : plane < from))
      plane = std::nextafter(plane, ascending ? -k_infinity : k_infinity);
    if (i == count && (ascending ? plane < to : plane > to))
      plane = std::nextafter(plane, ascending ? k_infinity : -k_infinity);
    planes.push_back(plane);
  }
  for (int i = 0; i < count; ++i)
    if (ascending ? !(planes[static_cast<std::size_t>(i)] < planes[static_cast<std::size_t>(i) + 1])
                  : !(planes[static_cast<std::size_t>(i)] > planes[static_cast<std::size_t>(i) + 1]))
      throw Error("", "tiles", "are too narrow: two tile planes coincide in single precision");
  return planes;
}

void check(const char* key, const char* direction, int tiles, int viewport_pixels) {
  if (tiles < 1) throw Error("", key, "is " + std::to_string(tiles) + " " + direction + "; allowed: 1 or more");
  if (tiles > viewport_pixels)
    throw Error("", key,
                "gives " + std::to_string(tiles) + " tiles along " + std::to_string(viewport_pixels) +
                    " pixels; at most one tile per pixel " + direction);
}

}  // namespace

Vec2i Tiles::tile_of(float pixel_x, float pixel_y) const {
  return {std::clamp(static_cast<int>(pixel_x * scale_x), 0, count.x - 1),
          std::clamp(static_cast<int>(pixel_y * scale_y), 0, count.y - 1)};
}

double tile_height(const Tiling& tiling, const view::Projection& projection, Vec2i viewport) {
  const double picture = projection.top - projection.bottom;
  if (tiling.count.y > 0) return picture / tiling.count.y;
  return picture * tiling.pixels.y / viewport.y;
}

Tiling resolved_aspect(const Tiling& tiling, double ratio, const view::Projection& projection, Vec2i viewport) {
  const double picture = projection.top - projection.bottom;
  const double rows =
      std::round(std::clamp(picture * tiling.aspect / (ratio - 1.0), 1.0, static_cast<double>(viewport.y)));
  const double columns = std::round(rows * viewport.x / viewport.y);
  const auto whole = [](double tiles, int pixels) { return std::clamp(static_cast<int>(tiles), 1, pixels); };
  return {{0, 0}, {whole(columns, viewport.x), whole(rows, viewport.y)}, 0.0};
}

Vec2i tile_counts(const Tiling& tiling, Vec2i viewport) {
  if (tiling.is_by_count()) return tiling.count;
  const auto rounded_up = [](int pixels, int tile) { return (pixels - 1) / tile + 1; };  // any tile: none overflows
  return {rounded_up(viewport.x, tiling.pixels.x), rounded_up(viewport.y, tiling.pixels.y)};
}

Tiles make_tiles(const Tiling& tiling, const view::Projection& projection, Vec2i viewport) {
  const bool by_count = tiling.is_by_count();
  const char* key = by_count ? "tiles.count" : "tiles.pixels";
  const Vec2i pixels = by_count ? Vec2i{0, 0} : tiling.pixels;
  if (viewport.x < 1 || viewport.y < 1) throw Error("", "viewport", "must be at least 1 x 1 pixels");
  if (!by_count && (pixels.x < 1 || pixels.y < 1))
    throw Error("", key,
                "is " + std::to_string(pixels.x) + " x " + std::to_string(pixels.y) + "; allowed: 1 or more each");

  Tiles tiles;
  tiles.orthographic = projection.orthographic;
  tiles.pixels = pixels;
  tiles.viewport = viewport;
  tiles.count = tile_counts(tiling, viewport);
  check(key, "across", tiles.count.x, viewport.x);
  check(key, "down", tiles.count.y, viewport.y);
  tiles.x = tile_planes(tiles.count.x, pixels.x, viewport.x, projection.left, projection.right);
  tiles.y = tile_planes(tiles.count.y, pixels.y, viewport.y, projection.top, projection.bottom);
  tiles.scale_x = by_count ? static_cast<float>(tiles.count.x) / static_cast<float>(viewport.x)
                           : 1.0f / static_cast<float>(pixels.x);
  tiles.scale_y = by_count ? static_cast<float>(tiles.count.y) / static_cast<float>(viewport.y)
                           : 1.0f / static_cast<float>(pixels.y);
  return tiles;
}

}  // namespace clusterbench::grid
