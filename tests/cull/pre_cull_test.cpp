// Which lights a pre-cull removes, against arithmetic. tests/stress/pre_cull_test.cpp holds it against the truth.

#include "cull/pre_cull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cull/view_planes.h"

namespace clusterbench::cull {
namespace {

// A camera at some place, 90 degrees wide and high, 1 to 100 m; square.
struct Setting {
  view::Frame frame;
  grid::GridSpec spec;

  explicit Setting(grid::Kind kind = grid::Kind::frustum, bool orthographic = false) {
    frame.viewport = {100, 100};
    frame.projection = {orthographic, -1.0, 1.0, -1.0, 1.0, 1.0, 100.0};
    spec.kind = kind;
    spec.tiles.pixels = {10, 10};
    spec.slices.scheme = grid::Scheme::linear;
    spec.slices.far_m = 50.0;
  }

  Setting& point(const Vec3d& place, double range_m) {
    scene::WorldLight light;
    light.position = place;
    light.range_m = range_m;
    frame.lights.push_back(light);
    return *this;
  }
  Setting& spot(const Vec3d& place, const Vec3d& direction, double range_m, double half_angle_rad) {
    point(place, range_m);
    frame.lights.back().type = scene::LightType::spot;
    frame.lights.back().direction = direction;
    frame.lights.back().outer_cone_rad = half_angle_rad;
    return *this;
  }

  grid::Grid grid() const {
    return grid::make_grid(spec, grid::grid_inputs(spec, frame, 50.0, Vec3d(-60.0), Vec3d(60.0)));
  }

  FrameCull culled(const PreCullSpec& steps) {
    frame.count_types();
    const grid::Grid made = grid();
    const view::LightArrays lights = view::lights_in(frame, grid::space_of(made, frame));
    FrameCull out;
    PreCull(steps, {}).cull(frame, made, lights, out);
    PreCull::give_source(lights, out);
    return out;
  }
  bool is_conservative(const PreCullSpec& steps) {
    const FrameCull out = culled(steps);
    const grid::Grid made = grid();
    const view::LightArrays lights = view::lights_in(frame, grid::space_of(made, frame));
    return PreCull(steps, {}).is_conservative(frame, made, lights, out);
  }
  std::vector<std::uint32_t> kept(const PreCullSpec& steps) { return culled(steps).kept; }
};

using Indices = std::vector<std::uint32_t>;
const PreCullSpec k_frustum{{FrustumStep{}}};
const double k_root = std::sqrt(2.0);

TEST(FrustumCull, removes_balls_beyond_each_plane_and_keeps_those_that_touch_it) {
  for (const grid::Kind kind : {grid::Kind::frustum, grid::Kind::distance, grid::Kind::cascades, grid::Kind::world}) {
    Setting setting(kind);
    setting.spec.slices.near_m = 1.0;
    const double depth = 10.0, r = 2.0, beside = depth + r * k_root;
    for (const double share : {1.0 - 1e-3, 1.0 + 1e-3}) {
      setting.point({beside * share, 0.0, -depth}, r).point({-beside * share, 0.0, -depth}, r);
      setting.point({0.0, beside * share, -depth}, r).point({0.0, -beside * share, -depth}, r);
      setting.point({0.0, 0.0, -1.0 + r * share}, r).point({0.0, 0.0, -(100.0 + r) * share}, r);
    }
    EXPECT_EQ(setting.kept(k_frustum), (Indices{0, 1, 2, 3, 4, 5})) << grid::kind_name(kind);
  }
}

TEST(FrustumCull, knows_where_an_orthographic_camera_ends) {
  Setting setting(grid::Kind::frustum, true);
  for (const double x : {2.9999, 3.0001, -2.9999, -3.0001}) setting.point({x, 0.5, -20.0}, 2.0);
  EXPECT_EQ(setting.kept(k_frustum), (Indices{0, 2}));
}

TEST(FrustumCull, looks_where_the_camera_looks) {
  for (const grid::Kind kind : {grid::Kind::frustum, grid::Kind::world}) {
    Setting setting(kind);
    setting.frame.view_space.origin = {10.0, 0.0, 0.0};
    setting.frame.view_space.rotation = Mat3d(Vec3d(0, 0, 1), Vec3d(0, 1, 0), Vec3d(-1, 0, 0));  // along -x: x is depth
    setting.point({-10.0, 0.0, 0.0}, 1.0).point({30.0, 0.0, 0.0}, 1.0).point({10.0, 0.0, 0.0}, 100.0);
    EXPECT_EQ(setting.kept(k_frustum), (Indices{0, 2})) << grid::kind_name(kind);
  }
}

TEST(FrustumCull, sees_the_ball_around_a_spots_cone_not_that_of_its_range) {
  Setting setting;
  // To the right of the view, shining to the right: the ball of its range reaches in.
  setting.spot({14.0, 0.0, -10.0}, {1.0, 0.0, 0.0}, 10.0, 0.3);
  setting.spot({14.0, 0.0, -10.0}, {-1.0, 0.0, 0.0}, 10.0, 0.3);
  EXPECT_EQ(setting.kept(k_frustum), (Indices{1}));
}

TEST(FrustumCull, keeps_what_has_no_end_and_lights_around_the_eye) {
  Setting setting;
  setting.point({0.0, 0.0, 500.0}, std::numeric_limits<double>::infinity()).point({0.0, 0.0, 0.0}, 5.0);
  EXPECT_EQ(setting.kept(k_frustum), (Indices{0, 1}));
}

TEST(FrustumCull, ends_with_the_camera_wherever_slices_begin_and_end) {
  for (const bool is_flat : {false, true}) {
    Setting setting(grid::Kind::frustum, is_flat);
    setting.frame.projection.near_m = 5.0;
    setting.frame.projection.far_m = 20.0;
    setting.spec.slices.near_m = 0.5;  // and they go on to 50 m
    setting.point({0.0, 0.0, -1.0}, 3.9).point({0.0, 0.0, -1.0}, 4.1);
    setting.point({0.0, 0.0, -30.0}, 9.9).point({0.0, 0.0, -30.0}, 10.1);
    EXPECT_EQ(setting.kept(k_frustum), (Indices{1, 3}));
  }
}

TEST(FrustumCull, removes_what_reaches_nothing) {
  Setting setting;
  setting.point({0.0, 0.0, -10.0}, 0.0).point({0.0, 0.0, -10.0}, 1e-9);
  EXPECT_EQ(setting.kept(k_frustum), (Indices{1}));
}

TEST(DistanceCull, removes_balls_that_begin_beyond_it) {
  Setting setting;
  setting.frame.view_space.origin = {1000.0, 0.0, 0.0};
  for (const double distance : {31.999, 32.001}) {
    setting.point(Vec3d(1000.0, 0.0, 0.0) + distance * Vec3d(0.6, 0.0, -0.8), 2.0);
    setting.point(Vec3d(1000.0, 0.0, 0.0) + distance * Vec3d(0.0, 0.0, 1.0), 2.0);  // behind the eye
  }
  EXPECT_EQ(setting.kept({{DistanceStep{30.0}}}), (Indices{0, 1}));
}

TEST(DistanceCull, is_conservative_where_no_cell_ends_farther_away) {
  const auto is_safe = [](Setting setting, double distance_m) {
    return setting.is_conservative({{DistanceStep{distance_m}}});
  };
  const double corner = 50.0 * std::sqrt(3.0);  // slopes 1 to both sides
  EXPECT_TRUE(is_safe(Setting(), corner * 1.0001));
  EXPECT_FALSE(is_safe(Setting(), corner * 0.9999));
  EXPECT_TRUE(is_safe(Setting(grid::Kind::distance), 50.0));
  EXPECT_FALSE(is_safe(Setting(grid::Kind::distance), 49.999));
  EXPECT_TRUE(is_safe(Setting(grid::Kind::frustum, true), std::sqrt(2502.0) * 1.0001));
  EXPECT_FALSE(is_safe(Setting(grid::Kind::frustum, true), std::sqrt(2502.0) * 0.9999));
  EXPECT_FALSE(is_safe(Setting(grid::Kind::world), 1e9));
}

TEST(PreCull, by_planes_is_conservative_where_cells_end_with_the_picture) {
  EXPECT_TRUE(Setting().is_conservative(k_frustum));
  EXPECT_TRUE(Setting(grid::Kind::distance).is_conservative(k_frustum));
  EXPECT_FALSE(Setting(grid::Kind::cascades).is_conservative(k_frustum));
  EXPECT_FALSE(Setting(grid::Kind::world).is_conservative(k_frustum));
  EXPECT_FALSE(Setting().is_conservative({{FrustumStep{}, DistanceStep{1.0}}})) << "all steps are";
}

TEST(PreCull, by_planes_is_conservative_while_no_light_is_at_depths_that_cells_have_and_the_camera_has_not) {
  const auto setting_with = [](double depth, double range_m) {
    Setting setting;
    setting.frame.projection.near_m = 5.0;
    setting.frame.projection.far_m = 20.0;
    setting.spec.slices.near_m = 2.0;  // to 50 m
    setting.point({0.0, 0.0, -depth}, range_m);
    return setting;
  };
  EXPECT_TRUE(setting_with(10.0, 1.0).is_conservative(k_frustum)) << "is in view";
  EXPECT_FALSE(setting_with(3.0, 1.0).is_conservative(k_frustum)) << "before the near plane, in the first slice";
  EXPECT_TRUE(setting_with(3.0, 2.5).is_conservative(k_frustum)) << "reaches beyond the near plane";
  EXPECT_TRUE(setting_with(0.5, 1.0).is_conservative(k_frustum)) << "before the first slice";
  EXPECT_TRUE(setting_with(3.0, 0.0).is_conservative(k_frustum)) << "reaches nothing";
  EXPECT_FALSE(setting_with(40.0, 1.0).is_conservative(k_frustum)) << "beyond the far plane, in a slice";
  EXPECT_TRUE(setting_with(60.0, 1.0).is_conservative(k_frustum)) << "beyond the last slice";
}

PreCullSpec limit(int lights, MostStep::Keep keep = MostStep::Keep::first, bool per_type = false) {
  return {{MostStep{lights, keep, per_type}}};
}

TEST(Limit, keeps_the_first_the_nearest_or_the_shallowest_lights) {
  Setting setting;
  setting.point({0, 0, -50}, 1).point({30, 0, -5}, 1).point({0, 0, -9}, 1).point({0, 2, 20}, 1).point({3, 0, 4}, 1);
  using Keep = MostStep::Keep;
  EXPECT_EQ(setting.kept(limit(2)), (Indices{0, 1}));
  EXPECT_EQ(setting.kept(limit(2, Keep::nearest)), (Indices{2, 4}));
  EXPECT_EQ(setting.kept(limit(3, Keep::shallowest)), (Indices{1, 3, 4})) << "behind the eye: depth 0";
  EXPECT_EQ(setting.kept(limit(2, Keep::shallowest)), (Indices{3, 4}));
  EXPECT_EQ(setting.kept(limit(5, Keep::nearest)), (Indices{0, 1, 2, 3, 4}));
  const FrameCull culled = setting.culled(limit(3, Keep::nearest));
  EXPECT_EQ(culled.dropped, (Indices{0, 1}));
  EXPECT_EQ(culled.removed, (Indices{2}));
}

TEST(Limit, sees_from_the_eye_in_the_world_too) {
  for (const grid::Kind kind : {grid::Kind::frustum, grid::Kind::world}) {
    Setting setting(kind);
    setting.frame.view_space.origin = {10.0, 0.0, 0.0};
    setting.frame.view_space.rotation = Mat3d(Vec3d(0, 0, 1), Vec3d(0, 1, 0), Vec3d(-1, 0, 0));  // along -x: x is depth
    setting.point({-10.0, 0.0, 0.0}, 1.0).point({5.0, 30.0, 0.0}, 1.0);
    EXPECT_EQ(setting.kept(limit(1, MostStep::Keep::nearest)), (Indices{0})) << grid::kind_name(kind);
    EXPECT_EQ(setting.kept(limit(1, MostStep::Keep::shallowest)), (Indices{1})) << grid::kind_name(kind);
  }
}

TEST(Limit, of_each_type_counts_points_and_spots_apart) {
  Setting setting;
  for (int i = 0; i < 3; ++i) setting.point({0, 0, -5.0 - i}, 1);
  for (int i = 0; i < 4; ++i) setting.spot({0, 0, -5.0 - i}, {0, 0, 1}, 1, 0.3);
  EXPECT_EQ(setting.kept(limit(2, MostStep::Keep::first, true)), (Indices{0, 1, 3, 4}));
  EXPECT_EQ(setting.kept(limit(3, MostStep::Keep::first, true)), (Indices{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(setting.kept(limit(4)), (Indices{0, 1, 2, 3}));
}

TEST(Limit, counts_lights_in_view_behind_a_cull_by_planes) {
  Setting setting;
  for (int i = 0; i < 4; ++i) setting.point({0, 0, 5.0 + i}, 1);  // behind the eye
  for (int i = 0; i < 3; ++i) setting.point({0, 0, -5.0 - i}, 1);
  const PreCullSpec in_view{{FrustumStep{}, MostStep{3}}}, fewer{{FrustumStep{}, MostStep{2}}};
  EXPECT_EQ(setting.culled(in_view).removed, (Indices{4, 0}));
  EXPECT_TRUE(setting.culled(in_view).dropped.empty());
  EXPECT_EQ(setting.culled(fewer).dropped, (Indices{6}));
}

TEST(Limit, is_conservative_in_frames_that_it_removes_nothing_from) {
  Setting setting;
  setting.point({0, 0, -5}, 1).point({0, 0, -6}, 1);
  EXPECT_TRUE(setting.is_conservative({{FrustumStep{}, MostStep{2}}}));
  EXPECT_FALSE(setting.is_conservative({{FrustumStep{}, MostStep{1}}}));
}

TEST(PreCull, steps_follow_each_other_and_each_tells_what_it_removes) {
  Setting setting;
  setting.point({0, 0, -10}, 1).point({0, 0, 10}, 1).point({0, 0, -40}, 1).point({0, 0, 45}, 1).point({0, 0, -5}, 1);
  const FrameCull planes_first = setting.culled({{FrustumStep{}, DistanceStep{20.0}}});
  EXPECT_EQ(planes_first.kept, (Indices{0, 4}));
  EXPECT_EQ(planes_first.removed, (Indices{2, 1}));
  const FrameCull distance_first = setting.culled({{DistanceStep{20.0}, FrustumStep{}}});
  EXPECT_EQ(distance_first.kept, (Indices{0, 4}));
  EXPECT_EQ(distance_first.removed, (Indices{2, 1}));
  EXPECT_EQ(setting.culled({{DistanceStep{41.0}}}).removed, (Indices{1}));
}

TEST(PreCull, hands_over_the_lights_that_are_kept_as_they_were) {
  Setting setting;
  setting.point({0, 0, 10}, 1).point({1, 2, -10}, 3).point({0, 0, 11}, 1).point({-1, 0, -20}, 2);
  setting.spot({0, 0, 30}, {0, 0, 1}, 2, 0.5).spot({0, 1, -30}, {0.6, 0, -0.8}, 4, 0.25);
  const FrameCull out = setting.culled(k_frustum);
  EXPECT_EQ(out.kept, (Indices{1, 3, 5}));
  EXPECT_EQ(out.lights.points.count, 2u);
  EXPECT_EQ(out.lights.spots.first, 2u);
  EXPECT_EQ(out.lights.spots.count, 1u);
  const view::LightArrays all = view::lights_in(setting.frame, setting.frame.view_space);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t from = out.kept[i];
    EXPECT_EQ(out.lights.x[i], all.x[from]);
    EXPECT_EQ(out.lights.y[i], all.y[from]);
    EXPECT_EQ(out.lights.z[i], all.z[from]);
    EXPECT_EQ(out.lights.radius[i], all.radius[from]);
    EXPECT_EQ(out.lights.reach[i], all.reach[from]);
    EXPECT_EQ(out.lights.source[i].position, setting.frame.lights[from].position);
  }
  EXPECT_EQ(out.lights.axis_x, (std::vector<float>{all.axis_x[1]}));
  EXPECT_EQ(out.lights.axis_z, (std::vector<float>{all.axis_z[1]}));
  EXPECT_EQ(out.lights.cos_angle, (std::vector<float>{all.cos_angle[1]}));
  EXPECT_EQ(out.lights.sin_angle, (std::vector<float>{all.sin_angle[1]}));
}

TEST(PreCull, is_named_by_its_steps) {
  EXPECT_EQ(PreCullSpec{}.label(), "none");
  EXPECT_EQ(limit(255).label(), "most(255,first)");
  EXPECT_EQ(limit(512, MostStep::Keep::nearest, true).label(), "most(512,nearest,type)");
  EXPECT_EQ((PreCullSpec{{FrustumStep{}, DistanceStep{62.5}, VisibleSetStep{4, 0.5, 1000}}}.label()),
            "frustum+distance(62.5)+visible-set(4,0.5,1000)");
}

}  // namespace
}  // namespace clusterbench::cull
