#include "scene/writers/add_views.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "os/output_file.h"
#include "places.h"
#include "scene/scene.h"

namespace clusterbench::scene {
namespace {

namespace fs = std::filesystem;

class AddViews : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  Scene with(const ViewsRequest& request, const std::string& name = "views.glb") const {
    const Scene street = load_gltf(street_);
    os::write_file(folder_ / name, with_views(street, request, folder_ / name));
    return load_gltf(folder_ / name);
  }
  static const Camera& named(const Scene& scene, const std::string& name) {
    for (const Camera& camera : scene.cameras)
      if (camera.name == name) return camera;
    throw std::out_of_range(name);
  }

  const fs::path street_ = fs::path(test::source_dir()) / "scenes/street.glb";
  const fs::path folder_ = fs::temp_directory_path() / ("clusterbench_views_" + std::to_string(getpid()));
};

TEST_F(AddViews, eyes_stand_beside_the_camera_at_every_moment_and_look_as_it_does) {
  const Scene scene = with({"walk", {{"left", {-0.032, 0.0, 0.0}}, {"right", {0.032, 0.0, 0.0}}}, {}});
  EXPECT_EQ(scene.lights.size(), load_gltf(street_).lights.size());
  for (const double time : {0.0, 0.4 * scene.duration_s, scene.duration_s}) {
    const CameraPose head = camera_pose(scene, named(scene, "walk"), time);
    for (const double side : {-1.0, 1.0}) {
      const CameraPose eye = camera_pose(scene, named(scene, side < 0.0 ? "left" : "right"), time);
      const Vec3d apart = head.view_from_world * (eye.eye - head.eye);
      EXPECT_NEAR(apart.x, 0.032 * side, 1e-9);
      EXPECT_NEAR(apart.y, 0.0, 1e-9);
      EXPECT_NEAR(apart.z, 0.0, 1e-9);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(glm::length(eye.view_from_world[axis] - head.view_from_world[axis]), 0.0, 1e-9);
    }
  }
  EXPECT_TRUE(named(scene, "left").animated);
}

TEST_F(AddViews, a_view_is_turned_to_the_left_by_its_degrees) {
  const Scene scene = with({"", {{"aside", {0.0, 0.0, 0.0}, 90.0}, {"mirror", {0.0, 0.0, 0.0}, 180.0}}, {}});
  const auto ahead = [&](const char* name) {
    return glm::transpose(camera_pose(scene, named(scene, name), 0.0).view_from_world) * Vec3d(0.0, 0.0, -1.0);
  };
  const Vec3d walk = ahead("walk"), left = glm::cross(Vec3d(0.0, 1.0, 0.0), walk);
  EXPECT_NEAR(glm::dot(ahead("aside"), left) / glm::length(left), 1.0, 1e-6);
  EXPECT_NEAR(glm::dot(ahead("mirror"), walk), -1.0, 1e-9);
}

TEST_F(AddViews, six_faces_look_along_the_axes_with_90_degrees_each) {
  const Scene scene = with({"", {}, Vec3d{1.0, 2.0, 3.0}});
  const std::pair<const char*, Vec3d> faces[] = {{"face-px", {1, 0, 0}}, {"face-nx", {-1, 0, 0}},
                                                 {"face-py", {0, 1, 0}}, {"face-ny", {0, -1, 0}},
                                                 {"face-pz", {0, 0, 1}}, {"face-nz", {0, 0, -1}}};
  for (const auto& [name, way] : faces) {
    const Camera& camera = named(scene, name);
    const CameraPose pose = camera_pose(scene, camera, 0.0);
    EXPECT_EQ(pose.eye, Vec3d(1.0, 2.0, 3.0));
    EXPECT_NEAR(glm::length(glm::transpose(pose.view_from_world) * Vec3d(0.0, 0.0, -1.0) - way), 0.0, 1e-9) << name;
    EXPECT_NEAR(camera.projection.yfov_rad, 1.5707963267948966, 1e-12);
    EXPECT_EQ(camera.projection.aspect_ratio, 1.0);
  }
}

TEST_F(AddViews, what_cannot_be_added_is_refused) {
  EXPECT_THROW(with({"wlak", {{"left", {}}}, {}}), Error);
  EXPECT_THROW(with({"walk", {{"walk", {}}}, {}}), Error) << "a name that is taken";
  EXPECT_THROW(with({"walk", {{"a", {}}, {"a", {}}}, {}}), Error);
  EXPECT_THROW(with({"walk", {{"a", {}}}, {}}, "views.gltf"), Error) << "another kind of file";
}

}  // namespace
}  // namespace clusterbench::scene
