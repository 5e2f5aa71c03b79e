#include "measure/samples/lookup_check.h"
#include "geom/filter/light_filter.h"
#include "geom/shapes/verdict.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "assign/dense_check.h"
#include "core/random.h"
#include "measure/samples/shading.h"

#include "measure/packed_lists.h"

namespace clusterbench::measure {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

view::Frame frame_with(std::vector<scene::WorldLight> lights, double far_m = 500) {
  return assign::testing::frame_of(assign::testing::perspective(M_PI / 3, 1366.0 / 768, 0.1, far_m), {1366, 768},
                                   std::move(lights));
}

grid::GridSpec spec_of(grid::Scheme scheme, int count) {
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, {12, 12}};
  spec.slices.scheme = scheme;
  spec.slices.count = count;
  spec.slices.near_m = 0.1;
  spec.slices.far_m = 400;
  return spec;
}

grid::Grid grid_for(const grid::GridSpec& spec, const view::Frame& frame) {
  return grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
}

std::vector<scene::WorldLight> many_lights() {
  std::vector<scene::WorldLight> lights;
  SplitMix64 random(8);
  for (int i = 0; i < 150; ++i) {
    const double depth = 0.5 + 120.0 * random.unit(), x = random.between(-0.8, 0.8), y = random.between(-0.5, 0.5);
    lights.push_back(assign::testing::point_light({x * depth, y * depth, -depth}, 0.05 * depth));
  }
  return lights;
}

TEST(Logarithm, of_glsl_brackets_the_rounded_one_by_three_ulps) {
  for (const float value : {1e-3f, 0.3f, 3.0f, 77.7f, 1e6f}) {
    const float middle = grid::log2_by(grid::Log2::rounded, value);
    float low = middle, high = middle;
    for (int i = 0; i < 3; ++i) {
      low = std::nextafter(low, -1e9f);
      high = std::nextafter(high, 1e9f);
    }
    EXPECT_EQ(grid::log2_by(grid::Log2::glsl_low, value), low);
    EXPECT_EQ(grid::log2_by(grid::Log2::glsl_high, value), high);
  }
  EXPECT_FLOAT_EQ(grid::log2_by(grid::Log2::glsl_high, 1.0f), 0x1p-21f);
}

TEST(Logarithm, that_is_fast_is_off_by_up_to_0_005) {
  double worst = 0.0;
  for (float value = 0.01f; value < 1000.0f; value *= 1.0003f)
    worst = std::max(worst, std::abs(static_cast<double>(grid::log2_by(grid::Log2::fast, value)) - std::log2(value)));
  EXPECT_LT(worst, 0.0051);
  EXPECT_GT(worst, 0.0045);
}

// Every depth around every boundary, one ulp after the other.
TEST(SafePadding, is_the_farthest_that_a_depth_lies_beyond_the_slice_that_it_is_looked_up_in) {
  const view::Frame frame = frame_with({});
  for (const auto& [scheme, count] : {std::pair{grid::Scheme::exponential, 24},
                                      {grid::Scheme::exponential, 64},
                                      {grid::Scheme::exponential_first, 16},
                                      {grid::Scheme::linear, 32}})
    for (const grid::Log2 way : {grid::Log2::rounded, grid::Log2::glsl_low, grid::Log2::glsl_high}) {
      const grid::Slices slices = grid_for(spec_of(scheme, count), frame).screen().slices;
      std::int64_t farthest = 0;
      for (int k = 1; k < slices.count(); ++k) {
        const float boundary = slices.boundaries[static_cast<std::size_t>(k)];
        float below = boundary, above = boundary;
        for (int ulps = 0; ulps < 400; ++ulps) {
          if (slices.slice_of(below, way) >= k && ulps > 0) farthest = std::max<std::int64_t>(farthest, ulps);
          if (slices.slice_of(above, way) < k) farthest = std::max<std::int64_t>(farthest, ulps + 1);
          below = std::nextafter(below, 0.0f);
          above = std::nextafter(above, 1e9f);
        }
      }
      EXPECT_EQ(grid::safe_padding_ulps(slices, way), farthest) << count << " slices, way " << static_cast<int>(way);
    }
}

TEST(DepthBuffer, gives_back_depths_within_its_steps) {
  view::Projection projection = assign::testing::perspective(M_PI / 3, 1.5, 0.1, 500);
  for (const double far : {500.0, k_infinity}) {
    projection.far_m = far;
    for (double depth = 0.1; depth < 499; depth *= 1.01) {
      // Reversed floats keep their digits far away; the reconstruction is in single precision.
      EXPECT_NEAR(read_depth(projection, DepthRead::d32f, depth) / depth, 1.0, 4e-7) << depth;
      // 24-bit steps of near / depth: an error of depth² / near / 2^25.
      EXPECT_NEAR(read_depth(projection, DepthRead::d24, depth), depth, depth * depth / 0.1 * 0x1p-24 + 4e-7 * depth)
          << depth;
    }
    EXPECT_NEAR(read_depth(projection, DepthRead::d32f, 0.05), 0.1, 1e-7) << "in front of near";
  }
  projection.orthographic = true;
  projection.far_m = 200;
  EXPECT_NEAR(read_depth(projection, DepthRead::d32f, 73.0), 73.0, 2e-5);
  EXPECT_NEAR(read_depth(projection, DepthRead::d24, 73.0), 73.0, 2e-5);
}

TEST(Lookup, misses_nothing_where_it_is_rounded_and_lights_where_it_is_fast) {
  const view::Frame frame = frame_with(many_lights());
  const grid::Grid grid = grid_for(spec_of(grid::Scheme::exponential, 64), frame);
  const std::vector<LookupWay> ways{
      {Logarithm::rounded, DepthRead::given}, {Logarithm::glsl, DepthRead::given}, {Logarithm::fast, DepthRead::given}};
  std::vector<LookupCounts> counts;
  LookupFrame(frame, grid, ways, 150, 20000, 3)
      .add(*packed_lists(find_truth(frame, grid, 1).lists, grid, frame), counts);
  ASSERT_EQ(counts.size(), 3U);
  EXPECT_GT(counts[0].needed, 1000U);
  EXPECT_EQ(counts[0].missed, 0U);
  EXPECT_GT(counts[2].missed, 0U);
  EXPECT_GE(counts[2].missed, counts[2].wrong_samples);
  EXPECT_LT(counts[0].safe_padding_ulps, counts[1].safe_padding_ulps);
  EXPECT_LT(counts[1].safe_padding_ulps, counts[2].safe_padding_ulps);
}

// Lists of cells that reach over their slice boundaries by the padding lack nothing.
TEST(Lookup, is_safe_with_slices_that_are_padded_by_what_it_says) {
  const view::Frame frame = frame_with(many_lights());
  const grid::Grid grid = grid_for(spec_of(grid::Scheme::exponential, 64), frame);
  const grid::Slices& slices = grid.screen().slices;
  const double padding = static_cast<double>(grid::safe_padding_ulps(slices, grid::Log2::fast)) * 0x1p-23;
  assign::Lists padded;
  padded.begin.push_back(0);
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
    auto widened = std::get<geom::FrustumCell>(grid.cell(cell));
    widened.depth0 = static_cast<float>(widened.depth0 * (1.0 - padding));
    widened.depth1 = static_cast<float>(widened.depth1 * (1.0 + padding));
    for (std::uint32_t light = 0; light < frame.lights.size(); ++light)
      if (geom::filter_meets(view::volume_of(frame.lights[light], frame.view_space), widened) != geom::Verdict::no)
        padded.lights.push_back(light);
    padded.begin.push_back(padded.pair_count());
  }
  std::vector<LookupCounts> counts;
  LookupFrame(frame, grid, {{Logarithm::fast, DepthRead::given}}, 150, 20000, 3)
      .add(*packed_lists(padded, grid, frame), counts);
  EXPECT_GT(counts[0].needed, 1000U);
  EXPECT_EQ(counts[0].missed, 0U);
}

TEST(Lookup, counts_a_light_that_a_list_lacks_once_per_sample) {
  const view::Frame frame = frame_with({assign::testing::point_light({0, 0, -10}, 1e4)});
  const grid::Grid grid = grid_for(spec_of(grid::Scheme::linear, 16), frame);
  assign::Lists none;
  none.begin.assign(grid.cell_count() + 1, 0);
  std::vector<LookupCounts> counts;
  LookupFrame(frame, grid, {{Logarithm::rounded, DepthRead::d32f}}, 300, 900, 3)
      .add(*packed_lists(none, grid, frame), counts);
  EXPECT_EQ(counts[0].missed, counts[0].needed);
  EXPECT_EQ(counts[0].wrong_samples, counts[0].samples);
}

}  // namespace
}  // namespace clusterbench::measure
