// SIMD variants give the same lists on every instruction set that this machine has.

#include <gtest/gtest.h>

#include "assign/each_target.h"
#include "assign/grid_cull/frustum_cull.h"
#include "assign/lists/list_builder.h"
#include "assign/settings.h"
#include "core/random.h"
#include "effort.h"
#include "geom/light_meets_cell.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::assign {
namespace {

using testing::on_each_target;
using testing::Setting;

struct RandomSpans {
  std::uint32_t rows, columns;
  struct Span {
    std::uint32_t row, first, last, light;
  };
  std::vector<Span> spans;
};

RandomSpans random_spans(std::uint32_t rows, std::uint32_t columns, std::uint32_t lights, std::uint64_t seed,
                         std::uint32_t longest) {
  SplitMix64 random(seed);
  RandomSpans out{rows, columns, {}};
  for (std::uint32_t light = 0; light < lights; ++light)
    for (std::uint32_t row = 0; row < rows; ++row) {
      if (random.below(3) != 0) continue;
      const auto a = static_cast<std::uint32_t>(random.below(columns)),
                 b = static_cast<std::uint32_t>(random.below(columns));
      const std::uint32_t first = std::min(a, b);
      out.spans.push_back({row, first, std::min(std::max(a, b), first + longest - 1), light});
    }
  return out;
}

Lists by_scattering(const RandomSpans& spans) {
  PairBuffer pairs;
  Lists lists;
  pairs.start(spans.rows * spans.columns);
  for (const auto& s : spans.spans) pairs.add_row(s.row * spans.columns + s.first, s.last - s.first + 1, s.light);
  pairs.finish(lists);
  return lists;
}

// In bands of this many rows.
Lists by_compression(const RandomSpans& spans, std::uint32_t band_rows, ListBuilder& compressed) {
  Lists lists;
  const std::uint32_t bands = spans.rows / band_rows;
  compressed.start(bands, band_rows, spans.columns, lists);
  for (std::uint32_t band = 0; band < bands; ++band) {
    for (const auto& s : spans.spans)
      if (s.row / band_rows == band) compressed.add(s.row % band_rows, s.first, s.last, s.light);
    compressed.finish_band();
  }
  compressed.finish();
  return lists;
}

TEST(ListBuilder, are_those_of_a_pair_buffer_on_every_target) {
  on_each_target([](const std::string& target) {
    ListBuilder compressed;
    for (const auto& [band_rows, rows, columns, lights] : {std::array<std::uint32_t, 4>{1, 1, 1, 1},
                                                           {1, 3, 7, 0},
                                                           {5, 5, 30, 17},
                                                           {8, 40, 12, 64},
                                                           {1, 2, 300, 65},
                                                           {2, 8, 64, 200},
                                                           {17, 17, 1, 200},
                                                           {4, 12, 130, 5}})
      for (const std::uint32_t longest : {columns, 5u}) {
        const RandomSpans spans = random_spans(rows, columns, lights, longest + 1, longest);
        EXPECT_EQ(by_compression(spans, band_rows, compressed), by_scattering(spans))
            << target << ", " << rows << " x " << columns << ", " << lights;
      }
  });
}

struct Answer {
  Lists lists;
  std::uint64_t tests, fallbacks;
  std::size_t scratch_bytes;
};

Answer answer_of(const std::string& name, const Params& params, const Setting& setting) {
  const auto assigner = find_assigner(name)->make(params);
  assigner->build(setting.grid);
  Lists lists;
  assigner->assign({setting.frame, view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame))}, lists);
  return {std::move(lists), assigner->tests_done(), assigner->fallbacks(), assigner->scratch_bytes()};
}

std::vector<grid::GridSpec> odd_box_grids(grid::Kind kind) {
  std::vector<grid::GridSpec> specs;
  if (kind == grid::Kind::world)
    for (const Vec3i& cells : {Vec3i{1, 1, 1}, Vec3i{131, 2, 3}, Vec3i{3, 70, 2}, Vec3i{2, 5, 90}})
      specs.push_back(testing::settings::box_spec(kind, cells));
  else
    for (const Vec3i& cells : {Vec3i{4, 4, 2}, Vec3i{132, 4, 2}, Vec3i{8, 72, 6}, Vec3i{16, 8, 16}})
      specs.push_back(testing::settings::box_spec(kind, cells));
  return specs;
}

// Grids as they are not built for vectors: narrow ones and ones wider than any vector, tiles clipped at the edge, a
// view in which a tile's plane is more than a right angle away from another's, slices that begin at the eye.
std::vector<grid::GridSpec> odd_grids(grid::Kind kind) {
  using grid::Scheme;
  if (kind == grid::Kind::world || kind == grid::Kind::cascades) return odd_box_grids(kind);
  std::vector<grid::GridSpec> specs{testing::settings::screen_spec(kind, {1, 1}, Scheme::exponential, 1, 0.1),
                                    testing::settings::screen_spec(kind, {131, 2}, Scheme::exponential, 6, 0.1),
                                    testing::settings::screen_spec(kind, {3, 70}, Scheme::linear, 3, 0.1),
                                    testing::settings::screen_spec(kind, {16, 9}, Scheme::exponential_first, 8, 0.1)};
  specs.back().tiles = {{48, 64}, {0, 0}};
  specs.push_back(specs.back());
  specs.back().slices = {.scheme = Scheme::list, .count = 3, .boundaries_m = {0, 0.1, 5, 90}};
  return specs;
}

// Points whose sphere passes through a corner of a box, or ends at a side of one, up to a few steps of the range.
// Without padding rounding decides.
std::vector<scene::WorldLight> nudged_points(const grid::Grid& grid, const view::Space& space, std::uint64_t seed) {
  std::vector<scene::WorldLight> lights;
  testing::Random random(seed);
  for (int i = 0; i < 200; ++i) {
    const std::uint32_t cell = testing::touching::random_cell(grid, random);
    const auto box = std::get<geom::Box>(grid.cell(cell));
    const Vec3f corner = i % 2 == 0 ? box.lo : box.hi;
    Vec3f gap(static_cast<float>(random.between(-9, 9)), static_cast<float>(random.between(-9, 9)),
              static_cast<float>(random.between(-9, 9)));
    for (int axis = 0; axis < 3; ++axis)
      if (random.unit() < 0.4) gap[axis] = 0.0f;
    const Vec3f center = corner + gap, back = center - corner;
    float range = std::sqrt(back.x * back.x + back.y * back.y + back.z * back.z);
    for (int step = -3; step < i % 7 - 3; ++step) range = std::nextafter(range, 1e9f);
    lights.push_back(testing::point_light(testing::touching::in_world(Vec3d(center), space), range));
  }
  return lights;
}

struct View {
  const char* name;
  view::Projection projection;
};

std::vector<View> odd_views(const AssignerDescriptor& row) {
  const auto wide = [](double deg) { return testing::perspective(deg * testing::settings::k_degree, 1.2, 0.1, 300); };
  if (row.takes(grid::Kind::cascades) || row.takes(grid::Kind::world)) return {{"any view", wide(50)}};
  std::vector<View> views{{"50 degrees", wide(50)}, {"165 degrees", wide(165)}};
  if (row.orthographic) views.push_back({"orthographic", {true, -7, 31, 4, 11, 0.1, 300}});
  return views;
}

// Beside the usual lights some that hold nearly everything, or end at the eye or at the depth of 5 m by a hair.
std::vector<Setting> odd_settings(const AssignerDescriptor& row, std::uint64_t seed) {
  std::vector<Setting> settings;
  for (const grid::GridSpec& spec : odd_grids(row.kinds.front()))
    for (const View& view : odd_views(row)) {
      Setting setting;
      setting.name = spec.name() + ", " + view.name;
      setting.frame = testing::frame_of(view.projection, {1280, 717}, {});
      setting.grid = testing::grid_of(spec, setting.frame);
      testing::settings::add_lights(setting, row, seed);
      std::vector<scene::WorldLight> more;
      for (const double size : {1.0, 1e3, 1e6, 1e9, 1e12, 9e14})
        for (const double end : {0.0, 0.1, 5.0})
          for (const double nudge : {-1e-6, -6e-8, 0.0, 6e-8, 1e-6})
            for (const Vec3d& place : {Vec3d{0, 0, -1}, Vec3d{0, 0, 1}, Vec3d{0.6, 0, -0.8}, Vec3d{1, 0, 0}})
              more.push_back(testing::point_light((size + end) * place, size * (1 + nudge)));
      if (std::holds_alternative<geom::Box>(setting.grid.cell(0))) {
        const auto nudged = nudged_points(setting.grid, grid::space_of(setting.grid, setting.frame), seed);
        more.insert(more.end(), nudged.begin(), nudged.end());
      }
      setting.frame.lights.insert(setting.frame.lights.begin(), more.begin(), more.end());
      setting.frame.points += static_cast<std::uint32_t>(more.size());
      settings.push_back(std::move(setting));
    }
  return settings;
}

// The defaults, each choice, and no or too much padding where there is a choice.
std::vector<Params> params_of(const AssignerDescriptor& row) {
  std::vector<Params> all = testing::params_of(row);
  if (all.front().values().contains("inflation"))
    for (const double inflation : {0.0, 1e5})
      all.emplace_back(row.params, std::map<std::string, ParamValue>{{"inflation", inflation}});
  return all;
}

void expect_same_lists(const std::string& variant, const std::string& reference, const Setting& setting) {
  static std::size_t turn = 0;  // under sanitizers each setting with a third of them
  for (const Params& params : test::some(params_of(*find_assigner(variant)), 3, turn++ % 3)) {
    const Lists expected = answer_of(reference, params, setting).lists;
    const Answer best = answer_of(variant, params, setting);
    EXPECT_GT(expected.pair_count(), 0U);
    on_each_target([&](const std::string& target) {
      const Answer answer = answer_of(variant, params, setting);
      EXPECT_TRUE(answer.lists == expected) << "LISTS";
      EXPECT_TRUE(answer.tests == best.tests && answer.fallbacks == best.fallbacks)
          << target << ", " << setting.name << ", "
          << (params.values().contains("spot")
                  ? "spot: " + params.text("spot") + ", inflation: " + std::to_string(params.number("inflation"))
                  : "");
      EXPECT_EQ(answer.scratch_bytes, best.scratch_bytes) << target << ", " << setting.name;
    });
  }
}

// With lights of all sizes, spots, and lights that touch cells by a hair.
void expect_same_lists_on_every_target(const std::string& variant, const std::string& reference) {
  for (const std::uint64_t seed : test::some(std::vector<std::uint64_t>{5, 6}))
    for (const Setting& setting : test::some(testing::settings_for(*find_assigner(variant), seed)))
      expect_same_lists(variant, reference, setting);
}

void expect_same_lists_at_any_size(const std::string& variant, const std::string& reference) {
  for (const std::uint64_t seed : test::some(std::vector<std::uint64_t>{8, 9, 10}))
    for (const Setting& setting : testing::settings_of_any_size(*find_assigner(variant), test::tries(120), seed))
      expect_same_lists(variant, reference, setting);
}

void expect_same_lists_on_odd_grids(const std::string& variant, const std::string& reference) {
  for (const Setting& setting : test::some(odd_settings(*find_assigner(variant), 7)))
    expect_same_lists(variant, reference, setting);
}

TEST(ExactFast, gives_the_lists_of_exact_on_every_target) {
  expect_same_lists_on_every_target("exact-fast", "exact");
}

TEST(ExactFast, gives_the_lists_of_exact_on_clipped_tiles) {
  const AssignerDescriptor& row = *find_assigner("exact-fast");
  grid::GridSpec spec =
      testing::settings::screen_spec(grid::Kind::frustum, {16, 9}, grid::Scheme::exponential_first, 8, 0.1);
  spec.tiles = {{48, 64}, {0, 0}};
  for (const View& view : odd_views(row)) {
    Setting setting;
    setting.frame = testing::frame_of(view.projection, {1280, 717}, {});
    setting.grid = testing::grid_of(spec, setting.frame);
    testing::settings::add_lights(setting, row, 7);
    const Lists expected = answer_of("exact", Params(find_assigner("exact")->params), setting).lists;
    EXPECT_GT(expected.pair_count(), 1000U);
    EXPECT_EQ(answer_of("exact-fast", Params(row.params), setting).lists, expected) << view.name;
  }
}

TEST(ExactFast, gives_the_lists_of_exact_and_of_each_cell_for_lights_of_any_size) {
  for (const Setting& setting : odd_settings(*find_assigner("exact-fast"), 7)) {
    if (setting.grid.cell_count() > 1) continue;
    const view::LightArrays lights = view::lights_in(setting.frame, setting.frame.view_space);
    std::vector<std::uint32_t> touching;
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      if (!lights.is_empty(light) &&
          geom::decide_meets(lights.volume(light), setting.grid.cell(0)) != geom::Verdict::no)
        touching.push_back(light);
    for (const std::string name : {"exact", "exact-fast"})
      EXPECT_EQ(answer_of(name, Params(find_assigner(name)->params), setting).lists.lights, touching)
          << name << ", " << setting.name;
  }
}

// Single precision has no powers of such numbers, and every row would be uncertain: minutes a frame, cell by cell.
TEST(ExactFast, decides_no_more_than_exact_does_on_grids_beyond_single_precision) {
  const AssignerDescriptor& row = *find_assigner("exact-fast");
  const auto grid = [](double near_m, double far_m) {
    grid::GridSpec spec =
        testing::settings::screen_spec(grid::Kind::frustum, {40, 22}, grid::Scheme::exponential, 12, near_m);
    spec.slices.far_m = far_m;
    return spec;
  };
  for (const grid::GridSpec& spec : {grid(1e-9, 400.0), grid(0.1, 1e10)}) {
    Setting setting;
    setting.frame = testing::frame_of(testing::perspective(0.9, 16.0 / 9.0, 0.1, 300), {1280, 717}, {});
    setting.grid = testing::grid_of(spec, setting.frame);
    testing::settings::add_lights(setting, row, 7);
    const Answer expected = answer_of("exact", Params(find_assigner("exact")->params), setting);
    EXPECT_GT(expected.lists.pair_count(), 1000U);
    for (const double threads : {1.0, 3.0}) {
      const Answer answer = answer_of("exact-fast", Params(row.params, {{"threads", threads}}), setting);
      EXPECT_EQ(answer.lists, expected.lists);
      EXPECT_LE(answer.fallbacks, expected.fallbacks);
      EXPECT_LE(answer.tests, expected.tests);
    }
  }
}

// Where single precision proves nothing of a spot, all rows of the picture, and all columns of these, would be looked
// at.
TEST(ExactFast, does_no_more_than_exact_for_spots_of_which_little_is_proven) {
  const double far = 32.0, half = 16.0;
  constexpr int k_rows = test::tries(512);
  const view::Projection views[] = {{true, -half, half, -half, half, 0.0, far},
                                    testing::perspective(1.5, 1.0, 0.1, far)};
  struct Kind {
    double range, angle;
  };
  // Ends that touch slice planes, as good as no angle, ranges beyond what vectors are for, a world as small.
  for (const auto& [range, angle] :
       {Kind{1.0, M_PI / 4}, Kind{1.0, 1e-7}, Kind{2e9, 0.01}, Kind{1e12, 0.01}, Kind{1e-9, 0.5}})
    for (const view::Projection& view : views) {
      Setting setting;
      setting.frame = testing::frame_of(view, {64, 2 * k_rows}, {});
      grid::GridSpec spec =
          testing::settings::screen_spec(grid::Kind::frustum, {16, k_rows}, grid::Scheme::linear, 32, 1.0);
      spec.slices.far_m = far + 1.0;
      setting.grid = testing::grid_of(spec, setting.frame);
      for (int i = 0; i < 12; ++i) {
        const Vec3d at{i % 5 - 2, i % 7 - 3, -3 - i % 9};
        setting.frame.lights.push_back(testing::spot_light(at, range, {0, 0, -1}, angle));
      }
      const Answer expected = answer_of("exact", Params(find_assigner("exact")->params), setting);
      const Answer found = answer_of("exact-fast", Params(find_assigner("exact-fast")->params), setting);
      EXPECT_EQ(found.lists, expected.lists);
      EXPECT_GE(expected.lists.pair_count(), 12U);
      EXPECT_LE(found.fallbacks, 2 * expected.fallbacks) << range << ", " << angle << ", " << view.orthographic;
      if (range == 1.0) {
        EXPECT_LE(found.tests, 4 * expected.tests) << range << ", " << angle << ", " << view.orthographic;
      }
    }
}

// The product of a small light's numbers and a wide view's is less than single precision has.
TEST(ExactFast, gives_the_lists_of_exact_for_small_lights_in_wide_orthographic_views) {
  for (const double half_width : {1e3, 9e8, 1e12, 1e15}) {
    std::vector<scene::WorldLight> points, spots;
    for (const double range : {1e-9, 1e-4})
      for (const double side : {1.0, -1.0}) {
        const Vec3d at{side * 1e-4, 1e-4, -1.5e-3};
        points.push_back(testing::point_light(at, range));
        spots.push_back(testing::spot_light(at, range, {side, 0, 0}, 0.5));
      }
    points.insert(points.end(), spots.begin(), spots.end());
    Setting setting;
    setting.frame =
        testing::frame_of({true, -half_width, half_width, -half_width, half_width, 1e-4, 0.01}, {400, 400}, points);
    grid::GridSpec spec = testing::settings::screen_spec(grid::Kind::frustum, {4, 4}, grid::Scheme::linear, 4, 1e-4);
    spec.slices.far_m = 0.01;
    setting.grid = testing::grid_of(spec, setting.frame);
    const auto lists_of = [&](const char* name) {
      return answer_of(name, Params(find_assigner(name)->params), setting).lists;
    };
    const Lists expected = lists_of("exact");
    EXPECT_GE(expected.pair_count(), points.size()) << half_width;
    EXPECT_EQ(lists_of("exact-fast"), expected) << half_width;
  }
}

// Far to the side of the view axis tile planes are slopes with few digits left for their distances.
TEST(ExactFast, gives_the_lists_of_exact_on_narrow_tiles_far_aside) {
  const AssignerDescriptor& row = *find_assigner("exact-fast");
  for (const std::uint64_t seed : {1u, 2u}) {
    Setting setting;
    setting.frame = testing::frame_of(testing::perspective(0.9, 1.2, 0.1, 300), {4000, 717}, {});
    setting.frame.projection.left = 3.0;
    setting.frame.projection.right = 3.7;
    setting.grid = testing::grid_of(
        testing::settings::screen_spec(grid::Kind::frustum, {900, 3}, grid::Scheme::exponential, 6, 0.1),
        setting.frame);
    testing::settings::add_lights(setting, row, seed);
    const Lists expected = answer_of("exact", Params(find_assigner("exact")->params), setting).lists;
    EXPECT_GT(expected.pair_count(), 1000U);
    EXPECT_EQ(answer_of("exact-fast", Params(row.params), setting).lists, expected);
  }
}

// Lights whose surface nearly goes through the eye, or nearly touches one of the planes and lines through it that the
// tangents are measured by: a hair this way or that, their tangents touch far away or nowhere.
std::vector<scene::WorldLight> lights_nearly_at_the_eye(int count, std::uint64_t seed) {
  testing::Random random(seed);
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < count; ++i) {
    const Vec3d centre = random.log_between(0.05, 400) * random.direction();
    const Vec3d square = centre * centre;
    const double from_eye = square.x + square.y + square.z;
    const double touching[] = {from_eye, square.y + square.z, square.x + square.z, square.z};
    const double hair = random.log_between(1e-9, 0.1) * (random.unit() < 0.5 ? -1 : 1);
    lights.push_back(testing::point_light(centre, std::sqrt(std::max(0.0, touching[i % 4] + hair * from_eye))));
  }
  return lights;
}

TEST(ExactFast, gives_the_lists_of_exact_for_lights_nearly_at_the_eye) {
  const AssignerDescriptor& row = *find_assigner("exact-fast");
  for (const double fov : {60 * testing::settings::k_degree, 150 * testing::settings::k_degree})
    for (const double near_m : {1e-3, 0.5}) {
      Setting setting;
      setting.frame = testing::frame_of(testing::perspective(fov, 16.0 / 9.0, near_m, 300), {1920, 1080},
                                        lights_nearly_at_the_eye(1000, 11));
      setting.grid = testing::grid_of(
          testing::settings::screen_spec(grid::Kind::frustum, {24, 14}, grid::Scheme::exponential, 24, near_m),
          setting.frame);
      const Lists expected = answer_of("exact", Params(find_assigner("exact")->params), setting).lists;
      EXPECT_GT(expected.pair_count(), 100'000U);
      on_each_target([&](const std::string& target) {
        const Answer answer = answer_of("exact-fast", Params(row.params), setting);
        EXPECT_EQ(answer.lists, expected) << target << ", " << fov << ", " << near_m;
      });
    }
}

// Lights that a tile plane nearly touches close to the eye, and that would reach to the eye itself, give or take a few
// roundoffs, with the slack that exact-fast gives them: in single precision the eye is inside or outside by chance.
std::vector<scene::WorldLight> lights_touched_at_the_eye(const grid::ScreenGrid& screen, int count,
                                                         std::uint64_t seed) {
  testing::Random random(seed);
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < count; ++i) {
    const std::vector<float>& planes = screen.tiles.y;
    const double slope = planes[static_cast<std::size_t>(random.unit() * static_cast<double>(planes.size()))];
    const auto askew = [&] { return random.log_between(1e-7, 1e-2) * (random.unit() < 0.5 ? -1 : 1); };
    const Vec3d up = glm::normalize(Vec3d{askew(), 1, slope + askew()});  // from the plane; depth is -z
    const double distance = random.log_between(0.5, 2000) * (random.unit() < 0.5 ? -1 : 1);
    const double slack = 2 * k_slice_rows_roundoffs + random.between(-40, 40);
    lights.push_back(testing::point_light(distance * up, std::fabs(distance) * (1 - slack * 0x1p-24)));
  }
  return lights;
}

TEST(ExactFast, gives_the_lists_of_exact_for_lights_that_a_tile_plane_touches_at_the_eye) {
  const AssignerDescriptor& row = *find_assigner("exact-fast");
  for (const double near_m : {1e-4, 4e-3}) {
    Setting setting;
    setting.frame = testing::frame_of({false, -0.74, 0.78, -0.45, 0.45, near_m, 300}, {1000, 587}, {});
    grid::GridSpec spec =
        testing::settings::screen_spec(grid::Kind::frustum, {14, 9}, grid::Scheme::exponential_first, 5, near_m);
    spec.slices.first_m = 4;
    setting.grid = testing::grid_of(spec, setting.frame);
    setting.frame.lights = lights_touched_at_the_eye(setting.grid.screen(), 20000, 3);
    setting.frame.points = static_cast<std::uint32_t>(setting.frame.lights.size());
    const Lists expected = answer_of("exact", Params(find_assigner("exact")->params), setting).lists;
    EXPECT_GT(expected.pair_count(), 100'000U);
    EXPECT_EQ(answer_of("exact-fast", Params(row.params), setting).lists, expected) << near_m;
  }
}

TEST(BoundsFast, gives_the_lists_of_bounds_on_every_target) {
  expect_same_lists_on_every_target("bounds-fast", "bounds");
  expect_same_lists_on_odd_grids("bounds-fast", "bounds");
}

TEST(AabbFast, gives_the_lists_of_aabb_on_every_target) {
  expect_same_lists_on_every_target("aabb-fast", "aabb");
  expect_same_lists_on_odd_grids("aabb-fast", "aabb");
}

TEST(SphereRefinementFast, gives_the_lists_of_sphere_refinement_on_every_target) {
  expect_same_lists_on_every_target("sphere-refinement-fast", "sphere-refinement");
  expect_same_lists_on_odd_grids("sphere-refinement-fast", "sphere-refinement");
}

TEST(DistanceFast, gives_the_lists_of_distance_on_every_target) {
  expect_same_lists_on_every_target("distance-fast", "distance");
  expect_same_lists_on_odd_grids("distance-fast", "distance");
}

TEST(CascadesFast, gives_the_lists_of_cascades_on_every_target) {
  expect_same_lists_on_every_target("cascades-fast", "cascades");
  expect_same_lists_on_odd_grids("cascades-fast", "cascades");
}

TEST(WorldGridFast, gives_the_lists_of_world_grid_on_every_target) {
  expect_same_lists_on_every_target("world-grid-fast", "world-grid");
  expect_same_lists_on_odd_grids("world-grid-fast", "world-grid");
}

TEST(BoundsFast, gives_the_lists_of_bounds_at_all_scales_of_the_domain) {
  expect_same_lists_at_any_size("bounds-fast", "bounds");
}

TEST(AabbFast, gives_the_lists_of_aabb_at_all_scales_of_the_domain) {
  expect_same_lists_at_any_size("aabb-fast", "aabb");
}

TEST(SphereRefinementFast, gives_the_lists_of_sphere_refinement_at_all_scales_of_the_domain) {
  expect_same_lists_at_any_size("sphere-refinement-fast", "sphere-refinement");
}

TEST(DistanceFast, gives_the_lists_of_distance_at_all_scales_of_the_domain) {
  expect_same_lists_at_any_size("distance-fast", "distance");
}

TEST(CascadesFast, gives_the_lists_of_cascades_at_all_scales_of_the_domain) {
  expect_same_lists_at_any_size("cascades-fast", "cascades");
}

TEST(WorldGridFast, gives_the_lists_of_world_grid_at_all_scales_of_the_domain) {
  expect_same_lists_at_any_size("world-grid-fast", "world-grid");
}

TEST(ExactFast, gives_the_lists_of_exact_at_all_scales_of_the_domain) {
  expect_same_lists_at_any_size("exact-fast", "exact");
}

// The same lights many times over, so that there is work for threads.
Setting repeated(Setting setting, int times) {
  const std::vector<scene::WorldLight> once = setting.frame.lights;
  const auto spots = once.begin() + setting.frame.points;
  setting.frame.lights.clear();
  for (int i = 0; i < times; ++i) setting.frame.lights.insert(setting.frame.lights.end(), once.begin(), spots);
  setting.frame.points = static_cast<std::uint32_t>(setting.frame.lights.size());
  for (int i = 0; i < times; ++i) setting.frame.lights.insert(setting.frame.lights.end(), spots, once.end());
  return setting;
}

TEST(ExactFast, gives_the_same_lists_on_any_number_of_threads) {
  const std::vector<Setting> settings = testing::settings_for(*find_assigner("exact-fast"), 7);
  for (std::size_t i = 0; i < settings.size(); i += 3) {
    const Setting setting = repeated(settings[i], 2 + test::tries(8));
    const AssignerDescriptor& row = *find_assigner("exact-fast");
    const Lists expected = answer_of(row.name, Params(row.params), setting).lists;
    EXPECT_GT(expected.pair_count(), 1000U) << setting.name;
    for (const double threads : {2.0, 5.0})
      EXPECT_EQ(answer_of(row.name, Params(row.params, {{"threads", threads}}), setting).lists, expected)
          << setting.name << ", " << threads;
  }
}

}  // namespace
}  // namespace clusterbench::assign
