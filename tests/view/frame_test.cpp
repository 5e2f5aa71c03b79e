#include "view/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

namespace clusterbench::view {
namespace {

constexpr double k_endless = std::numeric_limits<double>::infinity();

Frame frame_with(const std::vector<scene::WorldLight>& lights) {
  Frame frame;
  frame.lights = lights;
  for (const scene::WorldLight& light : lights) frame.points += light.type == scene::LightType::point;
  return frame;
}

scene::WorldLight point(Vec3d place, double range) {
  scene::WorldLight light;
  light.position = place;
  light.range_m = range;
  return light;
}

TEST(Projection, keeps_the_projections_height_and_takes_its_width_from_the_viewport) {
  scene::CameraProjection projection;
  projection.yfov_rad = 2.0 * std::atan(0.5);
  const Projection wide = make_projection(projection, {200, 100});
  EXPECT_DOUBLE_EQ(wide.top, 0.5);
  EXPECT_DOUBLE_EQ(wide.right, 1.0);
  EXPECT_DOUBLE_EQ(wide.left, -1.0);
  projection.orthographic = true;
  projection.ymag_m = 6.0;
  projection.xmag_m = 1.0;
  EXPECT_DOUBLE_EQ(make_projection(projection, {50, 100}).right, 3.0);
}

TEST(Projection, of_a_camera_wider_than_the_viewport_holds_its_whole_rectangle) {
  scene::CameraProjection projection;
  projection.yfov_rad = 2.0 * std::atan(0.5);
  projection.aspect_ratio = 4.0;
  const Projection whole = make_projection(projection, {200, 100});
  EXPECT_DOUBLE_EQ(whole.right, 2.0);
  EXPECT_DOUBLE_EQ(whole.left, -2.0);
  EXPECT_DOUBLE_EQ(whole.top, 1.0);
  EXPECT_DOUBLE_EQ(whole.bottom, -1.0);
  EXPECT_NE(fit_warning(projection, {200, 100}).find("enlarged to 2 times its height"), std::string::npos)
      << fit_warning(projection, {200, 100});
  projection.orthographic = true;
  projection.xmag_m = 20.0;
  projection.ymag_m = 3.0;
  EXPECT_DOUBLE_EQ(make_projection(projection, {200, 100}).right, 20.0);
  EXPECT_DOUBLE_EQ(make_projection(projection, {200, 100}).top, 10.0);
}

TEST(Projection, of_a_field_of_view_that_is_asked_for_has_it_in_every_viewport) {
  scene::Scene scene;
  scene.nodes.resize(1);
  scene::Camera camera;
  camera.node = 0;
  camera.projection.yfov_rad = 0.7;
  camera.projection.aspect_ratio = 2.5;
  camera.projection.far_m = 100.0;
  scene.cameras = {camera};
  scene::PathRequest request;
  for (const Vec2i viewport : {Vec2i(1920, 1080), Vec2i(1024, 1024), Vec2i(400, 900), Vec2i(3440, 1440)}) {
    for (const scene::CameraFit fit : {scene::CameraFit::contain, scene::CameraFit::vertical}) {
      request.fit = fit;
      request.field_of_view = scene::field_of_view("90h");
      const auto shown = [&] {
        return make_projection(scene::camera_paths(scene, request)[0].shots[0].projection, viewport);
      };
      EXPECT_NEAR(shown().right, 1.0, 1e-12);
      EXPECT_NEAR(shown().top, static_cast<double>(viewport.y) / viewport.x, 1e-12);
      request.field_of_view = scene::field_of_view("60v");
      EXPECT_NEAR(shown().top, std::tan(0.5235987755982988), 1e-12);
      EXPECT_NEAR(shown().right, shown().top * viewport.x / viewport.y, 1e-12);
    }
  }
  scene.cameras[0].projection.orthographic = true;
  scene.cameras[0].projection.xmag_m = scene.cameras[0].projection.ymag_m = 8.0;
  EXPECT_EQ(make_projection(scene::camera_paths(scene, request)[0].shots[0].projection, {100, 100}).top, 8.0);
}

TEST(Projection, of_a_wide_camera_is_cropped_where_the_height_is_asked_for) {
  scene::CameraProjection projection;
  projection.yfov_rad = 2.0 * std::atan(0.5);
  projection.aspect_ratio = 4.0;
  projection.fit = scene::CameraFit::vertical;
  EXPECT_DOUBLE_EQ(make_projection(projection, {200, 100}).right, 1.0);
  EXPECT_NE(fit_warning(projection, {200, 100}).find("50 % of its width are cropped"), std::string::npos);
}

TEST(Projection, of_a_camera_that_the_viewport_holds_is_the_same_to_the_bit_with_both_fits) {
  scene::CameraProjection projection;
  projection.yfov_rad = 1.047198;
  const Projection plain = make_projection(projection, {1920, 1080});
  for (const double aspect : {1.0, 1.777778, 1.7778, 1.778}) {  // 16/9 as exporters write it: less than half a pixel
    projection.aspect_ratio = aspect;
    EXPECT_EQ(make_projection(projection, {1920, 1080}), plain) << aspect;
    EXPECT_EQ(fit_warning(projection, {1920, 1080}), "") << aspect;
  }
  projection.aspect_ratio = 1.78;
  EXPECT_NE(make_projection(projection, {1920, 1080}), plain);
  projection.sides = scene::ProjectionSides{-1.0, 1.0, -0.1, 0.1};
  EXPECT_EQ(make_projection(projection, {100, 100}).right, 1.0);
  EXPECT_EQ(fit_warning(projection, {100, 100}), "");
}

// With the picture moved by (2, -3) pixels, pixel (12, 17) shows what (10, 20) did.
TEST(Projection, of_a_jittered_frame_moves_the_picture_by_its_pixels) {
  const scene::Scene scene;
  scene::Shot shot;
  shot.projection.yfov_rad = 1.0;
  shot.projection.near_m = 0.1;
  shot.projection.far_m = 100.0;
  const Projection still = make_frame(scene, shot, 0, {100, 50}).projection;
  EXPECT_EQ(still, make_projection(shot.projection, {100, 50}));
  shot.jitter_px = {2.0, -3.0};
  const Projection moved = make_frame(scene, shot, 0, {100, 50}).projection;
  const auto right_of = [](const Projection& p, double x) { return p.left + x / 100.0 * (p.right - p.left); };
  const auto up_of = [](const Projection& p, double y) { return p.top - y / 50.0 * (p.top - p.bottom); };
  EXPECT_NEAR(right_of(moved, 12.0), right_of(still, 10.0), 1e-15);
  EXPECT_NEAR(up_of(moved, 17.0), up_of(still, 20.0), 1e-15);
  EXPECT_NEAR(moved.right - moved.left, still.right - still.left, 1e-15);
}

TEST(PictureRay, shows_at_each_depth_what_its_pixel_shows) {
  Frame frame;
  frame.viewport = {200, 100};
  frame.projection = {false, -2.0, 2.0, -1.0, 1.0, 0.1, 100.0};
  EXPECT_EQ(picture_ray(frame, {100.0, 50.0}).at(7.0), Vec3d(0.0, 0.0, -7.0));
  EXPECT_EQ(picture_ray(frame, {0.0, 0.0}).at(3.0), Vec3d(-6.0, 3.0, -3.0));
  EXPECT_EQ(picture_ray(frame, {200.0, 75.0}).at(3.0), Vec3d(6.0, -1.5, -3.0));
  frame.projection.orthographic = true;
  EXPECT_EQ(picture_ray(frame, {200.0, 75.0}).at(3.0), Vec3d(2.0, -0.5, -3.0));
  EXPECT_EQ(picture_ray(frame, {200.0, 75.0}).at(0.0), Vec3d(2.0, -0.5, 0.0));
}

TEST(Lights, far_from_the_origin_are_as_precise_as_near_it) {
  SplitMix64 random(1);
  const Vec3d offset{1e7, -3e6, 2e7};
  std::vector<scene::WorldLight> here, there;
  for (int i = 0; i < 50; ++i) {
    const Vec3d place =
        glm::round(Vec3d(random.between(-99, 99), random.between(-9, 9), random.between(-99, 99)) * 256.0) / 256.0;
    here.push_back(point(place, 3.0));
    there.push_back(point(place + offset, 3.0));
  }
  const LightArrays near_origin = lights_in(frame_with(here), {});
  const LightArrays far_away = lights_in(frame_with(there), {offset, Mat3d(1.0)});
  EXPECT_EQ(near_origin.x, far_away.x);
  EXPECT_EQ(near_origin.y, far_away.y);
  EXPECT_EQ(near_origin.z, far_away.z);
}

TEST(Lights, have_a_radius_that_is_never_below_their_range) {
  SplitMix64 random(2);
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < 200; ++i)
    lights.push_back(point({random.between(-1e3, 1e3), 0.0, 0.0}, random.between(1e-4, 1e3)));
  const LightArrays arrays = lights_in(frame_with(lights), {});
  for (std::size_t i = 0; i < lights.size(); ++i) {
    EXPECT_GE(static_cast<double>(arrays.radius[i]), lights[i].range_m);
    const auto light = static_cast<std::uint32_t>(i);
    EXPECT_EQ(arrays.padded_radius(light, 0.0f), arrays.radius[i]);
    // The roundoffs that are given with the numbers cover the rounded centre, and a rounding more does not matter.
    const double pad = arrays.padded_radius(light, k_given_roundoffs) - lights[i].range_m,
                 moved = std::abs(arrays.x[i] - lights[i].position.x);
    EXPECT_GE(pad, moved);
    EXPECT_LT(pad, 3e-7 * (std::abs(lights[i].position.x) + lights[i].range_m));
  }
}

TEST(Lights, without_range_stay_without_and_without_end_stay_endless) {
  const LightArrays arrays = lights_in(frame_with({point({1, 2, 3}, 0.0), point({1, 2, 3}, k_endless)}), {});
  EXPECT_EQ(arrays.padded_radius(0, 9.0f), 0.0f);
  EXPECT_TRUE(std::isinf(arrays.padded_radius(1, 9.0f)));
  EXPECT_TRUE(std::isinf(arrays.padded_radius(1, 0.0f)));
}

TEST(Lights, of_spots_have_their_axis_turned_into_view_space) {
  scene::WorldLight spot = point({0, 0, 0}, 5.0);
  spot.type = scene::LightType::spot;
  spot.direction = {1.0, 0.0, 0.0};
  spot.outer_cone_rad = 0.5;
  // A camera that looks along +x: world x is ahead, view -z.
  const Mat3d turned(Vec3d(0, 0, -1), Vec3d(0, 1, 0), Vec3d(1, 0, 0));
  const LightArrays arrays = lights_in(frame_with({point({0, 0, 0}, 1.0), spot}), {Vec3d(0.0), turned});
  EXPECT_EQ(arrays.points.count, 1u);
  EXPECT_EQ(arrays.spots.count, 1u);
  const geom::SphericalCone cone = arrays.cone(1, 0.0f);
  EXPECT_FLOAT_EQ(cone.axis.z, -1.0f);
  EXPECT_FLOAT_EQ(cone.cos_angle, std::cos(0.5f));
  EXPECT_FLOAT_EQ(cone.sin_angle, std::sin(0.5f));
}

// Steps of a test are off by so many units of 2^-24 of the sphere's own size.
TEST(Lights, of_spots_have_a_sphere_that_is_padded_on_all_sides) {
  SplitMix64 random(3);
  for (int i = 0; i < 3000; ++i) {
    scene::WorldLight spot = point({random.between(-9, 9), random.between(-9, 9), random.between(-9, 9)}, 5.0);
    spot.type = scene::LightType::spot;
    spot.direction = glm::normalize(Vec3d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
    spot.outer_cone_rad = i % 2 == 0 ? random.between(0.001, 1.57) : random.between(0.75, 0.82);
    const LightArrays arrays = lights_in(frame_with({spot}), {});
    const geom::Ball plain = arrays.bounding_ball(0, 0.0f);
    for (const float roundoffs : {2.0f, 10.0f, 34.0f}) {
      const geom::Ball padded = arrays.bounding_ball(0, roundoffs);
      const Vec3d middle(padded.center), size = glm::abs(middle);
      const double own = size.x + size.y + size.z + plain.radius, pad = 0x1p-24 * (roundoffs - 1.0) * own;
      const Vec3d behind = spot.position - pad * spot.direction,
                  ahead = spot.position + (spot.range_m + pad) * spot.direction;
      EXPECT_LE(glm::length(behind - middle), padded.radius) << spot.outer_cone_rad << ", " << roundoffs;
      EXPECT_LE(glm::length(ahead - middle), padded.radius) << spot.outer_cone_rad << ", " << roundoffs;
      EXPECT_LE(padded.radius - plain.radius, 0x1p-24 * (roundoffs + 2.0) * (own + 15.0));
    }
  }
}

}  // namespace
}  // namespace clusterbench::view
