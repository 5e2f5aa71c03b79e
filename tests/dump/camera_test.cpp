#include "dump/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>

#include "core/error.h"
#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

constexpr double k_infinity = std::numeric_limits<double>::infinity();

// How an engine writes a camera.
struct Convention {
  const char* name;
  bool by_rows, looks_along_plus_z;
  const char* depth;
  bool clip_y_down;
};
constexpr Convention k_conventions[] = {
    {"OpenGL, three.js", false, false, "-1..1", false}, {"Vulkan, glm", false, false, "0..1", true},
    {"Bevy, Godot 4.3", false, false, "1..0", false},   {"DirectX", true, true, "0..1", false},
    {"DirectX, reversed", false, true, "1..0", false},  {"Unreal", true, true, "1..0", false},
};

std::vector<double> numbers(const Mat4d& m, bool by_rows) {
  std::vector<double> out;
  const Mat4d& in_order = by_rows ? glm::transpose(m) : m;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) out.push_back(in_order[c][r]);
  return out;
}

// From the definition: x' / w' = -1 on the left plane, and so on.
Mat4d projection_matrix(const view::Projection& p, const Convention& engine) {
  const std::string depth = engine.depth;
  const double near = depth == "-1..1" ? -1.0 : depth == "1..0" ? 1.0 : 0.0, far = depth == "1..0" ? 0.0 : 1.0;
  const double s = engine.looks_along_plus_z ? 1.0 : -1.0, up = engine.clip_y_down ? -1.0 : 1.0;
  Mat4d m(0.0);
  m[0][0] = 2.0 / (p.right - p.left);
  m[1][1] = up * 2.0 / (p.top - p.bottom);
  const double x = -(p.right + p.left) / (p.right - p.left), y = -up * (p.top + p.bottom) / (p.top - p.bottom);
  if (p.orthographic) {
    m[3][0] = x, m[3][1] = y, m[3][3] = 1.0;
    const double slope = (far - near) / (p.far_m - p.near_m);
    m[2][2] = s * slope;
    m[3][2] = near - slope * p.near_m;
    return m;
  }
  m[2][0] = s * x, m[2][1] = s * y, m[2][3] = s;
  const double a = std::isinf(p.far_m) ? far : (far * p.far_m - near * p.near_m) / (p.far_m - p.near_m);
  m[2][2] = s * a;
  m[3][2] = (near - a) * p.near_m;
  return m;
}

TEST(DumpCamera, the_matrices_of_all_conventions_give_the_same_camera) {
  const view::Space space = made_frame().frame.view_space;
  const view::Projection projections[] = {{false, -0.9, 1.0, -0.5, 0.6, 0.1, 200.0},
                                          {false, -1.0, 1.0, -0.5, 0.5, 0.25, k_infinity},
                                          {true, -20.0, 30.0, -10.0, 12.0, -5.0, 100.0}};
  for (const Convention& engine : k_conventions)
    for (const view::Projection& projection : projections)
      for (const bool inverse : {false, true}) {
        Mat3d turn = space.rotation;
        if (engine.looks_along_plus_z)
          for (int c = 0; c < 3; ++c) turn[c].z = -turn[c].z;
        Mat4d view(turn);
        view[3] = Vec4d(-(turn * space.origin), 1.0);
        result::DumpCamera given;
        (inverse ? given.view_to_world : given.world_to_view) =
            numbers(inverse ? glm::inverse(view) : view, engine.by_rows);
        given.projection = numbers(projection_matrix(projection, engine), engine.by_rows);
        given.order = engine.by_rows ? "rows" : "columns";
        given.forward = engine.looks_along_plus_z ? "+z" : "-z";
        given.depth = engine.depth;
        given.clip_y = engine.clip_y_down ? "down" : "up";
        const Camera camera = camera_of(given, false);
        // The world is right-handed here, so a left-handed view space is not a mirrored world.
        EXPECT_FALSE(camera.is_world_mirrored) << engine.name;
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(camera.view_space.origin[c], space.origin[c], 1e-9) << engine.name;
          for (int r = 0; r < 3; ++r)
            EXPECT_NEAR(camera.view_space.rotation[c][r], space.rotation[c][r], 1e-12) << engine.name;
        }
        const view::Projection& found = camera.projection;
        EXPECT_EQ(found.orthographic, projection.orthographic) << engine.name;
        EXPECT_NEAR(found.left, projection.left, 1e-9) << engine.name;
        EXPECT_NEAR(found.right, projection.right, 1e-9) << engine.name;
        EXPECT_NEAR(found.bottom, projection.bottom, 1e-9) << engine.name;
        EXPECT_NEAR(found.top, projection.top, 1e-9) << engine.name;
        EXPECT_NEAR(found.near_m, projection.near_m, 1e-9) << engine.name;
        if (std::isinf(projection.far_m))
          EXPECT_TRUE(std::isinf(found.far_m)) << engine.name;
        else
          EXPECT_NEAR(found.far_m, projection.far_m, 1e-6) << engine.name;
      }
}

TEST(DumpCamera, a_left_handed_world_gives_the_lists_of_its_mirror_image) {
  // Unity and Unreal: z (or y) of the world is the other way. The same lights, mirrored, are in the same cells.
  Made made = made_frame();
  DumpFile dump = dump_of(made, made.truth);
  for (layout::Buffer& buffer : dump.buffers)
    if (buffer.name == "lights")
      for (std::size_t light = 0; light < made.frame.lights.size(); ++light)
        for (const std::size_t at : {std::size_t{16}, std::size_t{48}})
          buffer.bytes[64 * light + at + 7] ^= std::byte{0x80};  // the sign of z
  std::vector<double>& m = *dump.record.camera.view_to_world;
  for (const std::size_t z : {2u, 6u, 10u, 14u}) m[z] = -m[z];
  for (std::size_t i = 8; i < 12; ++i) m[i] = -m[i];  // and it looks along +z of its view space
  dump.record.camera.forward = "+z";
  EXPECT_EQ(verdict_on(dump).verdict, "right");
}

TEST(DumpCamera, lights_in_view_space_need_no_view_matrix) {
  for (const char* forward : {"-z", "+z"}) {
    Made made = made_frame();
    const view::Space space = made.frame.view_space;
    DumpFile dump = dump_of(made, made.truth);
    const double s = std::string(forward) == "+z" ? -1.0 : 1.0;
    for (scene::WorldLight& light : made.frame.lights) {
      light.position = space.rotation * (light.position - space.origin) * Vec3d(1.0, 1.0, s);
      light.direction = space.rotation * light.direction * Vec3d(1.0, 1.0, s);
    }
    dump.buffers = dump_of(made, made.truth).buffers;
    dump.record.lights.space = "view";
    dump.record.camera.view_to_world.reset();
    dump.record.camera.forward = forward;
    const result::CheckedSet set = verdict_on(dump);
    EXPECT_TRUE(set.verdict == "right" || set.verdict == "rounding") << forward << " " << set.verdict;
  }
}

std::string refusal_of(const result::DumpCamera& camera) {
  try {
    camera_of(camera, false);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(DumpCamera, matrices_that_are_no_cameras_are_refused_with_the_reason) {
  const Convention& gl = k_conventions[0];
  const view::Projection projection{false, -1.0, 1.0, -0.5, 0.5, 0.1, 100.0};
  result::DumpCamera right;
  Mat4d view(1.0);
  view[3] = Vec4d(1.0, 2.0, 3.0, 1.0);
  right.world_to_view = numbers(view, false);
  right.projection = numbers(projection_matrix(projection, gl), false);
  right.depth = "-1..1";
  ASSERT_EQ(refusal_of(right), "");
  using Change = std::function<void(result::DumpCamera&)>;
  const std::pair<Change, const char*> rows[] = {
      {[](auto& c) { c.order = "rows"; },
       "/camera/world_to_view: has the last row (1, 2, 3, 1); allowed: (0, 0, 0, 1); with camera.order 'columns' it is "
       "a "
       "camera's"},
      {[](auto& c) { c.world_to_view->assign(16, 0.0); }, "/camera/world_to_view: has the last row (0, 0, 0, 0)"},
      {[](auto& c) { (*c.world_to_view)[0] = 0.0; }, "/camera/world_to_view: is singular: its axes lie in one plane"},
      {[](auto& c) { (*c.world_to_view)[0] = 2.0; },
       "/camera/world_to_view: has axes of lengths 2, 1, 1; allowed: orthogonal axes of length 1"},
      {[](auto& c) { c.world_to_view.reset(); }, "/camera/world_to_view: is missing"},
      {[](auto& c) { c.view_to_world = c.world_to_view; }, "/camera/view_to_world: stands beside world_to_view"},
      {[](auto& c) { (*c.world_to_view)[12] = 1e16; }, "/camera/world_to_view: puts the eye farther away than 1e15 m"},
      {[](auto& c) { c.projection->assign(16, 0.0); }, "/camera/projection: has a last row of zeros"},
      {[](auto& c) { (*c.projection)[0] = 0.0; }, "/camera/projection: is singular or skewed"},
      {[](auto& c) { c.forward = "+z"; },
       "/camera/projection: divides by -z: it is of a camera that looks along -z (camera.forward)"},
      {[](auto& c) { c.clip_y = "down"; }, "/camera/projection: turns the picture upside down (camera.clip_y)"},
      {[](auto& c) { c.depth = "1..0"; }, "/camera/projection: gives a near plane at "},
      {[](auto& c) { c.projection.reset(); }, "/camera/projection: or sides: name one of the two"},
      {[](auto& c) {
         c.projection.reset(), c.sides = result::Sides{1, -1, -1, 1};
       },
       "/camera/sides: are not left, right, bottom, top"},
      {[](auto& c) {
         c.projection.reset(), c.sides = result::Sides{-1, 1, -1, 1};
       },
       "/camera/near_m: is missing"}};
  for (const auto& [change, wanted] : rows) {
    result::DumpCamera changed = right;
    change(changed);
    EXPECT_EQ(refusal_of(changed).substr(0, std::string(wanted).size()), wanted);
  }
}

}  // namespace
}  // namespace clusterbench::dump
