// The same lights have the same digest, however they are written; others have another.

#include "scene/digests.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/rig.h"

namespace clusterbench::scene {
namespace {

Scene rig_of(int lights) {
  RigSpec spec;
  spec.lights = lights;
  spec.spots = 0.5;
  Scene scene = make_rig(spec);
  resolve_ranges(scene, {});
  return scene;
}

Node& node_of(Scene& scene, std::size_t light) {
  return scene.nodes[static_cast<std::size_t>(scene.lights[light].node)];
}

TEST(LightDigest, does_not_depend_on_names_order_colours_and_cameras) {
  const Scene scene = rig_of(20);
  Scene other = scene;
  std::ranges::reverse(other.lights);
  other.lights[3].name = "lamp";
  other.lights[4].color = {0.1, 0.2, 0.3};
  other.cameras.clear();
  other.sha256 = "of another file";
  EXPECT_EQ(light_digest(other), light_digest(scene));
}

TEST(LightDigest, does_not_depend_on_whether_a_file_has_single_precision_or_a_matrix) {
  const Scene scene = rig_of(50);
  Scene single = scene;
  for (std::size_t i = 0; i < single.lights.size(); ++i)
    node_of(single, i).translation = Vec3d(Vec3f(node_of(single, i).translation));
  EXPECT_EQ(light_digest(single), light_digest(scene));
  Scene by_matrix = scene;
  for (std::size_t i = 0; i < by_matrix.lights.size(); ++i) {
    Node& node = node_of(by_matrix, i);
    Mat4d matrix = rest_transforms(scene)[static_cast<std::size_t>(scene.lights[i].node)];
    matrix[3][0] *= 1.0 + 0x1p-52;
    node.matrix = std::make_shared<const Mat4d>(matrix);
  }
  EXPECT_EQ(light_digest(by_matrix), light_digest(scene));
}

TEST(LightDigest, of_lights_that_stand_still_does_not_depend_on_what_else_moves) {
  const Scene scene = rig_of(20);
  Scene with_path = scene;
  with_path.duration_s = 12.0;
  EXPECT_EQ(light_digest(with_path), light_digest(scene));
}

TEST(LightDigest, is_another_where_a_light_is_gone_moved_shortened_or_turned) {
  const Scene scene = rig_of(20);
  const std::string digest = light_digest(scene);
  Scene fewer = scene, moved = scene, shorter = scene, narrower = scene, of_another_kind = scene;
  fewer.lights.pop_back();
  node_of(moved, 7).translation.x += 0.01;
  shorter.lights[7].range_m -= 0.01;
  const auto spot = std::ranges::find(narrower.lights, LightType::spot, &Light::type);
  ASSERT_NE(spot, narrower.lights.end());
  spot->outer_cone_rad *= 0.99;
  of_another_kind.lights[0].type = scene.lights[0].type == LightType::spot ? LightType::point : LightType::spot;
  for (const Scene* other : {&fewer, &moved, &shorter, &narrower, &of_another_kind})
    EXPECT_NE(light_digest(*other), digest);
}

TEST(LightDigest, is_another_where_a_light_is_switched_off_and_counts_these) {
  const Scene scene = rig_of(20);
  EXPECT_EQ(count_dark_lights(scene).all, 0);
  const auto is_told = [&](auto&& change) {
    Scene changed = scene;
    change(changed.lights[3]);
    EXPECT_NE(light_digest(changed), light_digest(scene));
    EXPECT_EQ(count_dark_lights(changed).all, 1);
  };
  is_told([](Light& light) { light.intensity = 0.0; });
  is_told([](Light& light) { light.color = Vec3d(0.0); });
  is_told([](Light& light) { light.range_m = 0.0; });
  Scene dim = scene;
  dim.lights[3].intensity *= 1e-6;
  EXPECT_EQ(light_digest(dim), light_digest(scene));
  for (Light& light : dim.lights) light.intensity = 0.0;
  EXPECT_EQ(count_dark_lights(dim).all, 20);
  EXPECT_EQ(count_dark_lights(dim).without_range, 0);
  dim.lights[3].range_m = dim.lights[4].range_m = 0.0;
  EXPECT_EQ(count_dark_lights(dim).without_range, 2);
}

Channel channel_of(const Scene& scene, std::size_t light, ChannelPath path, std::vector<double> times_s,
                   std::vector<Vec4d> values) {
  Channel channel;
  if (path == ChannelPath::translation)
    channel.node = scene.lights[light].node;
  else
    channel.definition = scene.lights[light].definition;
  channel.path = path;
  channel.times_s = std::move(times_s);
  channel.values = std::move(values);
  return channel;
}

Vec4d at(double x, double y, double z) {
  return {x, y, z, 0.0};
}

Scene with_motion(Scene scene, std::size_t light, std::vector<double> times_s, std::vector<Vec4d> values) {
  scene.channels.push_back(channel_of(scene, light, ChannelPath::translation, times_s, std::move(values)));
  scene.duration_s = std::max(scene.duration_s, times_s.back());
  return scene;
}

TEST(LightDigest, is_another_where_a_light_goes_elsewhere_between_the_ends_and_the_middle) {
  const Scene scene = rig_of(5);
  const std::vector<double> times{0.0, 1.0, 2.0, 3.0, 4.0};
  const Scene stays = with_motion(scene, 2, times, {at(1, 1, 1), at(1, 1, 1), at(1, 1, 1), at(1, 1, 1), at(1, 1, 1)});
  const Scene goes = with_motion(scene, 2, times, {at(1, 1, 1), at(500, 1, 1), at(1, 1, 1), at(9, 1, 1), at(1, 1, 1)});
  EXPECT_NE(light_digest(stays), light_digest(goes));
}

TEST(LightDigest, is_another_where_two_lights_exchange_places) {
  Scene scene = rig_of(6);
  for (Light& light : scene.lights) {
    light.type = LightType::point;
    light.range_m = 3.0;
  }
  node_of(scene, 0).translation = {0.0, 0.0, 0.0};
  node_of(scene, 1).translation = {8.0, 0.0, 0.0};
  const Scene moving = with_motion(with_motion(scene, 0, {0.0, 1.0}, {at(0, 0, 0), at(8, 0, 0)}), 1, {0.0, 1.0},
                                   {at(8, 0, 0), at(0, 0, 0)});
  EXPECT_NE(light_digest(moving), light_digest(scene));
}

TEST(LightDigest, is_another_where_the_same_motion_is_faster) {
  const Scene scene = rig_of(5);
  EXPECT_NE(light_digest(with_motion(scene, 2, {0.0, 1.0}, {at(0, 0, 0), at(8, 0, 0)})),
            light_digest(with_motion(scene, 2, {0.0, 2.0}, {at(0, 0, 0), at(8, 0, 0)})));
}

TEST(LightDigest, of_moving_lights_does_not_depend_on_how_long_a_camera_moves) {
  const Scene scene = with_motion(rig_of(5), 2, {0.0, 1.0}, {at(0, 0, 0), at(8, 0, 0)});
  Scene longer = scene;
  longer.duration_s = 20.0;
  EXPECT_EQ(light_digest(longer), light_digest(scene));
}

TEST(LightDigest, is_another_for_each_of_more_keys_than_are_asked_for) {
  std::vector<double> times;
  std::vector<Vec4d> values;
  for (int i = 0; i < 5000; ++i) {
    times.push_back(0.01 * i);
    values.push_back(at(0.001 * i, 0, 0));
  }
  const Scene scene = with_motion(rig_of(5), 2, times, values);
  for (const std::size_t key : {std::size_t{1}, std::size_t{2501}, std::size_t{4997}}) {
    values[key].y = 40.0;
    EXPECT_NE(light_digest(with_motion(rig_of(5), 2, times, values)), light_digest(scene));
    values[key].y = 0.0;
  }
}

// The moments are taken some at a time, the more the more threads there are.
TEST(LightDigest, and_dark_lights_are_the_same_on_any_number_of_threads) {
  std::vector<double> times;
  std::vector<Vec4d> values;
  for (int i = 0; i < 60; ++i) {
    times.push_back(0.1 * i);
    values.push_back(at(0.25 * i, i % 7, 0));
  }
  Scene scene = with_motion(rig_of(50), 2, times, values);
  for (const std::size_t dark : {0u, 7u, 41u}) scene.lights[dark].intensity = 0.0;
  const std::string one = light_digest(scene);
  EXPECT_EQ(count_dark_lights(scene).all, 3);
  for (const int threads : {2, 3, 16}) {
    EXPECT_EQ(light_digest(scene, threads), one) << threads;
    EXPECT_EQ(count_dark_lights(scene, threads).all, 3) << threads;
  }
}

TEST(Lights, change_where_an_animation_moves_hides_or_alters_one_or_what_it_hangs_on) {
  Scene scene = rig_of(3);
  const auto add_node = [&] {
    scene.nodes.emplace_back();
    return static_cast<int>(scene.nodes.size()) - 1;
  };
  const int eye = add_node(), arm = add_node(), shoulder = add_node();
  node_of(scene, 1).parent = arm;
  scene.nodes[static_cast<std::size_t>(arm)].parent = shoulder;
  EXPECT_FALSE(lights_change(scene));
  const auto changes_with = [&](ChannelPath path, int node) {
    Scene moving = scene;
    moving.channels.push_back(channel_of(scene, 0, path, {0.0, 1.0}, {at(0, 0, 0), at(1, 0, 0)}));
    moving.channels.back().node = node;
    return lights_change(moving);
  };
  EXPECT_FALSE(changes_with(ChannelPath::translation, eye));
  for (const int node : {scene.lights[0].node, scene.lights[1].node, arm, shoulder}) {
    EXPECT_TRUE(changes_with(ChannelPath::translation, node)) << node;
    EXPECT_TRUE(changes_with(ChannelPath::visible, node)) << node;
  }
  Scene pulsing = scene;
  pulsing.light_channels.push_back(
      channel_of(scene, 0, ChannelPath::intensity, {0.0, 1.0}, {at(0, 0, 0), at(1, 0, 0)}));
  EXPECT_TRUE(lights_change(pulsing));
}

// Exporters hide objects by a scale of 0. Then directions are those of unflattened axes, whose last bits may differ.
TEST(Lights, keep_every_bit_where_another_node_is_hidden_by_its_scale) {
  Scene scene = rig_of(40);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    for (int above = 0; above < 2; ++above) {
      Node joint;
      joint.rotation = glm::normalize(Vec4d(0.1 + 0.01 * static_cast<double>(i), 0.3 * above, 0.2, 0.9));
      joint.parent = above == 0 ? -1 : static_cast<int>(scene.nodes.size()) - 1;
      scene.nodes.push_back(joint);
    }
    Node lamp = node_of(scene, i);
    lamp.parent = static_cast<int>(scene.nodes.size()) - 1;
    scene.lights[i].node = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(lamp);
  }
  Channel hides = channel_of(scene, 0, ChannelPath::scale, {0.0, 1.0}, {at(1, 1, 1), at(0, 0, 0)});
  hides.node = static_cast<int>(scene.nodes.size());
  scene.nodes.emplace_back();
  scene.channels.push_back(hides);
  ASSERT_FALSE(lights_change(scene));
  const std::vector<WorldLight> before = world_lights(scene, 0.0), after = world_lights(scene, 1.0);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].direction, after[i].direction) << i;
    EXPECT_EQ(before[i].position, after[i].position) << i;
  }
}

TEST(LightDigest, a_light_that_shines_at_some_time_is_not_dark) {
  Scene scene = rig_of(1);
  scene.lights[0].definition = 0;
  const auto flashes = [&](std::vector<Vec4d> values) {
    Scene out = scene;
    out.light_channels = {channel_of(scene, 0, ChannelPath::intensity, {0.0, 1.0, 2.0, 3.0, 4.0}, std::move(values))};
    return out;
  };
  const Scene flashing = flashes({at(0, 0, 0), at(100, 0, 0), at(0, 0, 0), at(100, 0, 0), at(0, 0, 0)});
  const Scene dark = flashes({at(0, 0, 0), at(0, 0, 0), at(0, 0, 0), at(0, 0, 0), at(0, 0, 0)});
  EXPECT_EQ(count_dark_lights(flashing).all, 0);
  EXPECT_EQ(count_dark_lights(dark).all, 1);
  EXPECT_NE(light_digest(flashing), light_digest(dark));
}

TEST(LightDigest, a_range_at_some_time_is_a_range_of_a_dark_light) {
  Scene scene = rig_of(2);
  for (Light& light : scene.lights) light.intensity = light.range_m = 0.0;
  EXPECT_EQ(count_dark_lights(scene).without_range, 2);
  scene.lights[0].definition = 0;
  scene.light_channels = {
      channel_of(scene, 0, ChannelPath::range, {0.0, 1.0, 2.0}, {at(0, 0, 0), at(5, 0, 0), at(0, 0, 0)})};
  EXPECT_EQ(count_dark_lights(scene).all, 2);
  EXPECT_EQ(count_dark_lights(scene).without_range, 1);
}

TEST(LightDigest, is_another_where_a_directional_light_is_gone) {
  Scene scene = rig_of(5);
  const std::string without = light_digest(scene);
  scene.lights.push_back(scene.lights[0]);
  scene.lights.back().type = LightType::directional;
  EXPECT_NE(light_digest(scene), without);
}

Scene with_camera(Scene scene) {
  Camera camera;
  camera.name = "walk";
  camera.node = static_cast<int>(scene.nodes.size());
  camera.projection.yfov_rad = 1.0;
  camera.projection.far_m = 100.0;
  scene.nodes.emplace_back();
  scene.cameras = {camera};
  return scene;
}

Scene walking(std::vector<double> times_s, std::vector<Vec4d> values) {
  Scene scene = with_camera(rig_of(2));
  Channel channel;
  channel.node = scene.cameras[0].node;
  channel.times_s = std::move(times_s);
  channel.values = std::move(values);
  scene.channels = {channel};
  scene.duration_s = channel.times_s.back();
  return scene;
}

TEST(CameraDigest, is_another_where_the_path_is_shorter_or_goes_another_way) {
  const auto digest = [](const Scene& scene) { return camera_digest(scene, scene.cameras[0]); };
  const Scene scene = walking({0.0, 1.0, 2.0}, {at(0, 0, 0), at(5, 0, 0), at(5, 0, 5)});
  Scene with_lights = scene;
  with_lights.lights.pop_back();
  with_lights.duration_s = 9.0;
  EXPECT_EQ(digest(with_lights), digest(scene));
  EXPECT_NE(digest(walking({0.0, 1.0}, {at(0, 0, 0), at(5, 0, 0)})), digest(scene));
  EXPECT_NE(digest(walking({0.0, 1.0, 2.0}, {at(0, 0, 0), at(6, 0, 0), at(5, 0, 5)})), digest(scene));
  Scene wider = scene;
  wider.cameras[0].projection.yfov_rad = 1.1;
  EXPECT_NE(digest(wider), digest(scene));
}

TEST(LightDigest, of_no_lights_is_not_that_of_a_light) {
  Scene none = rig_of(1);
  const std::string one = light_digest(none);
  none.lights.clear();
  EXPECT_NE(light_digest(none), one);
  EXPECT_EQ(light_digest(none).size(), 16u);
}

}  // namespace
}  // namespace clusterbench::scene
