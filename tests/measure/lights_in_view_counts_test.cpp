// Which lights a frustum cull of lights keeps, and how many of them there are along a path.

#include "measure/lists/lights_in_view_counts.h"

#include <gtest/gtest.h>

#include <limits>

#include "grid/lights_in_view.h"

namespace clusterbench::measure {
namespace {

// Looks along -z from the origin: a right angle in both directions, from 1 m to 100 m.
view::Frame view_with(std::vector<scene::WorldLight> lights, int index = 0) {
  view::Frame frame;
  frame.index = index;
  frame.projection = {.near_m = 1.0, .far_m = 100.0};
  frame.lights = std::move(lights);
  frame.count_types();
  return frame;
}

scene::WorldLight point_at(const Vec3d& position, double range_m) {
  scene::WorldLight light;
  light.position = position;
  light.range_m = range_m;
  return light;
}

scene::WorldLight spot_at(const Vec3d& position, const Vec3d& direction, double half_angle_rad, double range_m) {
  scene::WorldLight light = point_at(position, range_m);
  light.type = scene::LightType::spot;
  light.direction = direction;
  light.outer_cone_rad = half_angle_rad;
  return light;
}

bool is_seen(const scene::WorldLight& light) {
  return grid::is_in_view(view_with({light}), light);
}

TEST(LightsInView, reach_into_all_six_half_spaces) {
  EXPECT_TRUE(is_seen(point_at({0, 0, -10}, 1)));
  EXPECT_TRUE(is_seen(point_at({0, 0, 1}, 2.5))) << "behind the eye, and reaches beyond the near plane";
  EXPECT_FALSE(is_seen(point_at({0, 0, 1}, 1.5)));
  EXPECT_TRUE(is_seen(point_at({0, 0, -102}, 3)));
  EXPECT_FALSE(is_seen(point_at({0, 0, -102}, 1)));
  // The right side is x = depth: a ball 10 m to the right of it is 10 / sqrt(2) = 7.07 m away.
  EXPECT_TRUE(is_seen(point_at({20, 0, -10}, 7.1)));
  EXPECT_FALSE(is_seen(point_at({20, 0, -10}, 7.0)));
  EXPECT_FALSE(is_seen(point_at({0, -20, -10}, 7.0)));
}

TEST(LightsInView, of_spots_are_told_by_the_sphere_around_the_cone_and_not_by_that_of_the_range) {
  // 20 m long and narrow, from the eye's side of the near plane away from the view: its sphere ends where it begins.
  EXPECT_FALSE(is_seen(spot_at({0, 0, 5}, {0, 0, 1}, 0.3, 20)));
  EXPECT_TRUE(is_seen(spot_at({0, 0, 5}, {0, 0, -1}, 0.3, 20)));
  EXPECT_TRUE(is_seen(point_at({0, 0, 5}, 20)));
}

TEST(LightsInView, leave_out_lights_of_range_0_and_hold_those_without_an_end) {
  EXPECT_FALSE(is_seen(point_at({0, 0, -10}, 0)));
  EXPECT_TRUE(is_seen(point_at({0, 0, 50}, std::numeric_limits<double>::infinity())));
}

TEST(LightsInView, are_counted_over_the_frames_of_a_path) {
  const scene::WorldLight seen = point_at({0, 0, -10}, 1), other = point_at({3, 0, -10}, 1),
                          unseen = point_at({0, 0, 9}, 1), spot = spot_at({0, 0, -5}, {0, 0, -1}, 0.3, 5);
  LightsInView counts;
  add_frame(counts, view_with({seen, unseen}, 0));
  add_frame(counts, view_with({seen, other}, 1));
  add_frame(counts, view_with({seen, unseen, spot}, 2));
  add_frame(counts, view_with({unseen}, 3));
  EXPECT_EQ(counts.mean(), 1.25);
  EXPECT_EQ(counts.most, 2u);
  EXPECT_EQ(counts.frames_with_most, 2u);
  EXPECT_EQ(counts.worst_frame, 1);
  EXPECT_EQ(counts.most_of_type, (std::array<std::uint64_t, 3>{2, 1, 0}));
}

TEST(LightsInView, that_shine_are_counted_each_once_over_the_path_and_seen_where_they_are_in_view_as_well) {
  scene::WorldLight ahead = point_at({0, 0, -10}, 1), behind = point_at({0, 0, 9}, 1), off = ahead, hidden = ahead;
  off.luminous_intensity_cd = 0.0;
  hidden.range_m = 0.0;
  scene::WorldLight box = ahead;
  box.type = scene::LightType::box;
  box.luminous_intensity_cd = 0.0;
  LightsInView counts;
  add_frame(counts, view_with({ahead, behind, off, hidden, box}));
  EXPECT_EQ(counts.most, 3u) << "dark lights are in view like others";
  EXPECT_EQ(counts.lit(), 3u) << "a box lights nothing and is meant";
  EXPECT_EQ(counts.seen(), 2u);
  off.luminous_intensity_cd = 1.0;
  off.position = behind.position;
  add_frame(counts, view_with({ahead, behind, off, hidden, box}));
  EXPECT_EQ(counts.lit(), 4u) << "it blinks";
  EXPECT_EQ(counts.seen(), 2u) << "never lit and in view in the same frame";
}

}  // namespace
}  // namespace clusterbench::measure
