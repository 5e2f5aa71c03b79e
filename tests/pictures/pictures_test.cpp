// From a plan to files.

#include "pictures/pictures.h"

#include <gtest/gtest.h>

#include <set>

#include "core/error.h"
#include "core/memory.h"
#include "pictures/file_names.h"
#include "pictures/room.h"
#include "places.h"

namespace clusterbench::pictures {
namespace {

using test::all_kinds;
using test::pictures_of;
using test::Room;
using test::room;
using test::room_of;

const std::string k_grid = "room/eye/frustum-8x8-x-8-exponential-0.1..40/";

std::vector<std::string> names_of(const std::map<std::string, std::string>& pictures) {
  std::vector<std::string> names;
  for (const auto& [name, png] : pictures) names.push_back(name);
  return names;
}

TEST(Pictures, are_one_of_each_kind_per_case_with_methods_side_by_side) {
  const Room two = room_of(room(), R"("aabb", "bvh")");
  const std::map<std::string, std::string> pictures = pictures_of(two, all_kinds());
  EXPECT_EQ(names_of(pictures), (std::vector<std::string>{"room/eye/depth-frame-0.png",
                                                          k_grid + "false-positives-frame-0-aabb-packed.png",
                                                          k_grid + "false-positives-frame-0-bvh-no-lists.png",
                                                          k_grid + "false-positives-frame-0-bvh-packed.png",
                                                          k_grid + "levels-frame-0-aabb-packed.png",
                                                          k_grid + "levels-frame-0-bvh-no-lists.png",
                                                          k_grid + "levels-frame-0-bvh-packed.png",
                                                          k_grid + "lights-frame-0-aabb-packed.png",
                                                          k_grid + "lights-frame-0-bvh-no-lists.png",
                                                          k_grid + "lights-frame-0-bvh-packed.png",
                                                          k_grid + "lists-frame-0-aabb-packed.png",
                                                          k_grid + "lists-frame-0-bvh-no-lists.png",
                                                          k_grid + "lists-frame-0-bvh-packed.png",
                                                          k_grid + "missed-frame-0-aabb-packed.png",
                                                          k_grid + "missed-frame-0-bvh-no-lists.png",
                                                          k_grid + "missed-frame-0-bvh-packed.png",
                                                          k_grid + "strip-aabb-packed.png",
                                                          k_grid + "strip-bvh-no-lists.png",
                                                          k_grid + "strip-bvh-packed.png",
                                                          k_grid + "types-frame-0-aabb-packed.png",
                                                          k_grid + "types-frame-0-bvh-no-lists.png",
                                                          k_grid + "types-frame-0-bvh-packed.png"}));
  EXPECT_EQ(picture_count(two.plan, all_kinds()), pictures.size());
}

TEST(Pictures, are_the_same_bytes_on_any_number_of_threads) {
  Room many = room_of(room(), R"("aabb", "exact-fast")", R"(, "storages": [{"name": "fixed", "cap": 3}])");
  many.config.viewports = {{400, 300}};
  const std::map<std::string, std::string> on_one = pictures_of(many, all_kinds());
  many.config.threads = 4;
  EXPECT_EQ(pictures_of(many, all_kinds()), on_one);
}

TEST(Pictures, of_a_scene_without_triangles_are_those_of_a_plane_amid_the_lights) {
  const Room bare = room_of(room(false));
  const std::map<std::string, std::string> pictures = pictures_of(bare, all_kinds());
  EXPECT_FALSE(pictures.contains("room/eye/depth-frame-0.png"));
  EXPECT_EQ(pictures.size(), 7u);
  Request plane = all_kinds();
  plane.plane_m = 7.5;  // where the middle one of the lights is
  std::map<std::string, std::string> there = pictures_of(bare, plane);
  EXPECT_EQ(names_of(there), names_of(pictures));
  const std::string lists = k_grid + "lists-frame-0-aabb-packed.png";
  EXPECT_NE(there[lists], pictures.at(lists));  // it says why
  plane.plane_m = 2.0;
  EXPECT_NE(pictures_of(bare, plane)[lists], there[lists]);
}

TEST(Pictures, of_a_scene_whose_meshes_cannot_be_read_are_those_of_a_plane_and_a_warning_says_why) {
  test::Json compressed = test::Json::parse(room());
  compressed["extensionsUsed"].push_back("KHR_draco_mesh_compression");
  test::Json& primitive = compressed["meshes"][0]["primitives"][0];
  compressed["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()].erase("bufferView");
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
  const Room closed = room_of(compressed.dump());
  ASSERT_TRUE(closed.geometries.at(0));
  ASSERT_EQ(closed.geometries[0]->warnings.size(), 1u);
  EXPECT_NE(closed.geometries[0]->warnings[0].find("KHR_draco_mesh_compression"), std::string::npos);
  EXPECT_EQ(names_of(pictures_of(closed, all_kinds())), names_of(pictures_of(room_of(room(false)), all_kinds())));
}

TEST(Pictures, read_no_triangles_where_a_plane_is_asked_for) {
  const Room full = room_of(room());
  EXPECT_TRUE(full.geometries.at(0));
  Request plane;
  plane.plane_m = 7.5;
  EXPECT_FALSE(load_geometries(full.config, full.plan, plane).at(0));
}

TEST(Pictures, leave_out_methods_of_visible_surfaces_where_a_plane_is_asked_for) {
  const Room mixed = room_of(room(), R"("aabb", "tiled")");
  std::vector<std::string> skipped;
  EXPECT_EQ(pictures_of(mixed, all_kinds(), {}, &skipped).size(), 15u);
  EXPECT_TRUE(skipped.empty());
  Request plane = all_kinds();
  plane.plane_m = 8.0;
  EXPECT_EQ(pictures_of(mixed, plane, {}, &skipped).size(), 7u);
  ASSERT_EQ(skipped.size(), 1u);
  EXPECT_NE(skipped.front().find("tiled"), std::string::npos);
}

// Another scene, with a path of five frames.
Room mix_of(const std::string& assigners) {
  Room out;
  out.config = config::parse_config(R"({"scenes": [{"path": ")" + clusterbench::test::source_dir() +
                                        R"(/scenes/mix.glb", "frames": 5}], "viewport": [64, 36],
          "timing": {"measure": false}, "grids": [{"tiles": {"count": [4, 4]}}], "assigners": [)" +
                                        assigners + "]}",
                                    "c.json");
  out.plan = run::make_plan(out.config, "");
  out.geometries = load_geometries(out.config, out.plan, {});
  return out;
}

std::set<std::string> frames_in(const std::map<std::string, std::string>& pictures) {
  std::set<std::string> frames;
  for (const auto& [name, png] : pictures)
    if (const std::size_t at = name.find("frame-"); at != std::string::npos) frames.insert(name.substr(at, 7));
  return frames;
}

TEST(Pictures, of_all_cases_of_a_grid_have_the_frame_of_the_longest_list) {
  const Room two = mix_of(R"("aabb", "exact")");
  const std::vector<run::CasePlan>& cases = two.plan.groups.front().cases;
  Request request = all_kinds();
  const std::map<std::string, std::string> pictures =
      pictures_of(two, request, {{cases[0].id, {5, 1}}, {cases[1].id, {9, 3}}});
  EXPECT_EQ(frames_in(pictures), std::set<std::string>{"frame-3"});
  EXPECT_EQ(frames_in(pictures_of(two, request)), std::set<std::string>{"frame-0"});
  request.frames = Request::Frames::listed;
  request.listed = {1, 4};
  EXPECT_EQ(frames_in(pictures_of(two, request)), (std::set<std::string>{"frame-1", "frame-4"}));
  request.listed = {1, 5};
  EXPECT_THROW(picture_count(two.plan, request), Error);
}

TEST(Pictures, take_no_more_memory_than_allowed) {
  const Room one = room_of(room());
  const test::Looked looked = test::look_at(one);
  const NeededAt needed(looked.frame, looked.surface, 1);
  const MemoryLimitScope limit(10000);
  EXPECT_THROW(pictures_of(one, all_kinds()), Error);
  EXPECT_THROW(pixel_maps(looked.surface, needed, looked.frame.ranges().spots.first, looked.structure(), 1), Error);
}

TEST(Pictures, stop_when_they_are_asked_to) {
  const Room one = room_of(room());
  int made = 0;
  std::atomic<bool> stop = false;
  Listener listener;
  listener.on_picture = [&](const Picture&) { stop = ++made == 2; };
  const Request request = all_kinds();
  draw_pictures(one.config, one.plan, one.geometries, request, {}, listener, stop);
  EXPECT_EQ(made, 2);
}

TEST(DepthAmidLights, is_the_median_of_the_lights_in_the_picture) {
  const Room bare = room_of(room(false));
  const run::SceneData& data = bare.plan.scenes.front();
  const run::PathFrames path(data.scene, data.paths.front(), {64, 48});
  EXPECT_EQ(depth_amid_lights(path.frame(0), 100.0), 7.5);
  EXPECT_EQ(depth_amid_lights(path.frame(0), 5.0), 4.0);  // of those before 5 m
}

TEST(FileNames, are_safe_and_never_twice_the_same) {
  EXPECT_EQ(file_part("frustum 64px x 16 (a=b)"), "frustum-64px-x-16-a=b");
  EXPECT_EQ(file_part(".."), "_");
  EXPECT_EQ(file_part("../x"), "x");
  EXPECT_EQ(file_part(""), "_");
  EXPECT_EQ(file_part(std::string(300, 'a')).size(), 80u);
  EXPECT_EQ(file_part(std::string(79, 'a') + "\u00e4"), std::string(79, 'a'));
  FileNames names;
  EXPECT_EQ(names.of_case("a/b/c/d(1)/e", Kind::lights, 3), "a/b/c/lights-frame-3-d-1-e.png");
  EXPECT_EQ(names.of_case("a/b/c/d 1/e", Kind::lights, 3), "a/b/c/lights-frame-3-d-1-e-2.png");
  EXPECT_EQ(names.of_strip("../../c/d/e/half"), "_/_/c/strip-d-e-half.png");
  EXPECT_EQ(names.of_depth("a/walk 1/c/d/e", "-64x48", 3), "a/walk-1/depth-frame-3-64x48.png");
  EXPECT_EQ(names.of_depth("a/walk-1/c/d/e", "-64x48", 3), "a/walk-1/depth-frame-3-64x48-2.png");
}

}  // namespace
}  // namespace clusterbench::pictures
