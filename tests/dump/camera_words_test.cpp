#include <gtest/gtest.h>

#include "core/error.h"
#include "dump/camera.h"
#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

std::vector<double> turned_over(const std::vector<double>& m) {
  std::vector<double> out(16);
  for (std::size_t i = 0; i < 16; ++i) out[i] = m[i % 4 * 4 + i / 4];
  return out;
}

// By columns, along -z: depth = b / (clip + a).
std::vector<double> perspective_matrix(double a, double b) {
  return {0.9, 0, 0, 0, 0, 1.6, 0, 0, 0, 0, a, -1, 0, 0, b, 0};
}
const std::vector<double> k_finite = perspective_matrix(-1.001, -0.1001),  // 0..1, 0.1 to 100 m
    k_reverse = perspective_matrix(0.001, 0.1001), k_endless = perspective_matrix(0.0, 0.1),
                          k_moved = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -2, 0, 1},
                          k_at_origin = {0.6, 0, 0.8, 0, 0, 1, 0, 0, -0.8, 0, 0.6, 0, 0, 0, 0, 1};

std::string refused(const result::DumpCamera& camera, bool in_view_space = false) {
  try {
    camera_of(camera, in_view_space);
    return "";
  } catch (const Error& error) {
    return error.where() + ": " + error.message();
  }
}

result::DumpCamera camera_with(const std::vector<double>& view, const std::vector<double>& projection) {
  result::DumpCamera out;
  out.world_to_view = view;
  out.projection = projection;
  return out;
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CameraWords, a_wrong_order_is_named_and_not_what_follows_from_it) {
  for (const std::vector<double>& projection : {k_reverse, k_endless}) {
    result::DumpCamera camera = camera_with(k_at_origin, projection);
    camera.depth = "1..0";
    ASSERT_EQ(refused(camera), "");
    camera.order = "rows";
    EXPECT_EQ(refused(camera),
              "/camera/projection: has its numbers transposed; with camera.order 'columns' it is a camera's");
    camera.world_to_view.reset();
    EXPECT_EQ(refused(camera, true),
              "/camera/projection: has its numbers transposed; with camera.order 'columns' it is a camera's");
  }
}

TEST(CameraWords, a_projection_that_is_transposed_alone_is_named) {
  result::DumpCamera camera = camera_with(k_moved, turned_over(k_endless));
  camera.depth = "1..0";
  EXPECT_EQ(refused(camera),
            "/camera/projection: has its numbers transposed; with camera.projection alone transposed it is a camera's");
}

TEST(CameraWords, several_wrong_words_are_named_at_once) {
  result::DumpCamera camera = camera_with(k_moved, k_reverse);
  camera.order = "rows";
  camera.forward = "+z";
  const std::string text = refused(camera);
  for (const char* word : {"camera.order 'columns'", "camera.forward '-z'", "camera.depth '1..0'"})
    EXPECT_TRUE(says(text, word)) << word << ": " << text;
  EXPECT_EQ(text.find("; with "), text.rfind("; with ")) << text;
}

TEST(CameraWords, a_wrong_depth_is_named_also_beside_planes_that_are_given) {
  for (const char* depth : {"0..1", "-1..1"})
    for (const std::vector<double>& projection : {k_reverse, k_endless})
      for (const bool has_far : {false, true}) {
        // The finite one from 0 to 1 gives 100 m as the near plane, which 200 m as the far plane make a camera.
        if (has_far && depth == std::string("0..1") && projection == k_reverse) continue;
        result::DumpCamera camera = camera_with(k_moved, projection);
        camera.depth = depth;
        if (has_far) camera.far_m = result::Nullable<double>(200.0);
        const std::string text = refused(camera);
        EXPECT_TRUE(says(text, "/camera/projection: gives a near plane at ")) << text;
        EXPECT_TRUE(says(text, "; with camera.depth '1..0' it is a camera's")) << text;
      }
}

TEST(CameraWords, a_wrong_near_plane_is_at_its_own_key) {
  for (const double near_m : {0.0, -1.0}) {
    result::DumpCamera camera;
    camera.world_to_view = k_moved;
    camera.sides = result::Sides{-1, 1, -1, 1};
    camera.near_m = near_m;
    camera.far_m = result::Nullable<double>(100.0);
    EXPECT_TRUE(says(refused(camera), "/camera/near_m: leaves the near plane at ")) << refused(camera);
    camera.near_m = 200.0;
    EXPECT_TRUE(says(refused(camera), "/camera/far_m: leaves the near plane at 200 m and the far plane at 100 m"))
        << refused(camera);
  }
}

TEST(CameraWords, no_other_words_are_named_where_none_fit) {
  result::DumpCamera camera = camera_with(k_moved, k_finite);
  (*camera.projection)[0] = -0.9;
  EXPECT_EQ(refused(camera), "/camera/projection: mirrors the picture: number (0, 0) is below 0");
}

TEST(CameraWords, a_projection_that_is_transposed_alone_is_found_where_it_gives_a_camera_by_accident) {
  const Made made = made_frame();
  DumpFile dump = dump_of(made, made.truth);
  const view::Projection& p = made.frame.projection;
  result::DumpCamera& camera = dump.record.camera;
  camera.sides.reset();
  camera.orthographic.reset();
  camera.near_m.reset();
  camera.far_m.reset();
  const double near_m = 0.1, far_m = 100.0;  // -1..1
  camera.projection = {2.0 / (p.right - p.left),
                       0,
                       0,
                       0,
                       0,
                       2.0 / (p.top - p.bottom),
                       0,
                       0,
                       0,
                       0,
                       (far_m + near_m) / (near_m - far_m),
                       -1,
                       0,
                       0,
                       2.0 * far_m * near_m / (near_m - far_m),
                       0};
  camera.depth = "-1..1";
  ASSERT_EQ(verdict_on(dump).verdict, "right");
  camera.projection = turned_over(*camera.projection);
  ASSERT_NO_THROW(camera_of(camera, false));
  const result::CheckedSet set = verdict_on(dump);
  EXPECT_EQ(set.verdict, "misread");
  ASSERT_TRUE(set.other_reading);
  EXPECT_EQ(set.other_reading->camera, "camera.projection alone transposed");
}

}  // namespace
}  // namespace clusterbench::dump
