// What is sampled from a scene is held to the domain at every frame, not only at the start.

#include "scene/domain_check.h"

#include <gtest/gtest.h>

#include "geom/shapes/domain.h"
#include "scene/gltf_fixture.h"

namespace clusterbench::scene {
namespace {

constexpr double k_no_end = std::numeric_limits<double>::infinity();

// A light below an animated node, and a camera that looks at it.
Scene lamp_below(const test::Animation& animation) {
  return test::loaded(test::document(
      R"("extensionsUsed": ["KHR_lights_punctual"],
         "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 2}]}},
         "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
         "nodes": [{"name": "arm", "children": [1]},
                   {"name": "lamp", "translation": [1, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
                   {"name": "eye", "camera": 0}],
         "scenes": [{"nodes": [0, 2]}], "scene": 0, )" +
      animation.text()));
}

// "where: message" of the refusal of the first camera's path over so many frames; "" if there is none.
std::string refused(const Scene& scene, int frames, int threads = 1) {
  PathRequest request;
  request.count = frames;
  try {
    for (const CameraPath& path : camera_paths(scene, request)) check_domain(scene, path, threads);
  } catch (const Error& error) {
    EXPECT_EQ(error.file(), scene.path.string());
    return error.where() + ": " + error.message();
  }
  return "";
}

TEST(Domain, is_checked_at_every_sampled_frame_and_the_node_the_time_and_the_value_are_named) {
  const Scene scene = lamp_below(test::animation("scale", "LINEAR", {0, 4}, {1, 1, 1, 4e15F, 1, 1}));
  EXPECT_EQ(refused(scene, 2),
            "/nodes/1: the light 'lamp' stands at (3.99999995e+15, 0, 0) m, farther from the origin than 1e+15 m along "
            "an axis at 4 s");
  EXPECT_EQ(refused(scene, 1), "");  // its only frame is the first one
  for (const int threads : {2, 3}) EXPECT_EQ(refused(scene, 400, threads), refused(scene, 400)) << threads;
  const Scene nearer = lamp_below(test::animation("scale", "LINEAR", {0, 4}, {1, 1, 1, 9e14F, 1, 1}));
  EXPECT_EQ(refused(nearer, 60), "");
}

TEST(Domain, takes_no_place_that_is_not_a_number) {
  // A cubic spline's tangents overflow between its keys.
  const float most = std::numeric_limits<float>::max();
  Scene scene = lamp_below(test::animation("scale", "LINEAR", {0, 4}, {1, 1, 1, 1, 1, 1}));
  scene.channels[0].values[1] = {k_no_end, 1, 1, 0};
  EXPECT_NE(refused(scene, 3).find("/nodes/1: the light 'lamp' stands at ("), std::string::npos) << refused(scene, 3);
  scene.channels[0].values[1] = {static_cast<double>(most), 1, 1, 0};
  EXPECT_NE(refused(scene, 3), "");
}

TEST(Domain, holds_cameras_too) {
  Scene scene = lamp_below(test::animation("translation", "LINEAR", {0, 4}, {0, 0, 0, 1, 0, 0}));
  scene.nodes[static_cast<std::size_t>(scene.cameras[0].node)].translation = {0, -2e15, 0};
  EXPECT_NE(refused(scene, 2).find("/nodes/2: the camera 'eye' stands at (0, -2e+15, 0) m"), std::string::npos)
      << refused(scene, 2);
}

TEST(Domain, makes_ranges_beyond_it_endless_and_ranges_below_it_none) {
  EXPECT_EQ(geom::range_in_domain(1e15), 1e15);
  EXPECT_EQ(geom::range_in_domain(1.0001e15), k_no_end);
  EXPECT_EQ(geom::range_in_domain(k_no_end), k_no_end);
  EXPECT_EQ(geom::range_in_domain(1e-15), 1e-15);
  EXPECT_EQ(geom::range_in_domain(0.999e-15), 0.0);
  EXPECT_EQ(geom::range_in_domain(0.0), 0.0);
  Scene scene = lamp_below(test::animation("translation", "LINEAR", {0, 4}, {0, 0, 0, 1, 0, 0}));
  scene.lights[0].range_m = 1e20;
  EXPECT_EQ(world_lights(scene, 0.0)[0].range_m, k_no_end);
  scene.lights[0].range_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused(scene, 2).find("has a range of nan m, and 0 or more is allowed"), std::string::npos)
      << refused(scene, 2);
}

}  // namespace
}  // namespace clusterbench::scene
