#include "grid/needed_span.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/random.h"
#include "geom/shapes/domain.h"
#include "grid/grid.h"

namespace clusterbench::grid {
namespace {

constexpr double k_no_end = std::numeric_limits<double>::infinity();
const view::Projection k_wide{false, -1.2, 0.8, -0.5, 0.625, 0.5, 80.0};  // off-centre
const view::Projection k_flat{true, -20.0, 20.0, -10.0, 10.0, 0.5, 80.0};

view::Frame frame_in(const view::Projection& projection) {
  view::Frame frame;
  frame.viewport = {640, 360};
  frame.projection = projection;
  return frame;
}

scene::WorldLight ball(const Vec3d& place, double range_m) {
  scene::WorldLight light;
  light.position = place;
  light.range_m = range_m;
  return light;
}

scene::WorldLight spot(const Vec3d& place, const Vec3d& direction, double range_m, double half_angle_rad) {
  scene::WorldLight light = ball(place, range_m);
  light.type = scene::LightType::spot;
  light.direction = glm::normalize(direction);
  light.outer_cone_rad = half_angle_rad;
  return light;
}

Vec3d random_unit(SplitMix64& random) {
  while (true) {
    const double x = random.between(-1.0, 1.0), y = random.between(-1.0, 1.0), z = random.between(-1.0, 1.0);
    const Vec3d v(x, y, z);
    if (glm::length(v) < 1.0 && glm::length(v) > 0.01) return glm::normalize(v);
  }
}

bool is_seen(const view::Projection& p, const Vec3d& point) {
  const double depth = -point.z, scale = p.orthographic ? 1.0 : depth;
  return depth >= p.near_m && depth <= p.far_m && point.x >= p.left * scale && point.x <= p.right * scale &&
         point.y >= p.bottom * scale && point.y <= p.top * scale;
}

TEST(NeededSpan, holds_every_point_in_view_that_a_light_reaches) {
  SplitMix64 random(7);
  int seen = 0;
  for (int i = 0; i < 400; ++i) {
    view::Frame frame = frame_in(i % 3 == 0 ? k_flat : k_wide);
    for (int n = 0; n < 3; ++n) {
      const Vec3d place{random.between(-30.0, 30.0), random.between(-20.0, 20.0), random.between(-90.0, 10.0)};
      const double range = random.between(0.5, 15.0);
      frame.lights.push_back(n == 0 ? ball(place, range)
                                    : spot(place, random_unit(random), range, random.between(0.02, 1.57)));
    }
    for (const bool by_distance : {false, true}) {
      if (by_distance && frame.projection.orthographic) continue;
      const Span span = span_of_lights(frame, by_distance);
      for (const scene::WorldLight& light : frame.lights)
        for (int n = 0; n < 40; ++n) {
          const Vec3d away = random_unit(random), point = light.position + away * random.unit() * light.range_m;
          const bool in_cone = light.type == scene::LightType::point ||
                               glm::dot(away, light.direction) >= std::cos(light.outer_cone_rad);
          if (!in_cone || !is_seen(frame.projection, point)) continue;
          ++seen;
          const double at = by_distance ? glm::length(point) : -point.z;
          EXPECT_LE(span.near_m, at);
          EXPECT_GE(span.far_m, at);
        }
    }
  }
  EXPECT_GT(seen, 2000);
}

TEST(NeededSpan, of_one_light_is_as_deep_as_the_light) {
  view::Frame frame = frame_in(k_wide);
  const double a = std::numbers::pi / 6.0;
  const auto expect = [&](const scene::WorldLight& light, double near, double far) {
    frame.lights = {light};
    const Span span = span_of_lights(frame, false);
    EXPECT_NEAR(span.near_m, near, 1e-9);
    EXPECT_NEAR(span.far_m, far, 1e-9);
  };
  expect(ball({0, 0, -20}, 5), 15, 25);
  expect(spot({0, 0, -20}, {0, 0, -1}, 5, a), 20, 25);
  expect(spot({0, 0, -20}, {0, 0, 1}, 5, a), 15, 20);
  expect(spot({0, 0, -20}, {1, 0, 0}, 5, a), 20 - 5 * std::sin(a), 20 + 5 * std::sin(a));
  expect(spot({0, 0, -20}, {1, 0, -1}, 5, a), 20, 20 + 5 * std::cos(std::numbers::pi / 12.0));
}

TEST(NeededSpan, of_no_light_is_empty_and_of_one_without_end_is_everything) {
  view::Frame frame = frame_in(k_wide);
  EXPECT_TRUE(span_of_lights(frame, false).is_empty());
  frame.lights = {ball({0, 0, 40}, 5), ball({0, 0, -20}, 0)};  // behind the eye; of no range
  EXPECT_TRUE(span_of_lights(frame, false).is_empty());
  frame.lights.push_back(ball({0, 0, 40}, k_no_end));
  EXPECT_EQ(span_of_lights(frame, false), (Span{-k_no_end, k_no_end}));
}

TEST(NeededSpan, of_surfaces_goes_from_the_nearest_to_the_farthest_pixel) {
  const view::Frame frame = frame_in(k_wide);
  const depth::DepthImage depths = depth::seeded_depths(frame, 3);
  Span depth, distance;
  for (std::size_t i = 0; i < depths.nearest.size(); ++i) {
    const auto at = static_cast<double>(depths.nearest[i]);
    if (!std::isfinite(at)) continue;
    const Vec2d pixel = depths.pixels.pixel(i);
    const double x = -1.2 + 2.0 * pixel.x / 640.0, y = 0.625 - 1.125 * pixel.y / 360.0;
    depth = {std::min(depth.near_m, at), std::max(depth.far_m, at)};
    const double ray = at * std::sqrt(1.0 + x * x + y * y);
    distance = {std::min(distance.near_m, ray), std::max(distance.far_m, ray)};
  }
  ASSERT_FALSE(depth.is_empty());
  EXPECT_EQ(span_of_surfaces(frame, depths, false), depth);
  const Span by_distance = span_of_surfaces(frame, depths, true);
  EXPECT_NEAR(by_distance.near_m, distance.near_m, 1e-9 * distance.near_m);
  EXPECT_NEAR(by_distance.far_m, distance.far_m, 1e-9 * distance.far_m);
  view::Frame lit = frame;
  lit.lights = {ball({0, 0, -20}, 5)};
  EXPECT_EQ(needed_span({.to = Fit::To::both}, lit, &depths, false), depth.within(span_of_lights(lit, false)));
  EXPECT_TRUE(needed_span({.to = Fit::To::surfaces}, lit, nullptr, false).is_empty());
  EXPECT_EQ(needed_span({.to = Fit::To::ranges}, lit, &depths, false), span_of_balls(lit, false));
}

TEST(SpanFollower, grows_at_once_and_shrinks_by_its_damping) {
  SpanFollower follower({.damping = 0.75});
  EXPECT_EQ(follower.next({10, 20}), (Span{10, 20}));
  EXPECT_EQ(follower.next({4, 60}), (Span{4, 60})) << "grows at once";
  EXPECT_EQ(follower.next({8, 20}), (Span{5, 50})) << "a quarter of the way";
  EXPECT_EQ(follower.next({}), (Span{5, 50})) << "a frame that needs nothing moves nothing";
  EXPECT_EQ(follower.next({5, 10}), (Span{5, 40}));
  SpanFollower undamped({});
  EXPECT_TRUE(undamped.next({}).is_empty());
  EXPECT_EQ(undamped.next({4, 60}), (Span{4, 60}));
  EXPECT_EQ(undamped.next({8, 20}), (Span{8, 20}));
  EXPECT_TRUE(undamped.next({}).is_empty());
}

TEST(SpanFollower, never_leaves_out_what_is_needed_and_ends_at_powers_of_its_step) {
  SplitMix64 random(11);
  for (const double damping : {0.0, 0.5, 0.95})
    for (const double step : {1.0, 1.25, 2.0}) {
      SpanFollower follower({.damping = damping, .step = step});
      for (int i = 0; i < 200; ++i) {
        const double near = std::exp(random.between(-3.0, 5.0)), far = near * std::exp(random.between(0.0, 3.0));
        const Span span = follower.next({near, far});
        EXPECT_LE(span.near_m, near);
        EXPECT_GE(span.far_m, far);
        if (step == 1.0) continue;
        for (const double end : {span.near_m, span.far_m}) {
          const double power = std::log(end) / std::log(step);
          EXPECT_NEAR(power, std::round(power), 1e-6);
        }
      }
    }
}

// --- Slices ---

Slicing fitted(Scheme scheme, int count) {
  Slicing slicing;
  slicing.scheme = scheme;
  slicing.count = count;
  slicing.near_m = 0.1;
  slicing.far_m = 500.0;
  slicing.fit.emplace();
  return slicing;
}

Slices made(const Slicing& slicing, const Span& needed) {
  return make_slices(slicing, {0.1, 1000.0, 0.0, 0.0, needed}, false);
}

TEST(FittedSlices, lie_where_something_is_needed) {
  const Slices slices = made(fitted(Scheme::exponential, 4), {10, 160});
  EXPECT_FLOAT_EQ(slices.boundaries[1], 20.0f);
  EXPECT_NEAR(slices.boundaries.back(), 160.0f, 160.0f * 0x1p-19f);
  EXPECT_LE(slices.boundaries.front(), 0.1f) << "what is nearer looks itself up in slice 0";
  EXPECT_NEAR(made(fitted(Scheme::linear, 3), {10, 160}).boundaries[1], 60.0f, 60.0f * 0x1p-19f);
}

TEST(FittedSlices, of_exponential_first_move_the_end_of_the_first_slice) {
  const Slicing slicing = fitted(Scheme::exponential_first, 5);
  const Slices beyond = made(slicing, {10, 160});
  EXPECT_FLOAT_EQ(beyond.boundaries[1], 10.0f);
  EXPECT_FLOAT_EQ(beyond.boundaries[2], 20.0f);
  EXPECT_FLOAT_EQ(beyond.lookup.first_m, 10.0f);
  EXPECT_EQ(beyond.slice_of(9.9f), 0);
  EXPECT_EQ(beyond.slice_of(10.1f), 1);
  EXPECT_FLOAT_EQ(made(slicing, {1, 80}).boundaries[1], 5.0f) << "what was asked for is the nearest";
  const Slices before = made(slicing, {1, 3.2});
  EXPECT_NEAR(before.boundaries[1], 0.2f, 1e-5f) << "nothing is needed beyond: as exponential slices from near on";
  EXPECT_NEAR(before.boundaries.back(), 3.2f, 1e-4f);
}

TEST(FittedSlices, without_a_need_lie_as_they_were_asked_for) {
  for (const Scheme scheme : {Scheme::linear, Scheme::exponential, Scheme::exponential_first, Scheme::power}) {
    Slicing plain = fitted(scheme, 8);
    plain.fit.reset();
    const std::vector<float> asked = made(plain, {}).boundaries;
    EXPECT_EQ(made(fitted(scheme, 8), {}).boundaries, asked);
    EXPECT_EQ(made(fitted(scheme, 8), {600, 900}).boundaries, asked) << "beyond what was asked for";
  }
}

TEST(FittedSlices, hold_all_that_is_needed_however_thin_it_is) {
  SplitMix64 random(5);
  for (int i = 0; i < 4000; ++i) {
    const Scheme schemes[] = {Scheme::linear, Scheme::exponential, Scheme::exponential_first, Scheme::power};
    const Slicing slicing = fitted(schemes[i % 4], 2 + static_cast<int>(random.below(i % 7 == 0 ? 4000 : 30)));
    const double near = 0.1 * std::exp(random.unit() * std::log(5000.0));
    const double thin = random.below(3) == 0 ? 0.0 : std::exp(random.between(-20.0, 8.0));
    const Span needed{near, std::min(near * (1.0 + thin), 500.0)};
    const Slices slices = made(slicing, needed);
    EXPECT_GE(slices.slice_of(static_cast<float>(needed.far_m)), 0);
    EXPECT_GE(slices.slice_of(static_cast<float>(needed.near_m)), 0);
    EXPECT_LE(slices.boundaries.back(), 500.0f);
    const Span telling = deciding_span(slicing, needed);
    EXPECT_EQ(made(slicing, telling).boundaries, slices.boundaries) << "what tells slices apart makes the same";
  }
}

// --- Cells of a shape ---

GridSpec cubical(Scheme scheme, Vec2i tiles) {
  GridSpec spec;
  spec.tiles = {{0, 0}, tiles};
  spec.slices.scheme = scheme;
  spec.slices.far_m = 100.0;
  return spec;
}

TEST(CubicalCells, have_the_slices_of_olssons_formula) {
  const view::Frame frame = frame_in({false, -1.0, 1.0, -0.5625, 0.5625, 0.1, 100.0});
  const GridSpec spec = cubical(Scheme::cubical, {16, 9});
  const ScreenGrid grid = make_grid(spec, grid_inputs(spec, frame, 0.0, {}, {})).screen();
  const double ratio = 1.0 + 2.0 * 0.5625 / 9.0;  // 1 + 2 tan(theta) / S_y
  const int slices = grid.slices.count();
  EXPECT_EQ(slices, static_cast<int>(std::ceil(std::log(1000.0) / std::log(ratio))));
  for (int k = 1; k <= slices; ++k)
    EXPECT_NEAR(grid.slices.boundaries[static_cast<std::size_t>(k)], 0.1 * std::pow(ratio, k),
                1e-5 * std::pow(ratio, k));
  for (int k = 1; k < slices; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const float near = grid.slices.boundaries[at], height = (grid.tiles.y_max(0) - grid.tiles.y_min(0)) * near;
    EXPECT_NEAR((grid.slices.boundaries[at + 1] - near) / height, 1.0, 1e-4);
  }
}

TEST(CubicalCells, from_a_first_slice_on_need_fewer_slices) {
  const view::Frame frame = frame_in({false, -1.0, 1.0, -0.5625, 0.5625, 0.1, 100.0});
  const GridSpec all = cubical(Scheme::cubical, {16, 9}), first = cubical(Scheme::cubical_first, {16, 9});
  const ScreenGrid grid = make_grid(first, grid_inputs(first, frame, 0.0, {}, {})).screen();
  EXPECT_FLOAT_EQ(grid.slices.boundaries[1], 5.0f);
  EXPECT_NEAR(grid.slices.boundaries[2], 5.0f * 1.125f, 1e-5f);
  EXPECT_LT(grid.slices.count(), make_grid(all, grid_inputs(all, frame, 0.0, {}, {})).screen().slices.count() / 2);
}

TEST(CubicalCells, of_tiles_follow_from_slices) {
  const view::Frame frame = frame_in({false, -1.0, 1.0, -0.5625, 0.5625, 0.1, 400.0});
  GridSpec spec;
  spec.tiles = {{0, 0}, {0, 0}, 1.0};
  spec.slices.scheme = Scheme::exponential;
  spec.slices.count = 64;
  const ScreenGrid grid = make_grid(spec, grid_inputs(spec, frame, 0.0, {}, {})).screen();
  // 4000^(1/64) - 1 = 0.1384; 1.125 / 0.1384 = 8.13 tiles.
  EXPECT_EQ(grid.tiles.count, Vec2i(14, 8));
  spec.slices.count = 24;  // of DOOM: 1.125 / 0.4130 = 2.7
  EXPECT_EQ(make_grid(spec, grid_inputs(spec, frame, 0.0, {}, {})).screen().tiles.count, Vec2i(5, 3));
}

TEST(CubicalCells, of_an_orthographic_camera_are_as_deep_as_a_tile_is_high) {
  const view::Frame frame = frame_in(k_flat);
  GridSpec spec = cubical(Scheme::cubical, {16, 8});
  const ScreenGrid grid = make_grid(spec, grid_inputs(spec, frame, 0.0, {}, {})).screen();
  EXPECT_EQ(grid.slices.count(), 40) << "from 0.5 to 100 m in slices of 2.5 m";
  EXPECT_FLOAT_EQ(grid.slices.boundaries[3] - grid.slices.boundaries[2], 2.5f);
}

TEST(CubicalCells, are_as_many_in_all_frames_of_a_path) {
  view::Frame frame = frame_in({false, -1.0, 1.0, -0.5625, 0.5625, 0.1, 100.0});
  const GridSpec spec = cubical(Scheme::cubical, {16, 9});
  const GridInputs first = grid_inputs(spec, frame, 0.0, {}, {});
  frame.projection.top = 0.3;  // zooms in
  frame.projection.bottom = -0.3;
  GridInputs later = grid_inputs(spec, frame, 0.0, {}, {});
  EXPECT_NE(make_grid(spec, first).cell_count(), make_grid(spec, later).cell_count());
  later.shape = first.shape;
  EXPECT_EQ(make_grid(spec, first).cell_count(), make_grid(spec, later).cell_count());
}

TEST(CubicalCells, that_cannot_be_are_refused_by_the_key) {
  const auto refused = [](const GridSpec& spec, const view::Projection& projection) -> std::string {
    try {
      make_grid(spec, grid_inputs(spec, frame_in(projection), 0.0, {}, {}));
    } catch (const Error& error) {
      return error.where();
    }
    return "accepted";
  };
  GridSpec fine = cubical(Scheme::cubical, {640, 360});
  fine.slices.far_m = 1e9;
  EXPECT_EQ(refused(fine, k_wide), "slices.scheme") << "too many slices";
  EXPECT_EQ(refused(cubical(Scheme::cubical_first, {16, 9}), k_flat), "slices.scheme");
  GridSpec tiles = cubical(Scheme::linear, {0, 0});
  tiles.tiles.aspect = 1.0;
  EXPECT_EQ(refused(tiles, k_wide), "tiles.aspect");
  tiles.slices.scheme = Scheme::exponential;
  EXPECT_EQ(refused(tiles, k_flat), "tiles.aspect");
  EXPECT_EQ(refused(tiles, k_wide), "accepted");
  GridSpec step = cubical(Scheme::exponential, {16, 9});
  step.slices.fit = Fit{Fit::To::lights, 0.0, 1.001};
  EXPECT_EQ(refused(step, k_wide), "slices.fit.step");
}

}  // namespace
}  // namespace clusterbench::grid
