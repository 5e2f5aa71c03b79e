// Lights drawn over the picture: pixels by hand, and each pixel against a loop over all lights.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assign/contract/assigner_run.h"
#include "assign/settings.h"
#include "measure/samples/samples.h"
#include "measure/samples/shading.h"
#include "view/packing.h"

namespace clusterbench::measure {
namespace {

using assign::testing::Setting;

assign::AssignerRun drawn(const Setting& setting, const std::map<std::string, assign::ParamValue>& given = {}) {
  const assign::AssignerDescriptor& row = *assign::find_assigner("deferred");
  assign::AssignerRun run(row, assign::Params(row.params, given), assign::Answer::structure);
  run.build(setting.grid);
  run.assign(setting.input(view::lights_in(setting.frame, setting.frame.view_space)));
  return run;
}

// 200 x 200 pixels, each 0.01 wide at 1 m, all of one depth.
Setting wall_at(float depth, const std::vector<scene::WorldLight>& lights) {
  Setting setting;
  view::Frame& frame = setting.frame;
  frame.viewport = {200, 200};
  frame.projection = {false, -1, 1, -1, 1, 0.1, 100};
  frame.lights = lights;
  for (const scene::WorldLight& light : lights) frame.points += light.type == scene::LightType::point ? 1 : 0;
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, {5, 5}};
  spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {0.1, 100}};
  setting.grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
  setting.depth = {depth::PixelGrid(frame.viewport, 1), std::vector<float>(200 * 200, depth)};
  return setting;
}

struct Pixels {
  std::uint64_t drawn, shaded, traffic;
};
Pixels pixels_of(const Setting& setting, const char* depth_test) {
  const assign::AssignerRun run = drawn(setting, {{"depth_test", std::string(depth_test)}});
  const assign::StructureUse use = run.structure()->use();
  EXPECT_EQ(use.traffic_bytes, 4 * run.tests_done() + (16 + 2 * 8) * use.index_entries);
  EXPECT_EQ(use.upload_bytes, 0u);
  return {run.tests_done(), use.index_entries, use.traffic_bytes};
}

TEST(Deferred, a_ball_is_drawn_where_it_is_seen_and_shades_what_its_depth_test_lets_through) {
  // Seen under a slope of 2 / sqrt(10^2 - 2^2).
  const double slope = 2.0 / std::sqrt(96.0), area = std::numbers::pi * slope * slope * 1e4;
  const std::vector<scene::WorldLight> ball{assign::testing::point_light({0, 0, -10}, 2)};
  for (const auto& [wall, none, back, both] : {std::tuple(5.0f, true, true, false), std::tuple(10.0f, true, true, true),
                                               std::tuple(20.0f, true, false, false)}) {
    const Setting setting = wall_at(wall, ball);
    for (const auto& [test, is_shaded] : {std::pair("none", none), std::pair("back", back), std::pair("both", both)}) {
      const Pixels pixels = pixels_of(setting, test);
      EXPECT_NEAR(static_cast<double>(pixels.drawn), area, 0.03 * area) << test << ", wall at " << wall;
      if (is_shaded)
        EXPECT_GT(pixels.shaded, 0.9 * area) << test << ", wall at " << wall;
      else
        EXPECT_EQ(pixels.shaded, 0u) << test << ", wall at " << wall;
    }
  }
}

TEST(Deferred, sky_is_drawn_over_and_not_shaded) {
  const Setting setting =
      wall_at(std::numeric_limits<float>::infinity(), {assign::testing::point_light({0, 0, -10}, 2)});
  for (const char* test : {"none", "back", "both"}) {
    EXPECT_GT(pixels_of(setting, test).drawn, 1000u);
    EXPECT_EQ(pixels_of(setting, test).shaded, 0u);
  }
}

TEST(Deferred, lights_behind_the_eye_are_not_drawn_and_around_it_everywhere) {
  EXPECT_EQ(pixels_of(wall_at(3, {assign::testing::point_light({0, 0, 5}, 4)}), "none").drawn, 0u);
  EXPECT_EQ(pixels_of(wall_at(3, {assign::testing::point_light({0, 0, 2}, 4)}), "none").drawn, 200u * 200u);
}

TEST(Deferred, a_spot_shades_the_pixels_in_its_cone_or_with_its_ball_alone_those_in_that) {
  const Setting setting = wall_at(10, {assign::testing::spot_light({0, 0, -5}, 8, {0, 0, -1}, 0.3)});
  // A disk of 5 tan(0.3) at 10 m.
  const double disk = std::numbers::pi * std::pow(5 * std::tan(0.3) / 10 * 100, 2);
  EXPECT_NEAR(static_cast<double>(pixels_of(setting, "both").shaded), disk, 0.03 * disk);
  EXPECT_GT(drawn(setting, {{"spot", std::string("sphere")}}).structure()->use().index_entries, 1.5 * disk);
}

TEST(Deferred, a_ball_that_the_near_plane_cuts_is_drawn_beyond_it_alone_whatever_the_grid) {
  for (const bool orthographic : {false, true}) {
    std::vector<std::uint64_t> drawn_on;
    for (const int tiles : {1, 5, 100}) {
      // Its widest part, of slope 0.89 (orthographic: of 0.4 m), lies before the near plane; a disk of 0.19 m is left
      // of it.
      Setting setting = wall_at(5, {assign::testing::point_light({0, 0, -0.6}, 0.4)});
      setting.frame.projection.orthographic = orthographic;
      setting.frame.projection.near_m = 0.95;
      grid::GridSpec spec;
      spec.tiles = {{0, 0}, {tiles, tiles}};
      spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {0.5, 100}};
      setting.grid = grid::make_grid(spec, grid::grid_inputs(spec, setting.frame, 0.0, {}, {}));
      drawn_on.push_back(pixels_of(setting, "none").drawn);
    }
    const double radius = std::sqrt(0.4 * 0.4 - 0.35 * 0.35) / (orthographic ? 1.0 : 0.95);
    EXPECT_NEAR(static_cast<double>(drawn_on[0]), std::numbers::pi * radius * radius * 1e4, 30) << orthographic;
    EXPECT_EQ(drawn_on, std::vector<std::uint64_t>(3, drawn_on[0])) << orthographic;
  }
}

TEST(Deferred, one_pass_with_back_sides_shades_what_is_before_the_balls_far_side_spots_alike) {
  // A wall between the ball's middle and its far side, which is at 13 m; the cone is a disk of 1.9 m there.
  const Setting setting = wall_at(11, {assign::testing::spot_light({0, 0, -5}, 8, {0, 0, -1}, 0.3)});
  const std::uint64_t none = pixels_of(setting, "none").shaded, back = pixels_of(setting, "back").shaded;
  EXPECT_GT(back, 1.5 * static_cast<double>(pixels_of(setting, "both").shaded));
  EXPECT_LE(back, none);
}

TEST(Deferred, a_spots_cone_holds_however_far_it_reaches) {
  const auto shaded = [](double range) {
    return pixels_of(wall_at(20, {assign::testing::spot_light({0, 0, 0}, range, {0, 0, -1}, 0.1)}), "both").shaded;
  };
  for (const double range : {1e6, 1e14, std::numeric_limits<double>::infinity()}) EXPECT_EQ(shaded(range), shaded(100));
}

TEST(Deferred, each_pixel_has_the_lights_that_reach_it_and_hardly_another) {
  const assign::AssignerDescriptor& row = *assign::find_assigner("deferred");
  for (Setting setting : assign::testing::settings_for(row, 71)) {
    // What has no end is not held against its cone.
    view::Frame& frame = setting.frame;
    const auto is_endless = [](const scene::WorldLight& light) { return std::isinf(light.range_m); };
    frame.points -= static_cast<std::uint32_t>(
        std::count_if(frame.lights.begin(), frame.lights.begin() + frame.points, is_endless));
    std::erase_if(frame.lights, is_endless);
    const assign::AssignerRun run = drawn(setting);
    const std::vector<grid::Sample> all = opaque_samples(setting.frame, setting.depth);
    std::vector<grid::Sample> samples;
    for (std::size_t i = 0; i < all.size(); i += 37) samples.push_back(all[i]);
    ShadingCounts counts;
    add_samples(counts, 0, samples, needed_lights(setting.frame, samples), *run.structure());
    EXPECT_EQ(counts.missed, 0u) << setting.name;
    EXPECT_GT(counts.needed, 1000u) << setting.name;
    EXPECT_LT(static_cast<double>(counts.evaluated), 1.001 * static_cast<double>(counts.needed)) << setting.name;
  }
}

TEST(Deferred, the_pixels_that_are_counted_as_shaded_are_those_whose_samples_get_the_light) {
  const assign::AssignerDescriptor& row = *assign::find_assigner("deferred");
  assign::testing::Random random(72);
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < 40; ++i) {
    const Vec3d at{random.between(-9.0, 9.0), random.between(-9.0, 9.0), random.between(-15.0, 1.0)};
    const double range = random.between(0.5, 5.0);
    lights.push_back(i < 25 ? assign::testing::point_light(at, range)
                            : assign::testing::spot_light(at, range, random.direction(), random.between(0.1, 1.5)));
  }
  Setting setting = wall_at(10.0f, lights);
  setting.depth = depth::seeded_depths(setting.frame, 72);
  for (const assign::Params& params : assign::testing::params_of(row)) {
    assign::AssignerRun run(row, params, assign::Answer::structure);
    run.build(setting.grid);
    run.assign(setting.input(view::lights_in(setting.frame, setting.frame.view_space)));
    std::uint64_t given_in_all = 0;
    assign::Reads reads;
    std::vector<std::uint32_t> given;
    for (const grid::Sample& sample : opaque_samples(setting.frame, setting.depth)) {
      ASSERT_TRUE(run.structure()->lights_at(sample, grid::Log2::rounded, given));
      given_in_all += given.size();
      reads += run.structure()->reads_at(sample, grid::Log2::rounded);
    }
    EXPECT_EQ(run.structure()->use().index_entries, given_in_all);
    // Pixels of the sky are no samples; what is drawn over them is traffic and no sample's.
    EXPECT_LE(reads.bytes, run.structure()->use().traffic_bytes);
    EXPECT_GE(reads.bytes, (16 + 2 * 8 + 4) * given_in_all);
    EXPECT_GT(given_in_all, 1000u);
  }
}

}  // namespace
}  // namespace clusterbench::measure
