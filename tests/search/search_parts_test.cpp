// The parts of the search: what it may choose, where one can walk, its optimizers, and the path that it writes.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "core/error.h"
#include "needs.h"
#include "scene/writers/write_gltf.h"
#include "search/best_frames.h"
#include "search/optimizer.h"
#include "search/worst_case_fixture.h"

namespace clusterbench::search::test {
namespace {

double distance_to(const std::vector<double>& point, double place) {
  double sum = 0.0;
  for (const double share : point) sum += (share - place) * (share - place);
  return std::sqrt(sum);
}

TEST(Optimizer, both_find_a_hill_within_what_they_may_spend) {
  NEEDS(nlopt);
  const std::atomic<bool> stop{false};
  for (const int evaluations : {1, 7, 400}) {
    int calls = 0;
    double best = -10.0;
    const Objective hill = [&](const std::vector<double>& point) {
      ++calls;
      for (const double share : point) EXPECT_TRUE(share >= 0.0 && share <= 1.0);
      best = std::max(best, -distance_to(point, 0.3));
      return -distance_to(point, 0.3);
    };
    EXPECT_EQ(maximise_globally({0.9, 0.9, 0.9}, evaluations, 1, hill, stop), calls);
    EXPECT_LE(calls, evaluations);
    if (evaluations > 100) {
      EXPECT_GT(best, -0.05);
    }
    calls = 0;
    best = -10.0;
    EXPECT_EQ(maximise_locally({0.9, 0.9, 0.9}, 0.1, evaluations, hill, stop), calls);
    EXPECT_LE(calls, evaluations);
    if (evaluations > 100) {
      EXPECT_GT(best, -0.01);
    }
  }
}

TEST(Optimizer, the_same_seed_asks_for_the_same_points_and_another_one_does_not) {
  NEEDS(nlopt);
  const std::atomic<bool> stop{false};
  const auto points = [&](std::uint64_t seed) {
    std::vector<std::vector<double>> all;
    maximise_globally(
        {0.5, 0.5}, 100, seed,
        [&](const std::vector<double>& point) {
          all.push_back(point);
          return -distance_to(point, 0.2);
        },
        stop);
    return all;
  };
  EXPECT_EQ(points(3), points(3));
  EXPECT_NE(points(3), points(4));
}

TEST(Optimizer, an_error_comes_through_and_a_stop_ends_it) {
  NEEDS(nlopt);
  std::atomic<bool> stop{false};
  int calls = 0;
  const Objective broken = [&](const std::vector<double>&) -> double {
    if (++calls == 5) throw Error("", "view", "is broken");
    return calls;
  };
  EXPECT_THROW(maximise_globally({0.5, 0.5}, 100, 1, broken, stop), Error);
  EXPECT_EQ(calls, 5);
  calls = 0;
  EXPECT_THROW(maximise_locally({0.5, 0.5}, 0.1, 100, broken, stop), Error);
  EXPECT_EQ(calls, 5);
  const Objective stopping = [&](const std::vector<double>& point) {
    stop = true;
    return point[0];
  };
  EXPECT_EQ(maximise_locally({0.5, 0.5}, 0.1, 100, stopping, stop), 1);
  EXPECT_EQ(maximise_globally({0.5, 0.5}, 100, 1, stopping, stop), 0);
}

TEST(SearchSpace, a_recorded_camera_comes_back_but_for_its_roll) {
  const SearchSpace space({{-10.0, 0.0, -10.0}, {10.0, 5.0, 10.0}}, {}, 3, 0);
  SplitMix64 random(1);
  for (int i = 0; i < 200; ++i) {
    const FrameChoice one = space.at(space.random(random));
    EXPECT_LT(one.moment, 3u);
    const FrameChoice again = space.at(space.point_of(one.eye, one.rotation, one.moment));
    EXPECT_LT(glm::length(again.eye - one.eye), 1e-5);
    EXPECT_LT(glm::length(direction_of(again.rotation) - direction_of(one.rotation)), 1e-5);
    EXPECT_EQ(again.moment, one.moment);
    EXPECT_EQ(one.eye, rounded_to_float(one.eye));
    EXPECT_EQ(one.rotation, rounded_to_float(one.rotation));
  }
}

TEST(SearchSpace, a_camera_that_keeps_its_directions_has_no_other_and_keeps_its_roll) {
  const std::vector<Vec4d> rotations{rounded_to_float(Vec4d{-0.5, 0.5, 0.5, 0.5}),
                                     rounded_to_float(Vec4d{-0.6, 0.0, 0.0, 0.8}), Vec4d{0.0, 0.0, 0.0, 1.0}};
  for (std::size_t count = 1; count <= rotations.size(); ++count) {
    const std::vector<Vec4d> kept(rotations.begin(), rotations.begin() + static_cast<std::ptrdiff_t>(count));
    const SearchSpace space({{-10.0, 3.0, -10.0}, {10.0, 3.0, 10.0}}, {}, 2, 1, nullptr, 0.0, kept);
    std::vector<int> seen(count, 0);
    SplitMix64 random(3);
    for (int i = 0; i < 300; ++i) {
      const std::vector<double> point = space.random(random);
      ASSERT_EQ(point.size(), space.dimensions());
      const FrameChoice one = space.at(point);
      const auto found = std::ranges::find(kept, one.rotation);
      ASSERT_NE(found, kept.end());
      ++seen[static_cast<std::size_t>(found - kept.begin())];
      const FrameChoice again = space.at(space.point_of(one.eye, one.rotation, one.moment));
      EXPECT_EQ(again.rotation, one.rotation);
      EXPECT_EQ(again.moment, one.moment);
      EXPECT_EQ(one.eye.y, 3.0);
    }
    for (const int times : seen) EXPECT_GT(times, 300 / static_cast<int>(count) / 2);
  }
}

TEST(SearchSpace, random_directions_are_even_over_the_sphere_and_added_lights_stay_in_their_box) {
  const Box lights{{-3.0, 0.0, -2.0}, {3.0, 1.0, 2.0}};
  const SearchSpace space({{-10.0, 0.0, -10.0}, {10.0, 5.0, 10.0}}, lights, 1, 2);
  SplitMix64 random(2);
  Vec3d sum{0.0}, squares{0.0};
  constexpr int k_count = 20000;
  for (int i = 0; i < k_count; ++i) {
    const FrameChoice one = space.at(space.random(random));
    const Vec3d direction = direction_of(one.rotation);
    sum += direction;
    squares += direction * direction;
    for (const Vec3d& light : one.extra_lights)
      EXPECT_TRUE(Box({{-3.001, -0.001, -2.001}, {3.001, 1.001, 2.001}}).holds(light));
  }
  // Of a uniform direction each coordinate has mean 0 and mean square 1/3; five standard errors.
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sum[axis] / k_count, 0.0, 5.0 * std::sqrt(1.0 / 3.0 / k_count));
    EXPECT_NEAR(squares[axis] / k_count, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / k_count));
  }
}

RatedFrame rated(double value, const Vec3d& eye) {
  RatedFrame frame;
  frame.value = value;
  frame.choice.eye = eye;
  return frame;
}

TEST(BestFrames, keeps_the_best_of_those_that_are_near_and_the_first_of_equal_ones) {
  BestFrames best(3, 1.0);
  best.add(rated(5.0, {0.0, 0.0, 0.0}));
  best.add(rated(5.0, {0.5, 0.0, 0.0}));  // near, and no better
  best.add(rated(4.0, {10.0, 0.0, 0.0}));
  best.add(rated(7.0, {0.2, 0.0, 0.0}));  // in place of the first
  best.add(rated(3.0, {20.0, 0.0, 0.0}));
  best.add(rated(6.0, {30.0, 0.0, 0.0}));
  std::vector<double> values;
  for (const RatedFrame& frame : best.frames()) values.push_back(frame.value);
  EXPECT_EQ(values, (std::vector<double>{7.0, 6.0, 4.0}));
}

// --- Walking ---

void add_triangle(scene::Geometry& geometry, const Vec3f& a, const Vec3f& b, const Vec3f& c,
                  bool double_sided = false) {
  scene::Surface surface;
  surface.vertices = {a, b, c};
  surface.triangles = {{0, 1, 2}};
  surface.double_sided = double_sided;
  geometry.surfaces.push_back(surface);
  geometry.instances.push_back({geometry.surfaces.size() - 1, -1, -1});
}

TEST(Walkable, floors_are_what_looks_upward_at_45_degrees_or_less) {
  scene::Scene scene;
  scene::Geometry geometry;
  add_triangle(geometry, {0, 0, 0}, {0, 0, 2}, {2, 0, 0});        // up: area 2
  add_triangle(geometry, {0, 9, 0}, {2, 9, 0}, {0, 9, 2});        // down
  add_triangle(geometry, {0, 5, 0}, {2, 5, 0}, {0, 5, 2}, true);  // down, but with two sides: area 2
  add_triangle(geometry, {9, 0, 0}, {9, 0, 2}, {10, 2, 0});       // steep
  add_triangle(geometry, {3, 1, 3}, {3, 1, 3}, {3, 1, 3});        // without area
  const Walkable floor(scene, geometry);
  EXPECT_EQ(floor.triangles(), 2u);
  EXPECT_DOUBLE_EQ(floor.area_m2(), 4.0);
  EXPECT_EQ(floor.nearest({0.5, -3.0, 0.5}), Vec3d(0.5, 0.0, 0.5));
  EXPECT_EQ(floor.nearest({0.5, 4.0, 0.5}), Vec3d(0.5, 5.0, 0.5));
  EXPECT_EQ(floor.nearest({-1.0, 0.0, -1.0}), Vec3d(0.0, 0.0, 0.0));
  SplitMix64 random(1);
  int upper = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3d point = floor.random(random);
    EXPECT_LE(point.x + point.z, 2.0 + 1e-12);
    upper += point.y == 5.0 ? 1 : 0;
  }
  EXPECT_NEAR(upper, 2000, 5.0 * std::sqrt(1000.0));
}

TEST(Walkable, the_nearest_point_is_as_near_as_the_nearest_of_many) {
  scene::Scene scene;
  scene::Geometry geometry;
  SplitMix64 random(3);
  const auto coordinate = [&] { return static_cast<float>(random.between(-5.0, 5.0)); };
  for (int i = 0; i < 30; ++i) {
    // One after the other: compilers are free in the order of arguments.
    const float y = coordinate(), ax = coordinate(), az = coordinate(), bx = coordinate(), bz = coordinate(),
                cx = coordinate(), cz = coordinate();
    add_triangle(geometry, {ax, y, az}, {bx, y, bz}, {cx, y + 0.1f, cz}, true);
  }
  const Walkable floor(scene, geometry);
  for (int i = 0; i < 100; ++i) {
    const Vec3d from{coordinate(), coordinate(), coordinate()};
    const double least = glm::length(floor.nearest(from) - from);
    double sampled = 1e9;
    for (int k = 0; k < 3000; ++k) sampled = std::min(sampled, glm::length(floor.random(random) - from));
    EXPECT_LE(least, sampled + 1e-12);
    EXPECT_GE(least, sampled - 2.0) << "3000 places on floors of some 300 square metres are sparse";
  }
}

TEST(Walkable, of_a_box_only_what_lies_in_it_is_floor) {
  scene::Scene scene;
  scene::Geometry geometry;
  add_triangle(geometry, {0, 0, 0}, {0, 0, 4}, {4, 0, 0});
  add_triangle(geometry, {0, 5, 0}, {0, 5, 4}, {4, 5, 0});
  const Box box{{1.0, -1.0, -1.0}, {2.0, 1.0, 10.0}};
  const Walkable floor(scene, geometry, box);
  EXPECT_NEAR(floor.area_m2(), 2.5, 1e-12) << "between x = 1, where it is 3 m wide, and x = 2, where it is 2 m wide";
  SplitMix64 random(2);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(box.holds(floor.random(random)));
    EXPECT_TRUE(box.holds(floor.nearest({random.between(-9, 9), random.between(-9, 9), random.between(-9, 9)})));
  }
  EXPECT_THROW(Walkable(scene, geometry, Box{{9, 9, 9}, {10, 10, 10}}), Error);
}

// Beside each other, as g++ 12 packs them.
TEST(RoundedToFloat, is_a_single_precision_number_in_each_coordinate) {
  const volatile double x = 0.1, y = 0.2, z = 0.3, w = 0.7;
  const auto as_float = [](float value) { return static_cast<double>(value); };
  EXPECT_EQ(rounded_to_float(Vec3d{x, y, z}), Vec3d(as_float(0.1f), as_float(0.2f), as_float(0.3f)));
  EXPECT_EQ(rounded_to_float(Vec4d{x, y, z, w}), Vec4d(as_float(0.1f), as_float(0.2f), as_float(0.3f), as_float(0.7f)));
}

TEST(Walkable, a_scene_without_floor_is_refused) {
  scene::Scene scene;
  scene::Geometry geometry;
  EXPECT_THROW(Walkable(scene, geometry), Error);
  add_triangle(geometry, {0, 9, 0}, {2, 9, 0}, {0, 9, 2});
  EXPECT_THROW(Walkable(scene, geometry), Error);
}

// --- The path that is written ---

std::string base64_of(const std::vector<float>& numbers) {
  std::string bytes(numbers.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  constexpr char k_digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  while (bytes.size() % 3 != 0) bytes += '\0';
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned all = 0;
    for (std::size_t k = 0; k < 3; ++k) all = all << 8 | static_cast<unsigned char>(bytes[i + k]);
    for (int shift = 18; shift >= 0; shift -= 6) text += k_digits[all >> shift & 63u];
  }
  return text;
}

// A spot whose place, range and angle change, a point that stands, and a camera that moves with the spot's keys.
Json moving_scene() {
  Json scene = scene_json({{{1.0, 2.0, 3.0}, 4.0, true}, {{0.1, 0.2, 0.3}, 2.7, false}}, {{0.0, 0.0, 9.0}});
  const std::vector<float> numbers{0.0f, 1.0f,                          // times
                                   1.0f, 2.0f, 3.0f, 1.5f, 2.5f, 3.5f,  // places
                                   4.0f, 6.0f,                          // ranges
                                   0.5f, 0.9f,                          // angles
                                   0.0f};
  scene["extensionsUsed"] = {"KHR_lights_punctual", "KHR_animation_pointer"};
  scene["buffers"] = Json::array({Json{{"byteLength", numbers.size() * 4},
                                       {"uri", "data:application/octet-stream;base64," + base64_of(numbers)}}});
  const auto add_accessor = [&](std::size_t begin, std::size_t count, const char* type, std::size_t width) {
    scene["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin * 4}, {"byteLength", count * width * 4}});
    scene["accessors"].push_back(
        {{"bufferView", scene["bufferViews"].size() - 1}, {"componentType", 5126}, {"count", count}, {"type", type}});
  };
  add_accessor(0, 2, "SCALAR", 1);
  scene["accessors"][0]["min"] = {0.0};
  scene["accessors"][0]["max"] = {1.0};
  add_accessor(2, 2, "VEC3", 3);
  add_accessor(8, 2, "SCALAR", 1);
  add_accessor(10, 2, "SCALAR", 1);
  Json animation{{"channels", Json::array()}, {"samplers", Json::array()}};
  const auto add_channel = [&](int output, const Json& target) {
    animation["channels"].push_back({{"sampler", animation["samplers"].size()}, {"target", target}});
    animation["samplers"].push_back({{"input", 0}, {"output", output}});
  };
  const auto pointer = [](const char* to) {
    return Json{
        {"path", "pointer"},
        {"extensions",
         {{"KHR_animation_pointer", {{"pointer", std::string("/extensions/KHR_lights_punctual/lights/0/") + to}}}}}};
  };
  add_channel(1, {{"node", 0}, {"path", "translation"}});
  add_channel(2, pointer("range"));
  add_channel(3, pointer("spot/outerConeAngle"));
  scene["animations"] = Json::array({animation});
  return scene;
}

TEST(LightRig, a_written_path_comes_back_to_the_bit_with_lights_that_change) {
  const SearchFolder folder;
  const Searched moving = searched(folder, moving_scene());
  const run::SceneData& data = moving.plan.scenes[0];
  const LightRig rig(data.scene, data.paths[0], {7.5}, false);
  ASSERT_EQ(rig.moments(), 5u) << "one for each recorded frame";
  EXPECT_EQ(rig.moment_of(3), 3u);
  scene::Scene path_scene = rig.scene(3, data.paths[0].shots[0].projection);
  for (std::size_t frame = 0; frame < 3; ++frame) {
    FrameChoice choice;
    choice.eye = {0.5 * static_cast<double>(frame), 1.0, 2.0};
    choice.moment = 2 * frame;
    choice.extra_lights = {{3.0, 2.0, static_cast<double>(frame)}};
    rig.set_frame(path_scene, frame, choice);
  }
  const scene::Scene read = scene::load_gltf(folder.write("written.gltf", scene::to_gltf(path_scene, "test")));
  EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
  for (const double time_s : {0.0, 1.0, 1.5, 2.0}) {
    const auto wanted = scene::world_lights(path_scene, time_s), found = scene::world_lights(read, time_s);
    ASSERT_EQ(found.size(), 3u);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      EXPECT_EQ(found[i].position, wanted[i].position);
      EXPECT_EQ(found[i].range_m, wanted[i].range_m);
      EXPECT_EQ(found[i].direction, wanted[i].direction);
      EXPECT_EQ(found[i].outer_cone_rad, wanted[i].outer_cone_rad);
    }
    const auto pose = scene::camera_pose(read, read.cameras[0], time_s);
    EXPECT_EQ(pose.eye, scene::camera_pose(path_scene, path_scene.cameras[0], time_s).eye);
  }
  // As the recorded scene has them, to single precision where they change and exactly where they do not.
  const auto recorded = scene::world_lights(data.scene, data.paths[0].shots[2].time_s);
  const auto found = scene::world_lights(read, 1.0);
  EXPECT_EQ(found[0].position, recorded[0].position) << "the point stands";
  EXPECT_EQ(found[1].range_m, 7.5) << "the added light comes after the scene's points";
  EXPECT_NEAR(found[2].range_m, recorded[1].range_m, 1e-6);
  EXPECT_NEAR(found[2].outer_cone_rad, recorded[1].outer_cone_rad, 1e-6);
  EXPECT_LT(glm::length(found[2].position - recorded[1].position), 1e-6);
}

TEST(LightRig, lights_that_never_change_keep_every_digit) {
  const SearchFolder folder;
  const Searched still = searched(folder, scene_json({{{0.1, 1.0 / 3.0, 1e9 + 0.1}, 0.7}}, {{0.0, 0.0, 1.0}}));
  const run::SceneData& data = still.plan.scenes[0];
  const LightRig rig(data.scene, data.paths[0], {}, false);
  EXPECT_EQ(rig.moments(), 1u);
  scene::Scene path_scene = rig.scene(1, data.paths[0].shots[0].projection);
  rig.set_frame(path_scene, 0, {});
  const auto light = scene::world_lights(path_scene, 0.0).front();
  EXPECT_EQ(light.position, Vec3d(0.1, 1.0 / 3.0, 1e9 + 0.1));
  EXPECT_EQ(light.range_m, 0.7);
}

}  // namespace
}  // namespace clusterbench::search::test
