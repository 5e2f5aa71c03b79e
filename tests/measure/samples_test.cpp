// Where the points of each set lie.

#include "measure/samples/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/memory.h"

namespace clusterbench::measure {
namespace {

constexpr float k_sky = std::numeric_limits<float>::infinity();

// The eye at (3, 4, 5), turned so that it looks along +x.
view::Frame frame_of(bool orthographic = false) {
  view::Frame frame;
  frame.viewport = {160, 90};
  frame.projection.orthographic = orthographic;
  frame.projection.left = -1.6;
  frame.projection.right = 1.6;
  frame.projection.bottom = -0.9;
  frame.projection.top = 0.9;
  frame.projection.near_m = 0.5;
  frame.projection.far_m = 100.0;
  frame.view_space.origin = {3, 4, 5};
  frame.view_space.rotation = glm::transpose(Mat3d(Vec3d(0, 0, 1), Vec3d(0, 1, 0), Vec3d(-1, 0, 0)));
  return frame;
}

TEST(Samples, names_are_found_again) {
  for (std::size_t i = 0; i < k_sample_set_count; ++i) {
    const auto set = static_cast<SampleSet>(i);
    EXPECT_EQ(sample_set_named(name_of(set)), set);
  }
  EXPECT_FALSE(sample_set_named("sky"));
}

TEST(Samples, a_point_is_the_sample_of_the_pixel_that_shows_it) {
  for (const bool orthographic : {false, true}) {
    const view::Frame frame = frame_of(orthographic);
    const grid::Sample at = sample_at(frame, 40.0, 15.0, 7.0), of = sample_of(frame, at.from_eye);
    EXPECT_NEAR(of.pixel_x, 40.0f, 1e-4);
    EXPECT_NEAR(of.pixel_y, 15.0f, 1e-4);
    EXPECT_NEAR(of.view.z, -7.0f, 1e-5);
    EXPECT_EQ(of.eye, frame.view_space.origin);
  }
  EXPECT_TRUE(std::isnan(sample_of(frame_of(), {-1, 0, 0}).pixel_x)) << "behind the eye";
  EXPECT_LT(sample_of(frame_of(), {1, 0, -5}).pixel_x, 0.0f) << "beside the picture";
}

// Held against the plane's equation along each pixel's ray in the world, which is followed in small steps.
TEST(Samples, on_a_ground_they_are_where_rays_meet_the_plane_and_none_is_above_the_horizon) {
  for (const bool orthographic : {false, true}) {
    view::Frame frame = frame_of(orthographic);
    const double tilt = 0.35;  // downward
    frame.view_space.rotation = Mat3d(1, 0, 0, 0, std::cos(tilt), std::sin(tilt), 0, -std::sin(tilt), std::cos(tilt)) *
                                frame.view_space.rotation;
    if (orthographic) frame.projection.left = -6.0;
    for (const double height : {-1.5, 3.2, 4.0, 9.0}) {
      const depth::DepthImage image = ground_depths(frame, depth::PixelGrid(frame.viewport, 10), height);
      std::size_t seen = 0;
      for (std::size_t i = 0; i < image.pixels.count(); ++i) {
        const Vec2d pixel = image.pixels.pixel(i);
        const auto height_at = [&](double depth) {
          const grid::Sample sample = sample_at(frame, pixel.x, pixel.y, depth);
          return sample.eye.y + sample.from_eye.y - height;
        };
        const double near_m = frame.projection.near_m, far_m = frame.projection.far_m;
        const bool crosses = (height_at(near_m) > 0.0) != (height_at(far_m) > 0.0);
        EXPECT_EQ(std::isfinite(image.nearest[i]), crosses)
            << "pixel " << pixel.x << ", " << pixel.y << " at " << height;
        if (!crosses) continue;
        ++seen;
        double before = near_m, behind = far_m;
        for (int step = 0; step < 80; ++step) {
          const double middle = 0.5 * (before + behind);
          ((height_at(middle) > 0.0) == (height_at(near_m) > 0.0) ? before : behind) = middle;
        }
        EXPECT_FLOAT_EQ(image.nearest[i], static_cast<float>(before));
      }
      EXPECT_EQ(opaque_samples(frame, image).size(), seen);
      EXPECT_EQ(seen > 0, orthographic ? height < 4.5 : height != 4.0) << height;
    }
  }
}

TEST(Samples, a_plane_through_the_eye_or_along_all_rays_is_not_seen) {
  const view::Frame level = frame_of();
  const auto seen = [&](const view::Frame& frame, double height) {
    return opaque_samples(frame, ground_depths(frame, depth::PixelGrid(frame.viewport, 10), height)).size();
  };
  EXPECT_EQ(seen(level, 4.0), 0u);
  EXPECT_EQ(seen(frame_of(true), 4.25), 0u) << "looks along it";
  view::Frame endless = level;
  endless.projection.far_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(seen(endless, 0.0), static_cast<std::size_t>(16 * 5)) << "rows of blocks whose pixel lies below the middle";
}

TEST(Samples, visible_ones_lie_on_their_pixels_rays_and_none_is_in_the_sky) {
  const view::Frame frame = frame_of();
  depth::DepthImage image{depth::PixelGrid(frame.viewport, 80), {4.0f, k_sky, 9.0f, 2.0f}};
  ASSERT_EQ(image.pixels.size, Vec2i(2, 2));
  const std::vector<grid::Sample> samples = opaque_samples(frame, image);
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples[0].view.z, -4.0f);
  EXPECT_EQ(samples[0].pixel_x, 40.5f);
  EXPECT_EQ(samples[1].view.z, -9.0f);
  EXPECT_EQ(samples[1].pixel_y, 67.5f);
}

TEST(Samples, transparent_ones_are_all_layers_of_all_pixels) {
  const view::Frame frame = frame_of();
  const depth::LayerImage image{depth::PixelGrid(frame.viewport, 80), {0, 2, 2, 2, 3}, {1.0f, 2.0f, 3.0f}};
  const std::vector<grid::Sample> samples = transparent_samples(frame, image);
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples[1].view.z, -2.0f);
  EXPECT_EQ(samples[1].pixel_x, samples[0].pixel_x);
  EXPECT_EQ(samples[2].pixel_x, 120.5f);
}

TEST(Samples, froxels_are_as_many_as_asked_for_and_their_depths_grow_by_a_factor) {
  const std::vector<grid::Sample> samples = fog_samples(frame_of(), 50.0, {4, 2, 10});
  ASSERT_EQ(samples.size(), 80u);
  EXPECT_EQ(samples[0].pixel_x, 20.0f);
  EXPECT_EQ(samples[7].pixel_y, 67.5f);
  const auto depth = [&](std::size_t slice) { return -samples[8 * slice].view.z; };
  for (std::size_t slice = 0; slice + 1 < 10; ++slice)
    EXPECT_NEAR(depth(slice + 1) / depth(slice), std::pow(100.0, 0.1), 1e-4);
  EXPECT_NEAR(depth(0), 0.5 * std::pow(100.0, 0.05), 1e-4);
}

TEST(Samples, mirrored_ones_are_in_the_bounds_and_outside_of_the_view) {
  const view::Frame frame = frame_of();
  const Bounds bounds{{-20, -10, -10}, {40, 10, 20}};
  const std::vector<grid::Sample> anywhere = anywhere_samples(frame, bounds, 2000, 1);
  ASSERT_EQ(anywhere.size(), 2000u);
  const auto in_view = [&](const grid::Sample& sample) {
    const double depth = -static_cast<double>(sample.view.z);
    return depth >= 0.5 && depth <= 100.0 && std::abs(sample.view.x) <= 1.6 * depth &&
           std::abs(sample.view.y) <= 0.9 * depth;
  };
  const auto in_bounds = [&](const grid::Sample& sample) {
    const Vec3d at = sample.from_eye + sample.eye;
    return glm::all(glm::greaterThanEqual(at, bounds.lo_m)) && glm::all(glm::lessThanEqual(at, bounds.hi_m));
  };
  const auto seen = std::ranges::count_if(anywhere, in_view);
  EXPECT_GT(seen, 200);
  EXPECT_LT(seen, 1800);
  EXPECT_TRUE(std::ranges::all_of(anywhere, in_bounds));
  const std::vector<grid::Sample> mirrored = mirror_samples(frame, bounds, 2000, 1);
  ASSERT_EQ(mirrored.size(), 2000u);
  EXPECT_TRUE(std::ranges::none_of(mirrored, in_view));
  EXPECT_TRUE(std::ranges::all_of(mirrored, in_bounds));
}

TEST(Samples, more_than_memory_holds_are_refused_before_any_is_made) {
  try {
    fog_samples(frame_of(), 50.0, {1024, 1024, 1024});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("raise the limit, or ask for fewer froxels"), std::string::npos) << error.message();
  }
  const MemoryLimitScope limit(1 << 20);
  EXPECT_THROW(volume_samples(frame_of(), 50.0, 1 << 20, 1), Error);
  EXPECT_THROW(mirror_samples(frame_of(), {{-1, -1, -1}, {1, 1, 1}}, 1 << 20, 1), Error);
}

TEST(Samples, bounds_that_are_all_in_view_have_no_mirrored_ones) {
  EXPECT_TRUE(mirror_samples(frame_of(), {{8, 3.5, 4.5}, {12, 4.5, 5.5}}, 100, 1).empty());
}

}  // namespace
}  // namespace clusterbench::measure
