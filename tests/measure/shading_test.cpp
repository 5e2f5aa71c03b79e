#include "measure/samples/shading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/random.h"
#include "measure/samples/sample_tree.h"
#include "measure/truth/truth.h"

#include "measure/packed_lists.h"

namespace clusterbench::measure {
namespace {

// A camera at (100, 2, 50) that looks along -x.
view::Frame frame_along_x(int index = 0) {
  view::Frame frame;
  frame.index = index;
  frame.viewport = {200, 100};
  frame.projection = {false, -1.0, 1.0, -0.5, 0.5, 0.5, 64.0};
  frame.view_space.origin = {100.0, 2.0, 50.0};
  frame.view_space.rotation = glm::transpose(Mat3d{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}});  // right, up, back
  return frame;
}

void add_light(view::Frame& frame, const Vec3d& position, double range_m) {
  scene::WorldLight light;
  light.position = position;
  light.range_m = range_m;
  frame.lights.push_back(light);
  ++frame.points;
}

const Vec3d k_eye = frame_along_x().view_space.origin;

Vec3d world_of(const grid::Sample& sample) {
  return sample.from(Vec3d(0.0));
}

grid::Sample sample_in(const Vec3d& world) {
  return {0.0f, 0.0f, Vec3f(0.0f), world - k_eye, k_eye};
}

TEST(Shading, samples_lie_in_the_view_where_their_pixel_and_depth_say) {
  const view::Frame frame = frame_along_x();
  for (const grid::Sample& sample : volume_samples(frame, 64.0, 1000, 1)) {
    const double depth = 100.0 - world_of(sample).x;
    ASSERT_GE(depth, 0.5 - 1e-9);
    ASSERT_LE(depth, 64.0 + 1e-9);
    ASSERT_NEAR(-sample.view.z, depth, 1e-4);
    ASSERT_NEAR((50.0 - world_of(sample).z) / depth, -1.0 + sample.pixel_x / 100.0, 1e-6);
    ASSERT_NEAR((world_of(sample).y - 2.0) / depth, 0.5 - sample.pixel_y / 100.0, 1e-6);
  }
}

TEST(Shading, samples_are_spread_evenly_over_octaves_of_depth) {
  int nearest = 0, farthest = 0;
  for (const grid::Sample& sample : volume_samples(frame_along_x(), 64.0, 7000, 1)) {  // 0.5 .. 64 is seven octaves
    nearest += -sample.view.z < 1.0f ? 1 : 0;
    farthest += -sample.view.z > 32.0f ? 1 : 0;
  }
  EXPECT_NEAR(nearest, 1000, 120);
  EXPECT_NEAR(farthest, 1000, 120);
}

TEST(Shading, samples_of_an_orthographic_view_are_spread_evenly_over_depth) {
  view::Frame frame = frame_along_x();
  frame.projection = {true, -10.0, 10.0, -5.0, 5.0, 0.0, 64.0};
  int nearer_half = 0;
  for (const grid::Sample& sample : volume_samples(frame, 64.0, 2000, 1)) {
    ASSERT_NEAR(50.0 - world_of(sample).z, -10.0 + sample.pixel_x / 10.0, 1e-5);
    nearer_half += -sample.view.z < 32.0f ? 1 : 0;
  }
  EXPECT_NEAR(nearer_half, 1000, 120);
}

TEST(Shading, the_same_seed_and_frame_give_the_same_samples) {
  const auto first = volume_samples(frame_along_x(3), 64.0, 10, 9),
             again = volume_samples(frame_along_x(3), 64.0, 10, 9);
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].from_eye, again[i].from_eye);
}

TEST(Shading, no_two_frames_share_samples) {
  std::multiset<float> columns;
  for (int index = 0; index < 12; ++index)
    for (const grid::Sample& sample : volume_samples(frame_along_x(index), 64.0, 100, 1))
      columns.insert(sample.pixel_x);
  std::size_t repeated = 0;
  for (const float column : columns) repeated += columns.count(column) > 1 ? 1 : 0;
  EXPECT_LE(repeated, 10u) << "of 1200";
}

TEST(Shading, a_light_reaches_as_far_as_its_range_and_no_farther) {
  view::Frame frame = frame_along_x();
  add_light(frame, {3.0, 4.0, 0.0}, 5.0);
  const std::vector<grid::Sample> samples{sample_in({0, 0, 0}), sample_in({-1e-9, 0, 0}), sample_in({3, 4, 0})};
  EXPECT_EQ(lights_reaching(frame, samples), (assign::Lists{{0, 1, 1, 2}, {0, 0}}));
}

TEST(Shading, a_light_without_range_reaches_nothing) {
  view::Frame frame = frame_along_x();
  add_light(frame, {0.0, 0.0, 0.0}, 0.0);
  EXPECT_EQ(lights_reaching(frame, std::vector{sample_in({0, 0, 0})}).pair_count(), 0u);
}

TEST(Shading, a_spot_reaches_only_into_its_cone) {
  view::Frame frame = frame_along_x();
  scene::WorldLight spot;
  spot.type = scene::LightType::spot;
  spot.range_m = 10.0;
  spot.direction = {0, -1, 0};
  spot.outer_cone_rad = M_PI / 6;  // 30 degrees: at a depth of 1, tan = 0.577
  frame.lights = {spot};
  const std::vector<grid::Sample> samples{sample_in({0.57, -1, 0}), sample_in({0.58, -1, 0}), sample_in({0, 1, 0}),
                                          sample_in({0, -10, 0}), sample_in({1, -10, 0})};
  EXPECT_EQ(lights_reaching(frame, samples), (assign::Lists{{0, 1, 1, 1, 2, 2}, {0, 0}}));
}

// Their cosine is 1 in doubles.
TEST(Shading, a_spot_as_narrow_as_a_needle_reaches_its_axis_and_nothing_beside_its_cone) {
  for (const double angle : {1e-7, 1e-9, 1e-12, 1e-100}) {
    view::Frame frame = frame_along_x();
    frame.view_space.origin = {0, 0, 0};
    scene::WorldLight spot;
    spot.type = scene::LightType::spot;
    spot.range_m = 10.0;
    spot.direction = {0, -1, 0};
    spot.outer_cone_rad = angle;
    frame.lights = {spot};
    const auto at = [](const Vec3d& place) { return grid::Sample{0.0f, 0.0f, Vec3f(0.0f), place, Vec3d(0.0)}; };
    const std::vector<grid::Sample> samples{at({0, -7, 0}), at({0.99 * angle, -1, 0}), at({0, -1, 1.01 * angle}),
                                            at({0, 1, 0})};
    EXPECT_EQ(lights_reaching(frame, samples), (assign::Lists{{0, 1, 2, 2, 2}, {0, 0}})) << angle;
  }
}

TEST(Shading, every_light_is_found_that_reaches_a_sample) {
  view::Frame frame = frame_along_x();
  SplitMix64 random(1);
  for (int i = 0; i < 300; ++i) {
    const double x = random.between(0.0, 100.0), y = random.between(-20.0, 20.0), z = random.between(0.0, 100.0);
    add_light(frame, {x, y, z}, random.between(0.0, i % 10 == 0 ? 60.0 : 6.0));
  }
  frame.lights[7].range_m = std::numeric_limits<double>::infinity();
  std::vector<grid::Sample> samples = volume_samples(frame, 64.0, 500, 1);
  samples.insert(samples.end(), 20, samples.front());
  const assign::Lists found = lights_reaching(frame, samples);
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t light = 0; light < frame.lights.size(); ++light)
      if (glm::length(world_of(samples[i]) - frame.lights[light].position) <= frame.lights[light].range_m)
        expected.push_back(light);
    ASSERT_EQ(std::vector(found.of(i).begin(), found.of(i).end()), expected) << i;
  }
}

TEST(Shading, a_small_light_looks_at_few_of_many_samples) {
  const view::Frame frame = frame_along_x();
  const std::vector<grid::Sample> samples = volume_samples(frame, 64.0, 10000, 1);
  const SampleTree tree(samples);
  int looked_at = 0;
  for (int i = 0; i < 1000; ++i)
    tree.each_near(samples[static_cast<std::size_t>(i)].from_eye, 0.0, [&](std::uint32_t) { ++looked_at; });
  EXPECT_GE(looked_at, 1000);
  EXPECT_LE(looked_at, 1000 * 64);
}

// Two slices, 0.5 .. 8 and 8 .. 64, with samples at depths 4, 60 and 90; both lights reach the first sample only.
struct TwoSlices {
  view::Frame frame = frame_along_x();
  grid::Grid grid;
  std::vector<grid::Sample> samples;

  TwoSlices() {
    add_light(frame, {96.0, 4.0, 50.0}, 10.0);  // 2 m from the first sample
    add_light(frame, {96.0, 2.0, 51.0}, 10.0);  // 1 m
    grid::GridSpec spec;
    spec.tiles.count = {1, 1};
    spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {0.5, 8.0, 64.0}};
    grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
    samples = {{100.0f, 50.0f, {0.0f, 0.0f, -4.0f}, Vec3d{96.0, 2.0, 50.0} - k_eye, k_eye},
               {100.0f, 50.0f, {0.0f, 0.0f, -60.0f}, Vec3d{40.0, 2.0, 50.0} - k_eye, k_eye},
               {100.0f, 50.0f, {0.0f, 0.0f, -90.0f}, Vec3d{10.0, 2.0, 50.0} - k_eye, k_eye}};
  }
  ShadingCounts counts(const assign::Lists& reported) const {
    ShadingCounts out;
    add_samples(out, frame.index, samples, needed_lights(frame, samples), *packed_lists(reported, grid, frame));
    return out;
  }
};

TEST(Shading, what_a_list_holds_beyond_need_is_overshade) {
  const ShadingCounts counts = TwoSlices().counts({{0, 2, 4}, {0, 1, 0, 1}});
  EXPECT_EQ(counts.samples, 3u);
  EXPECT_EQ(counts.evaluated, 4u);  // two lights in each of two slices; nothing beyond the grid
  EXPECT_EQ(counts.needed, 2u);
  EXPECT_EQ(counts.missed, 0u);
  EXPECT_EQ(counts.overshade(), 2.0);
  EXPECT_EQ(counts.lost_irradiance(), 0.0);
}

TEST(Shading, a_missed_light_weighs_what_it_would_have_given) {
  const ShadingCounts counts = TwoSlices().counts({{0, 1, 1}, {0}});
  EXPECT_EQ(counts.evaluated, 1u);
  EXPECT_EQ(counts.missed, 1u);
  // (1 - (d/r)^4) / d^2: 0.9999 at 1 m, 0.9984 / 4 at 2 m.
  EXPECT_NEAR(counts.lost_irradiance(), 0.9999 / (0.9999 + 0.9984 / 4.0), 1e-12);
  ASSERT_TRUE(counts.worst && counts.darkest);
  EXPECT_EQ(counts.worst->missed, 1u);
  EXPECT_EQ(counts.worst->needed, 2u);
  EXPECT_EQ(counts.darkest->pixel_x, 100.0f);
  EXPECT_NEAR(counts.darkest->lost_lux, 0.9999, 1e-12);
}

TEST(Shading, a_frame_added_part_by_part_counts_as_one) {
  const TwoSlices two;
  const auto structure = packed_lists({{0, 1, 1}, {0}}, two.grid, two.frame);
  ShadingCounts whole, parts;
  for (const int frame : {3, 4}) {
    add_samples(whole, frame, two.samples, needed_lights(two.frame, two.samples), *structure);
    for (std::size_t i = 0; i < two.samples.size(); ++i) {
      const std::span<const grid::Sample> one(&two.samples[i], 1);
      add_samples(parts, frame, one, needed_lights(two.frame, one), *structure);
    }
  }
  EXPECT_EQ(whole.worst, parts.worst);
  EXPECT_EQ(whole.worst, (ShadingCounts::WorstFrame{3, 1, 2}));
  EXPECT_EQ(whole.needed, parts.needed);
  EXPECT_EQ(whole.lost_lux, parts.lost_lux);
}

TEST(Shading, samples_outside_of_the_cells_are_unanswered_and_what_they_need_is_missed_outside) {
  TwoSlices two;
  two.samples.resize(1);
  grid::Sample beside = two.samples[0], behind = two.samples[0];
  beside.pixel_x = -1.0f;
  behind.pixel_x = behind.pixel_y = std::numeric_limits<float>::quiet_NaN();
  two.samples.push_back(beside);
  two.samples.push_back(behind);
  const ShadingCounts counts = two.counts({{0, 2, 2}, {0, 1}});
  EXPECT_EQ(counts.samples, 3u);
  EXPECT_EQ(counts.unanswered, 2u);
  EXPECT_EQ(counts.evaluated, 2u);
  EXPECT_EQ(counts.missed, 4u);
  EXPECT_EQ(counts.missed_outside, 4u);
}

TEST(Shading, a_missed_light_weighs_by_its_intensity) {
  TwoSlices two;
  two.frame.lights[0].luminous_intensity_cd = 1e6;
  // Light 1 is missed, then light 0.
  const double faint = 0.9999, strong = 1e6 * 0.9984 / 4.0;
  EXPECT_NEAR(two.counts({{0, 1, 1}, {0}}).lost_irradiance(), faint / (faint + strong), 1e-17);
  EXPECT_NEAR(two.counts({{0, 1, 1}, {1}}).lost_irradiance(), strong / (faint + strong), 1e-12);
}

// A spot at the origin that shines down -z, and a point light of 1 cd that every sample is 1 m away from; both reach
// far beyond, so that the window is 1 up to rounding. Only the point light is listed.
double lost_of_spot(double inner_rad, double outer_rad, double off_axis_rad) {
  view::Frame frame = frame_along_x();
  const Vec3d place{std::sin(off_axis_rad), 0.0, -std::cos(off_axis_rad)};
  add_light(frame, {0.0, 0.0, 0.0}, 1e5);
  scene::WorldLight spot = frame.lights[0];
  spot.type = scene::LightType::spot;
  spot.inner_cone_rad = inner_rad;
  spot.outer_cone_rad = outer_rad;
  frame.lights.push_back(spot);
  grid::GridSpec spec;
  spec.tiles.count = {1, 1};
  spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {0.5, 64.0}};
  const grid::Grid grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
  const std::vector<grid::Sample> samples{{100.0f, 50.0f, {0.0f, 0.0f, -4.0f}, place - k_eye, k_eye}};
  ShadingCounts counts;
  add_samples(counts, frame.index, samples, needed_lights(frame, samples), *packed_lists({{0, 1}, {0}}, grid, frame));
  EXPECT_EQ(counts.needed, 2u);
  return counts.lost_irradiance();
}

TEST(Shading, a_missed_spot_weighs_by_its_falloff_between_the_cones) {
  // 1 and 1 within the inner cone.
  EXPECT_NEAR(lost_of_spot(0.3, 1.0, 0.29), 0.5, 1e-12);
  // The extension: ((cos a - cos outer) / (cos inner - cos outer))², beside the point's 1.
  const double share = (std::cos(0.7) - std::cos(1.0)) / (std::cos(0.3) - std::cos(1.0));
  EXPECT_NEAR(lost_of_spot(0.3, 1.0, 0.7), share * share / (1.0 + share * share), 1e-12);
  EXPECT_LT(lost_of_spot(0.3, 1.0, 0.9999), 1e-6);
  // Cones nearer than a thousandth in their cosines fall off over a thousandth, as the extension has it.
  const double thin = 1000.0 * (1.0 - std::cos(0.02));
  EXPECT_NEAR(lost_of_spot(0.0, 0.02, 0.0), thin * thin / (1.0 + thin * thin), 1e-12);
}

TEST(Shading, a_missed_light_of_a_centimetre_weighs_what_it_gives) {
  for (const double range_m : {0.01, 0.004}) {
    TwoSlices two;
    two.frame.lights.resize(1);
    two.frame.points = 1;
    two.frame.lights[0].range_m = range_m;
    two.frame.lights[0].position = Vec3d(96.0, 2.0, 50.0) + Vec3d(0.5 * range_m, 0.0, 0.0);
    const ShadingCounts counts = two.counts({{0, 0, 0}, {}});
    EXPECT_EQ(counts.missed, 1u);
    // The window is that of the true distance; 1 / d² is held at 1 cm.
    EXPECT_NEAR(counts.lost_lux, (1.0 - 1.0 / 16.0) / 1e-4, 1e-3);
    EXPECT_EQ(counts.lost_irradiance(), 1.0);
  }
}

// Places in the view, in front of the eye: within a light's range by a tenth of it, and beyond it by three centimetres.
std::vector<grid::Sample> samples_at_ends_of_lights(const view::Frame& frame, SplitMix64& random) {
  std::vector<grid::Sample> samples;
  const view::Projection& lens = frame.projection;
  for (const scene::WorldLight& light : frame.lights)
    for (int i = 0; i < 80; ++i) {
      const Vec3d towards{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
      const double distance = i % 2 == 0 ? 0.9 * light.range_m : light.range_m + 0.03;
      const Vec3d from_eye = light.position - frame.view_space.origin + distance * glm::normalize(towards);
      const Vec3d place = frame.view_space.rotation * from_eye;
      const double x = (-place.x / place.z - lens.left) / (lens.right - lens.left) * frame.viewport.x;
      const double y = (lens.top + place.y / place.z) / (lens.top - lens.bottom) * frame.viewport.y;
      const bool is_in_view = place.z < -1.0 && x > 0.0 && x < frame.viewport.x && y > 0.0 && y < frame.viewport.y;
      if (is_in_view) samples.push_back(sample_at(frame, x, y, -place.z));
    }
  return samples;
}

// Where a double holds decimetres, true lists miss nothing.
TEST(Shading, true_lists_miss_nothing_far_from_the_origin) {
  for (const grid::Kind kind : {grid::Kind::frustum, grid::Kind::distance, grid::Kind::cascades, grid::Kind::world}) {
    view::Frame frame = frame_along_x();
    frame.view_space.origin = {5e14, -9e14, 0.25};
    SplitMix64 random(7);
    for (int i = 0; i < 200; ++i) {
      const Vec3d way{random.between(-40.0, 0.0), random.between(-15.0, 15.0), random.between(-30.0, 30.0)};
      add_light(frame, frame.view_space.origin + way, random.between(0.1, 4.0));
    }
    grid::GridSpec spec;
    spec.kind = kind;
    spec.tiles.count = {64, 32};  // cells of some decimetres
    spec.slices.scheme = grid::Scheme::linear;
    spec.slices.count = 128;
    spec.slices.far_m = 64.0;
    spec.cells = {64, 64, 64};
    spec.finest_m = 0.5;
    spec.has_bounds = true;
    spec.bounds_lo_m = frame.view_space.origin - Vec3d(48.0, 20.0, 40.0);
    spec.bounds_hi_m = frame.view_space.origin + Vec3d(2.0, 20.0, 40.0);
    const grid::Grid grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
    const std::vector<grid::Sample> samples = samples_at_ends_of_lights(frame, random);
    ShadingCounts counts;
    add_samples(counts, frame.index, samples, needed_lights(frame, samples),
                *packed_lists(find_truth(frame, grid, 1).lists, grid, frame));
    EXPECT_GT(counts.needed, 1000u);
    EXPECT_EQ(counts.missed, 0u) << grid::kind_name(kind);
  }
}

TEST(Shading, where_nothing_is_needed_there_is_no_overshade) {
  EXPECT_TRUE(std::isnan(ShadingCounts{}.overshade()));
}

}  // namespace
}  // namespace clusterbench::measure
