#include "grid/tiling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/random.h"

namespace clusterbench::grid {
namespace {

constexpr float k_float_infinity = std::numeric_limits<float>::infinity();

double tan_of_degrees(double angle) {
  return std::tan(angle * std::acos(-1.0) / 180.0);
}

// One eye of a headset: nothing about it is symmetric.
const view::Projection k_left_eye{
    false, -tan_of_degrees(54.0), tan_of_degrees(40.0), -tan_of_degrees(55.0), tan_of_degrees(44.0), 0.1, 100.0};
const view::Projection k_off_centre_box{true, -20.0, 30.0, -10.0, 15.0, 0.0, 100.0};
const Vec2i k_viewports[] = {{1366, 768}, {1000, 700}, {1, 1}, {7680, 4320}, {640, 360}};

// A symmetric projection for a viewport of square pixels.
view::Projection projection_of(double fov_degrees, Vec2i viewport) {
  const double top = tan_of_degrees(fov_degrees / 2.0), right = top * viewport.x / viewport.y;
  return {false, -right, right, -top, top, 0.1, 100.0};
}

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// The image position in pixels of a tile plane: the way back from slope to pixel.
double pixel_of(float plane, double first, double last, int pixels) {
  return (static_cast<double>(plane) - first) / (last - first) * pixels;
}

// What rounding a plane of this size to single precision can move, in pixels.
double rounding_px(float plane, double first, double last, int pixels) {
  return std::abs(static_cast<double>(std::nextafter(plane, k_float_infinity)) - static_cast<double>(plane)) /
         std::abs(last - first) * pixels;
}

// One axis of a tiling by pixels: whole tiles from the first pixel on, and the rest in the last one.
void expect_whole_tiles_and_a_rest(const std::vector<float>& planes, int tile, double first, double last, int pixels) {
  ASSERT_GE(planes.size(), 2u);
  const int whole = pixels / tile, rest = pixels % tile;
  ASSERT_EQ(static_cast<int>(planes.size()) - 1, rest == 0 ? whole : whole + 1);
  for (int i = 0; i <= whole; ++i) {
    const float plane = planes[at(i)];
    EXPECT_NEAR(pixel_of(plane, first, last, pixels), i * tile, rounding_px(plane, first, last, pixels));
  }
  EXPECT_NEAR(pixel_of(planes.back(), first, last, pixels), pixels, rounding_px(planes.back(), first, last, pixels));
}

TEST(Tiling, by_pixels_clips_the_last_column_and_row_to_the_viewport) {
  for (const Vec2i viewport : k_viewports)
    for (const Vec2i pixels : {Vec2i{64, 64}, Vec2i{1, 1}, Vec2i{8, 128}, Vec2i{49, 30}, Vec2i{9000, 9000}})
      for (const view::Projection& projection : {k_left_eye, k_off_centre_box, projection_of(60.0, viewport)}) {
        SCOPED_TRACE(std::to_string(viewport.x) + " by " + std::to_string(pixels.x));
        const Tiles tiles = make_tiles({.pixels = pixels, .count = {0, 0}}, projection, viewport);
        EXPECT_EQ(Vec2i(tiles.x.size() - 1, tiles.y.size() - 1), tiles.count);
        EXPECT_EQ(tiles.viewport, viewport);
        expect_whole_tiles_and_a_rest(tiles.x, pixels.x, projection.left, projection.right, viewport.x);
        expect_whole_tiles_and_a_rest(tiles.y, pixels.y, projection.top, projection.bottom, viewport.y);
      }
}

TEST(Tiling, by_count_cuts_between_pixels_where_the_count_does_not_divide) {
  const Tiles tiles = make_tiles({.pixels = {0, 0}, .count = {12, 7}}, k_left_eye, {1366, 768});
  for (int i = 0; i <= 12; ++i)
    EXPECT_NEAR(pixel_of(tiles.x[at(i)], k_left_eye.left, k_left_eye.right, 1366), 1366.0 * i / 12.0, 1e-3);
  for (int i = 0; i <= 7; ++i)
    EXPECT_NEAR(pixel_of(tiles.y[at(i)], k_left_eye.top, k_left_eye.bottom, 768), 768.0 * i / 7.0, 1e-3);
}

TEST(Tiling, encloses_the_view_by_less_than_one_step_of_single_precision) {
  SplitMix64 random(11);
  for (int i = 0; i < 2000; ++i) {
    view::Projection projection = k_left_eye;
    projection.left = random.between(-3.0, -0.1);
    projection.right = random.between(0.1, 3.0);
    projection.top = random.between(0.1, 3.0);
    projection.bottom = random.between(-3.0, -0.1);
    const Tiles tiles = make_tiles({.pixels = {64, 64}, .count = {0, 0}}, projection, {1000, 700});
    EXPECT_LE(tiles.x.front(), projection.left);
    EXPECT_GE(tiles.x.back(), projection.right);
    EXPECT_GE(tiles.y.front(), projection.top);
    EXPECT_LE(tiles.y.back(), projection.bottom);
    EXPECT_GT(std::nextafter(tiles.x.front(), k_float_infinity), projection.left);
    EXPECT_LT(std::nextafter(tiles.x.back(), -k_float_infinity), projection.right);
    EXPECT_LT(std::nextafter(tiles.y.front(), -k_float_infinity), projection.top);
    EXPECT_GT(std::nextafter(tiles.y.back(), k_float_infinity), projection.bottom);
  }
}

TEST(Tiling, numbers_rows_from_the_top_of_the_image_where_y_is_largest) {
  const Tiles tiles = make_tiles({.pixels = {64, 64}, .count = {0, 0}}, k_left_eye, {640, 360});
  for (int row = 0; row < tiles.count.y; ++row) {
    EXPECT_LT(tiles.y_min(row), tiles.y_max(row));
    EXPECT_EQ(tiles.y_max(row), row == 0 ? tiles.y.front() : tiles.y_min(row - 1)) << "no gap between rows";
  }
  EXPECT_FLOAT_EQ(tiles.y_max(0), static_cast<float>(k_left_eye.top));
  EXPECT_EQ(tiles.tile_of(320.0f, 0.5f).y, 0);
  EXPECT_EQ(tiles.tile_of(320.0f, 359.5f).y, 5);
}

TEST(Tiling, cuts_down_the_image_as_across_it) {
  const view::Projection square{false, -0.7, 1.3, -1.3, 0.7, 0.1, 100.0};  // top to bottom is left to right, mirrored
  for (const int tile : {64, 49, 1}) {
    const Tiles tiles = make_tiles({.pixels = {tile, tile}, .count = {0, 0}}, square, {1000, 1000});
    for (std::size_t i = 0; i < tiles.x.size(); ++i) EXPECT_EQ(tiles.y[i], -tiles.x[i]);
    EXPECT_EQ(tiles.scale_x, tiles.scale_y);
  }
}

TEST(Tiling, of_the_other_eye_is_the_mirror_image) {
  view::Projection right_eye = k_left_eye;
  right_eye.left = -k_left_eye.right;
  right_eye.right = -k_left_eye.left;
  const Tiling tiling{.pixels = {0, 0}, .count = {31, 17}};
  const Tiles left = make_tiles(tiling, k_left_eye, {1366, 768});
  const Tiles right = make_tiles(tiling, right_eye, {1366, 768});
  EXPECT_EQ(left.y, right.y);
  for (int i = 0; i <= 31; ++i) EXPECT_FLOAT_EQ(right.x[at(i)], -left.x[at(31 - i)]);
}

TEST(Tiling, moves_with_a_projection_that_is_jittered_by_half_a_pixel) {
  const Vec2i viewport{1366, 768};
  const view::Projection still = projection_of(60.0, viewport);
  const double half_pixel = (still.right - still.left) / viewport.x / 2.0;
  view::Projection moved = still;
  moved.left += half_pixel;
  moved.right += half_pixel;
  const Tiling tiling;
  const Tiles before = make_tiles(tiling, still, viewport), after = make_tiles(tiling, moved, viewport);
  EXPECT_EQ(before.y, after.y);
  for (std::size_t i = 0; i < before.x.size(); ++i)
    EXPECT_NEAR(static_cast<double>(after.x[i]) - static_cast<double>(before.x[i]), half_pixel, 3e-7);
}

TEST(Tiling, holds_for_extreme_fields_of_view_and_aspect_ratios) {
  for (const Vec2i viewport : {Vec2i{1366, 768}, Vec2i{6400, 64}, Vec2i{64, 6400}})
    for (const double fov : {0.1, 1.0, 170.0, 179.0})
      for (const int tile : {64, 1}) {
        const view::Projection projection = projection_of(fov, viewport);
        const Tiles tiles = make_tiles({.pixels = {tile, tile}, .count = {0, 0}}, projection, viewport);
        for (int i = 0; i < tiles.count.x; ++i) EXPECT_LT(tiles.x[at(i)], tiles.x[at(i) + 1]);
        for (int i = 0; i < tiles.count.y; ++i) EXPECT_LT(tiles.y_min(i), tiles.y_max(i));
      }
}

// A pixel centre is half a pixel from the nearest edge of such tiles, so its lookup has to be exact.
TEST(Lookup, of_every_pixel_centre_is_the_whole_quotient_of_pixel_and_tile_size) {
  const Vec2i viewport{7680, 4320};
  for (int tile = 1; tile <= 300; ++tile) {
    const Tiles tiles = make_tiles({.pixels = {tile, tile}, .count = {0, 0}}, projection_of(60.0, viewport), viewport);
    int wrong = 0;
    for (int pixel = 0; pixel < viewport.x; ++pixel) {
      const float center = static_cast<float>(pixel) + 0.5f;
      const int row_pixel = pixel % viewport.y;
      wrong += tiles.tile_of(center, static_cast<float>(row_pixel) + 0.5f) != Vec2i(pixel / tile, row_pixel / tile);
    }
    EXPECT_EQ(wrong, 0) << "tiles of " << tile << " pixels";
  }
}

// Tiles by count end anywhere between pixel centres. Where the centre is on the edge itself, or nearer to it than
// single precision tells, either neighbour is right.
void expect_tile_of_centre(const Tiles& tiles, int pixel) {
  const std::int64_t twice = 2ll * tiles.viewport.x, share = (2ll * pixel + 1) * tiles.count.x;
  const auto expected = static_cast<int>(share / twice);
  const int found = tiles.tile_of(static_cast<float>(pixel) + 0.5f, 0.5f).x;
  if (found == expected) return;
  const std::int64_t past = share % twice;
  const std::int64_t to_edge = found < expected ? past : twice - past;
  EXPECT_EQ(std::abs(found - expected), 1);
  EXPECT_LE(static_cast<double>(to_edge), std::ldexp(static_cast<double>(share), -22))
      << "pixel " << pixel << " of " << tiles.viewport.x << ", " << tiles.count.x << " tiles";
}

TEST(Lookup, of_every_pixel_centre_agrees_with_whole_numbers_for_counts_that_do_not_divide) {
  for (const Vec2i viewport : k_viewports)
    for (const int count : {1, 7, 12, 16, 30, 61, 256, 683, 1000}) {
      if (count > viewport.x) continue;
      const Tiles tiles = make_tiles({.pixels = {0, 0}, .count = {count, 1}}, projection_of(60.0, viewport), viewport);
      for (int pixel = 0; pixel < viewport.x; ++pixel) expect_tile_of_centre(tiles, pixel);
    }
}

// How far a place is outside of the tile between two planes; negative inside.
double outside(double place, float plane, float next) {
  const auto low = static_cast<double>(std::min(plane, next)), high = static_cast<double>(std::max(plane, next));
  return std::max(low - place, place - high);
}

TEST(Lookup, of_any_place_in_the_image_is_the_one_tile_whose_planes_enclose_it) {
  SplitMix64 random(12);
  for (const Vec2i viewport : k_viewports)
    for (const Tiling& tiling : {Tiling{{64, 64}, {0, 0}}, Tiling{{49, 30}, {0, 0}}, Tiling{{0, 0}, {1, 1}},
                                 Tiling{{0, 0}, glm::min(viewport, Vec2i{61, 37})}}) {
      const Tiles tiles = make_tiles(tiling, k_left_eye, viewport);
      for (int i = 0; i < 2000; ++i) {
        const double px = random.between(0.0, viewport.x), py = random.between(0.0, viewport.y);
        const double x = k_left_eye.left + (k_left_eye.right - k_left_eye.left) * px / viewport.x;
        const double y = k_left_eye.top + (k_left_eye.bottom - k_left_eye.top) * py / viewport.y;
        const Vec2i tile = tiles.tile_of(static_cast<float>(px), static_cast<float>(py));
        // Slopes near 1 and pixels near 7680 are both good to a few parts in 10^7 of the image's width.
        constexpr double k_rounding = 1e-6;
        EXPECT_LT(outside(x, tiles.x[at(tile.x)], tiles.x[at(tile.x) + 1]), k_rounding);
        EXPECT_LT(outside(y, tiles.y[at(tile.y)], tiles.y[at(tile.y) + 1]), k_rounding);
      }
    }
}

TEST(Lookup, beside_the_viewport_is_clamped_and_never_wraps_to_the_next_row) {
  for (const Vec2i viewport : k_viewports) {
    const Tiles tiles = make_tiles({}, projection_of(60.0, viewport), viewport);
    const Vec2i last = tiles.count - 1;
    const auto width = static_cast<float>(viewport.x), height = static_cast<float>(viewport.y);
    EXPECT_EQ(tiles.tile_of(width, height), last);
    EXPECT_EQ(tiles.tile_of(width + 64.0f, 0.0f), Vec2i(last.x, 0));
    EXPECT_EQ(tiles.tile_of(-64.0f, height + 1.0f), Vec2i(0, last.y));
    EXPECT_EQ(tiles.tile_of(-0.5f, -0.5f), Vec2i(0, 0));
    EXPECT_EQ(tiles.tile_of(width, -64.0f), Vec2i(last.x, 0));
  }
}

// The key that is named when such tiles are refused.
std::string refused_key(const Tiling& tiling, Vec2i viewport, const view::Projection& projection = k_left_eye) {
  try {
    make_tiles(tiling, projection, viewport);
  } catch (const Error& error) {
    return error.where();
  }
  return "not refused";
}

TEST(Tiling, that_cannot_be_is_refused_by_its_key) {
  const Vec2i viewport{640, 360};
  for (const Vec2i pixels : {Vec2i{0, 64}, Vec2i{64, 0}, Vec2i{-64, 64}, Vec2i{0, 0}})
    EXPECT_EQ(refused_key({pixels, {0, 0}}, viewport), "tiles.pixels");
  for (const Vec2i count : {Vec2i{641, 1}, Vec2i{1, 361}, Vec2i{8, 0}, Vec2i{0, 8}, Vec2i{-1, 8}, Vec2i{8, -1}})
    EXPECT_EQ(refused_key({{64, 64}, count}, viewport), "tiles.count");
  EXPECT_EQ(refused_key({{0, 0}, {640, 360}}, viewport), "not refused");
  for (const Vec2i nothing : {Vec2i{0, 360}, Vec2i{640, 0}, Vec2i{-1, -1}})
    EXPECT_EQ(refused_key({}, nothing), "viewport");
}

TEST(Tiling, whose_planes_coincide_in_single_precision_is_refused) {
  // 640 tiles over 1 m, 10,000 km from the axis, where numbers of single precision are a metre apart.
  const view::Projection far_aside{true, 1e7, 1e7 + 1.0, -1.0, 1.0, 0.0, 100.0};
  EXPECT_EQ(refused_key({{1, 64}, {0, 0}}, {640, 360}, far_aside), "tiles");
  EXPECT_EQ(refused_key({{640, 64}, {0, 0}}, {640, 360}, far_aside), "not refused");
}

}  // namespace
}  // namespace clusterbench::grid
