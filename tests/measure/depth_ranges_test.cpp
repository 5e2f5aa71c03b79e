// Depth that lists cover, against figures by hand and a loop over all pairs of pixels.

#include "measure/samples/depth_ranges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/memory.h"
#include "core/random.h"
#include "measure/samples/samples.h"

namespace clusterbench::measure {
namespace {

constexpr float k_no_surface = std::numeric_limits<float>::infinity();
constexpr double k_far_m = 20.0;

view::Frame frame_of(Vec2i viewport, bool orthographic) {
  view::Frame frame;
  frame.viewport = viewport;
  frame.projection = {orthographic, -1.0, 1.0, -1.0, 1.0, 0.5, k_far_m};
  return frame;
}

// Slices 1 to 2, 4, 8 and 16 m; tiles of 32 x 32 pixels.
grid::ScreenGrid octaves(const view::Frame& frame) {
  grid::GridSpec spec;
  spec.tiles = {{32, 32}, {0, 0}};
  spec.slices.scheme = grid::Scheme::list;
  spec.slices.boundaries_m = {1.0, 2.0, 4.0, 8.0, 16.0};
  return grid::make_grid(spec, grid::grid_inputs(spec, frame, k_far_m, Vec3d(0.0), Vec3d(0.0))).screen();
}

// A picture whose depths are a function of pixel column and row.
template <class Depth>
DepthRanges ranges_of(Vec2i viewport, bool orthographic, const Depth& depth) {
  const view::Frame frame = frame_of(viewport, orthographic);
  depth::DepthImage image{depth::PixelGrid(viewport, 1), {}};
  for (int y = 0; y < viewport.y; ++y)
    for (int x = 0; x < viewport.x; ++x) image.nearest.push_back(depth(x, y));
  DepthRanges ranges;
  add_frame(ranges, image, opaque_samples(frame, image), octaves(frame));
  return ranges;
}

double mean_m(const DepthRanges::Tiles& tiles, ListKind kind) {
  return tiles.lengths[static_cast<std::size_t>(kind)].mean_m();
}

TEST(DepthRanges, at_a_discontinuity_tiles_cover_what_is_between_and_clusters_one_side) {
  const DepthRanges ranges = ranges_of({32, 32}, false, [](int x, int) { return x < 16 ? 3.0f : 12.0f; });
  EXPECT_EQ(ranges.slopes.tiles, 0u);
  const DepthRanges::Tiles& tiles = ranges.discontinuities;
  EXPECT_EQ(tiles.tiles, 1u);
  EXPECT_EQ(tiles.pixels, 1024u);
  EXPECT_DOUBLE_EQ(mean_m(tiles, ListKind::tiled), 9.0);
  EXPECT_DOUBLE_EQ(mean_m(tiles, ListKind::tiled_2_5d), 2.0 * 9.0 / 32.0);
  EXPECT_DOUBLE_EQ(mean_m(tiles, ListKind::clusters), (2.0 + 8.0) / 2.0);
  EXPECT_DOUBLE_EQ(mean_m(tiles, ListKind::explicit_clusters), 0.0);
}

TEST(DepthRanges, on_a_slope_tiles_cover_all_of_it_with_a_mask_or_without) {
  const DepthRanges ranges =
      ranges_of({32, 32}, true, [](int x, int) { return 2.0f + 0.25f * static_cast<float>(x); });  // 2 to 9.75 m
  EXPECT_EQ(ranges.discontinuities.tiles, 0u);
  const DepthRanges::Tiles& tiles = ranges.slopes;
  EXPECT_DOUBLE_EQ(mean_m(tiles, ListKind::tiled), 7.75);
  EXPECT_DOUBLE_EQ(mean_m(tiles, ListKind::tiled_2_5d), 7.75);
  EXPECT_DOUBLE_EQ(mean_m(tiles, ListKind::clusters), (8 * 2.0 + 16 * 4.0 + 8 * 8.0) / 32.0);
  EXPECT_DOUBLE_EQ(mean_m(tiles, ListKind::explicit_clusters), (8 * 1.75 + 16 * 3.75 + 8 * 1.75) / 32.0);
}

// Along a plane it is 1 / depth that changes evenly: a floor reaches from 1 m to 15 m in one tile without a gap.
TEST(DepthRanges, a_plane_is_a_slope_however_it_lies) {
  const auto floor = [](int, int y) { return 1.0f / (1.0f - static_cast<float>(y) * (14.0f / 15.0f / 31.0f)); };
  EXPECT_EQ(ranges_of({32, 32}, false, floor).slopes.tiles, 1u);
  EXPECT_EQ(ranges_of({32, 32}, true, floor).discontinuities.tiles, 1u)
      << "the same depths are no plane without perspective";
  EXPECT_EQ(ranges_of({32, 32}, false, [](int, int) { return 5.0f; }).slopes.tiles, 1u);
}

// A ray for each 8 or 16 pixels leaves four or two across a tile; a gap is more than one step of a slope all the same.
TEST(DepthRanges, a_slope_stays_one_and_a_gap_another_with_few_rays_in_a_tile) {
  using Splits = std::pair<std::uint64_t, std::uint64_t>;
  const auto split = [](int divisor, const auto& depth) {
    const view::Frame frame = frame_of({32, 32}, true);
    depth::DepthImage image{depth::PixelGrid(frame.viewport, divisor), {}};
    for (int y = 0; y < 32 / divisor; ++y)
      for (int x = 0; x < 32 / divisor; ++x) image.nearest.push_back(depth(x * divisor));
    DepthRanges ranges;
    add_frame(ranges, image, opaque_samples(frame, image), octaves(frame));
    return Splits(ranges.slopes.tiles, ranges.discontinuities.tiles);
  };
  const auto slope = [](int x) { return 2.0f + 0.25f * static_cast<float>(x); };
  const auto gap = [](int x) { return x < 16 ? 3.0f : 12.0f; };
  for (const int divisor : {1, 2, 4, 8, 16, 32}) EXPECT_EQ(split(divisor, slope), Splits(1, 0)) << divisor;
  for (const int divisor : {1, 2, 4, 8}) EXPECT_EQ(split(divisor, gap), Splits(0, 1)) << divisor;
}

TEST(DepthRanges, sky_and_what_lies_beside_the_grid_cover_nothing) {
  const auto depth = [](int x, int) { return x < 8 ? k_no_surface : x < 16 ? 18.0f : 3.0f; };
  const DepthRanges ranges = ranges_of({32, 32}, false, depth);
  EXPECT_EQ(ranges.outside, 8u * 32u);
  EXPECT_EQ(ranges.slopes.pixels, 16u * 32u);
  EXPECT_DOUBLE_EQ(mean_m(ranges.slopes, ListKind::tiled), 0.0);
  EXPECT_TRUE(std::isnan(mean_m(ranges.discontinuities, ListKind::tiled)));
}

// --- Against a loop over all pairs of pixels ---

double exact_length(const std::vector<float>& depths, int parts) {
  const auto [low, high] = std::minmax_element(depths.begin(), depths.end());
  const double near = static_cast<double>(*low), length = static_cast<double>(*high) - near;
  if (parts == 0 || length == 0.0) return length;
  int occupied = 0;
  for (int part = 0; part < parts; ++part)
    occupied += std::any_of(depths.begin(), depths.end(), [&](float depth) {
      return std::min(parts - 1, static_cast<int>(parts * ((static_cast<double>(depth) - near) / length))) == part;
    });
  return occupied * (length / parts);
}

TEST(DepthRanges, take_no_more_memory_than_the_limit) {
  const view::Frame frame = frame_of({32, 32}, false);
  const depth::DepthImage image{depth::PixelGrid(frame.viewport, 1), std::vector<float>(1024, 3.0f)};
  const std::vector<grid::Sample> samples = opaque_samples(frame, image);
  DepthRanges ranges;
  {
    const MemoryLimitScope little(1024 * 16 - 1);  // 16 bytes for each pixel
    EXPECT_THROW(add_frame(ranges, image, samples, octaves(frame)), Error);
  }
  const MemoryLimitScope enough(1024 * 16);
  EXPECT_NO_THROW(add_frame(ranges, image, samples, octaves(frame)));
}

TEST(DepthRanges, are_those_of_a_loop_over_all_pixels) {
  SplitMix64 random(7);
  for (int round = 0; round < 20; ++round) {
    const Vec2i size{80, 48};
    std::vector<float> depths(static_cast<std::size_t>(size.x * size.y));
    const double roughness = random.unit();
    for (float& depth : depths)
      depth = random.unit() < 0.1 ? k_no_surface
                                  : static_cast<float>(3.0 + (random.unit() < roughness ? 12.0 * random.unit() : 0.0));
    const auto depth_at = [&](int x, int y) { return depths[static_cast<std::size_t>(y * size.x + x)]; };
    const auto tile = [&](int x, int y) { return y / 32 * 3 + x / 32; };
    const auto slice = [](float depth) { return depth < 4.0f ? 1 : depth < 8.0f ? 2 : 3; };
    double tiled = 0.0, masked = 0.0, tight = 0.0;
    std::uint64_t pixels = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        if (std::isinf(depth_at(x, y))) continue;
        std::vector<float> in_tile, in_cell;
        for (int v = 0; v < size.y; ++v)
          for (int u = 0; u < size.x; ++u) {
            if (std::isinf(depth_at(u, v)) || tile(u, v) != tile(x, y)) continue;
            in_tile.push_back(depth_at(u, v));
            if (slice(depth_at(u, v)) == slice(depth_at(x, y))) in_cell.push_back(depth_at(u, v));
          }
        tiled += exact_length(in_tile, 0);
        masked += exact_length(in_tile, 32);
        tight += exact_length(in_cell, 0);
        ++pixels;
      }
    const DepthRanges ranges = ranges_of(size, false, depth_at);
    ASSERT_EQ(ranges.slopes.pixels + ranges.discontinuities.pixels, pixels);
    const auto sum = [&](ListKind kind) {
      double all = 0.0;
      for (const DepthRanges::Tiles* tiles : {&ranges.slopes, &ranges.discontinuities})
        if (tiles->pixels > 0) all += mean_m(*tiles, kind) * static_cast<double>(tiles->pixels);
      return all;
    };
    EXPECT_NEAR(sum(ListKind::tiled), tiled, 1e-9 * tiled);
    EXPECT_NEAR(sum(ListKind::tiled_2_5d), masked, 1e-9 * masked);
    EXPECT_NEAR(sum(ListKind::explicit_clusters), tight, 1e-9 * tight);
  }
}

TEST(LengthDistribution, quantiles_are_never_too_short_and_too_long_by_a_sixteenth_at_most) {
  SplitMix64 random(3);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> lengths(static_cast<std::size_t>(1 + random.below(300)));
    LengthDistribution distribution;
    for (double& length : lengths) {
      length = random.below(5) == 0 ? 0.0 : std::exp(random.between(-25.0, 25.0));
      distribution.add(length, 1);
    }
    std::sort(lengths.begin(), lengths.end());
    for (const double share : {0.01, 0.5, 0.9, 0.99, 1.0}) {
      const auto at = static_cast<std::size_t>(std::ceil(share * static_cast<double>(lengths.size()))) - 1;
      EXPECT_GE(distribution.quantile_m(share), lengths[at]);
      EXPECT_LE(distribution.quantile_m(share), lengths[at] * (1.0 + 1.0 / 16.0) + 1e-9);
    }
    EXPECT_DOUBLE_EQ(distribution.quantile_m(1.0), lengths.back());
    EXPECT_EQ(distribution.max_m(), lengths.back());
  }
  EXPECT_TRUE(std::isnan(LengthDistribution().quantile_m(0.5)));
}

}  // namespace
}  // namespace clusterbench::measure
