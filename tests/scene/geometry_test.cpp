// Meshes as exporters write them: what of a glTF file becomes triangles.

#include "scene/geometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/memory.h"
#include "scene/mesh_fixture.h"

namespace clusterbench::scene {
namespace {

using Json = nlohmann::json;
using test::MeshFile;

const std::vector<Vec3f> k_quad = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};

Json primitive(std::size_t positions) {
  return {{"attributes", {{"POSITION", positions}}}};
}

// The corners of all triangles of the first surface, as points.
std::vector<Vec3f> corners(const Geometry& geometry) {
  std::vector<Vec3f> out;
  for (const Triangle& triangle : geometry.surfaces.at(0).triangles)
    for (const std::uint32_t corner : triangle)
      out.emplace_back(geometry.surfaces[0].origin + Vec3d(geometry.surfaces[0].vertices.at(corner)));
  return out;
}

std::vector<Vec3f> corners_of(MeshFile& file, const Json& of) {
  file.node({{"mesh", file.mesh(of)}});
  return corners(test::loaded_geometry(file.text()).geometry);
}

const std::vector<Vec3f> k_two_triangles = {k_quad[0], k_quad[1], k_quad[2], k_quad[1], k_quad[3], k_quad[2]};

TEST(Geometry, lists_with_indices_of_8_16_and_32_bits_and_without_are_the_same) {
  const auto with = [](auto number) {
    MeshFile file;
    using T = decltype(number);
    Json of = primitive(file.positions(k_quad));
    of["indices"] = file.indices(std::vector<T>{0, 1, 2, 1, 3, 2});
    return corners_of(file, of);
  };
  EXPECT_EQ(with(std::uint8_t{}), k_two_triangles);
  EXPECT_EQ(with(std::uint16_t{}), k_two_triangles);
  EXPECT_EQ(with(std::uint32_t{}), k_two_triangles);
  MeshFile file;
  EXPECT_EQ(corners_of(file, primitive(file.positions(k_two_triangles))), k_two_triangles);
}

TEST(Geometry, strips_and_fans_turn_their_triangles_as_the_specification_does) {
  MeshFile strip;
  Json of = primitive(strip.positions(k_quad));
  of["mode"] = 5;
  EXPECT_EQ(corners_of(strip, of),
            (std::vector<Vec3f>{k_quad[0], k_quad[1], k_quad[2], k_quad[1], k_quad[3], k_quad[2]}));
  MeshFile fan;
  of = primitive(fan.positions({k_quad[0], k_quad[1], k_quad[3], k_quad[2]}));
  of["mode"] = 6;
  EXPECT_EQ(corners_of(fan, of),
            (std::vector<Vec3f>{k_quad[1], k_quad[3], k_quad[0], k_quad[3], k_quad[2], k_quad[0]}));
}

TEST(Geometry, points_and_lines_and_what_has_no_positions_are_left_out) {
  MeshFile file;
  Json of = primitive(file.positions(k_quad));
  of["mode"] = 1;
  file.node({{"mesh", file.mesh(of)}});
  file.node({{"mesh", file.mesh({{"attributes", Json::object()}})}});
  EXPECT_TRUE(test::loaded_geometry(file.text()).geometry.empty());
}

TEST(Geometry, interleaved_positions_are_read_by_their_stride) {
  MeshFile file;
  std::vector<Vec3f> interleaved;
  for (const Vec3f& vertex : k_two_triangles) {
    interleaved.push_back(vertex);
    interleaved.emplace_back(9.0f, 9.0f, 9.0f);  // a normal, say
  }
  std::string bytes = test::bytes_of(interleaved);
  bytes.resize(bytes.size() - sizeof(Vec3f));  // nothing follows the last one
  EXPECT_EQ(corners_of(file, primitive(file.accessor(bytes, 5126, "VEC3", 6, 24))), k_two_triangles);
}

TEST(Geometry, sparse_positions_replace_what_they_name) {
  MeshFile file;
  std::vector<Vec3f> moved = k_two_triangles;
  moved[4] = {7, 7, 7};
  const std::size_t positions = file.positions(moved);
  file.json["accessors"][positions]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", file.view(test::bytes_of(std::vector<std::uint16_t>{4}))}, {"componentType", 5123}}},
      {"values", {{"bufferView", file.view(test::bytes_of(std::vector<Vec3f>{k_quad[3]}))}}}};
  EXPECT_EQ(corners_of(file, primitive(positions)), k_two_triangles);
}

TEST(Geometry, quantized_positions_are_numbers_or_shares) {
  MeshFile file;
  const std::vector<std::int16_t> shorts = {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, 0, 0};  // VEC3 on a stride of 8
  const std::size_t positions = file.accessor(test::bytes_of(shorts), 5122, "VEC3", 3, 8);
  file.json["accessors"][positions]["normalized"] = true;
  EXPECT_EQ(corners_of(file, primitive(positions)), (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
}

TEST(Geometry, materials_say_what_is_seen_through_and_from_both_sides) {
  MeshFile file;
  const std::size_t positions = file.positions(k_two_triangles);
  for (const Json& material : {Json{{"alphaMode", "BLEND"}}, Json{{"alphaMode", "MASK"}, {"doubleSided", true}}}) {
    Json of = primitive(positions);
    of["material"] = file.material(material);
    file.node({{"mesh", file.mesh(of)}});
  }
  const Geometry geometry = test::loaded_geometry(file.text()).geometry;
  ASSERT_EQ(geometry.surfaces.size(), 2U);
  EXPECT_TRUE(geometry.surfaces[0].blends && !geometry.surfaces[0].double_sided);
  EXPECT_TRUE(!geometry.surfaces[1].blends && geometry.surfaces[1].double_sided);
}

TEST(Geometry, a_mesh_of_two_nodes_is_read_once_and_nodes_of_other_scenes_are_not_there) {
  MeshFile file;
  const std::size_t mesh = file.mesh(primitive(file.positions(k_two_triangles)));
  for (int i = 0; i < 3; ++i) file.node({{"mesh", mesh}});
  file.json["scenes"] = {{{"nodes", {2}}}, {{"nodes", {0, 1}}}};
  file.json["scene"] = 1;
  const Geometry geometry = test::loaded_geometry(file.text()).geometry;
  EXPECT_EQ(geometry.surfaces.size(), 1U);
  EXPECT_EQ(geometry.instances.size(), 2U);
  EXPECT_EQ(geometry.triangle_count(), 4U);
}

// Two joints, the second half a metre above the first; the bind pose has them at the origin.
TEST(Geometry, skins_stand_as_their_joints_rest_whatever_moves_them) {
  MeshFile file;
  Json of = primitive(file.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  of["attributes"]["JOINTS_0"] =
      file.accessor(test::bytes_of(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}), 5121, "VEC4", 3);
  of["attributes"]["WEIGHTS_0"] =
      file.accessor(test::bytes_of(std::vector<float>{1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0}), 5126, "VEC4", 3);
  file.node({{"mesh", file.mesh(of)}, {"skin", 0}, {"translation", {100, 0, 0}}});  // of no meaning for skinned meshes
  file.node({{"translation", {0, 0, -2}}, {"children", {2}}});
  file.node({{"translation", {0, 0.5, 0}}});
  file.json["skins"] = {{{"joints", {1, 2}}}};
  file.json["scenes"] = {{{"nodes", {0, 1}}}};
  const Geometry geometry = test::loaded_geometry(file.text()).geometry;
  EXPECT_EQ(geometry.instances.at(0).node, -1);
  EXPECT_EQ(corners(geometry), (std::vector<Vec3f>{{0, 0, -2}, {1, 0.25, -2}, {0, 1.5, -2}}));
}

TEST(Geometry, a_skin_without_joints_and_joints_that_are_no_indices_are_refused) {
  const auto refusal = [](const Json& joints, int component, bool normalized) {
    MeshFile file;
    Json of = primitive(file.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    const std::size_t chosen = file.accessor(std::string(48, '\0'), component, "VEC4", 3, 16);
    if (normalized) file.json["accessors"][chosen]["normalized"] = true;
    of["attributes"]["JOINTS_0"] = chosen;
    of["attributes"]["WEIGHTS_0"] = file.accessor(std::string(48, '\0'), 5126, "VEC4", 3);
    file.node({{"mesh", file.mesh(of)}, {"skin", 0}});
    file.json["skins"] = {{{"joints", joints}}};
    return test::geometry_refusal(file.text());
  };
  EXPECT_EQ(refusal({0}, 5121, false), "loads");
  EXPECT_EQ(refusal(Json::array(), 5121, false), "/skins/0/joints: a skin needs a joint");
  EXPECT_EQ(refusal({0}, 5126, false), "/accessors/1/componentType: indices must be one of 5121, 5123");
  EXPECT_EQ(refusal({0}, 5120, false), "/accessors/1/componentType: indices must be one of 5121, 5123");
  EXPECT_EQ(refusal({0}, 5121, true), "/accessors/1/normalized: indices are no shares");
}

TEST(Geometry, what_is_broken_is_refused_where_it_stands_and_only_if_it_is_read) {
  const auto refusal = [](auto&& spoil) {
    MeshFile file;
    Json of = primitive(file.positions(k_quad));
    of["indices"] = file.indices(std::vector<std::uint16_t>{0, 1, 2});
    spoil(file, of);
    file.node({{"mesh", file.mesh(of)}});
    return test::geometry_refusal(file.text());
  };
  EXPECT_EQ(refusal([](MeshFile&, Json&) {}), "loads");
  EXPECT_EQ(refusal([](MeshFile& file, Json& of) {
              of["indices"] = file.indices(std::vector<std::uint16_t>{0, 1, 4});
            }),
            "/meshes/0/primitives/0/indices: index 4 of 4 vertices");
  EXPECT_EQ(refusal([](MeshFile& file, Json&) { file.json["accessors"][1]["componentType"] = 5122; }),
            "/accessors/1/componentType: indices must be one of 5121, 5123, 5125");
  EXPECT_EQ(refusal([](MeshFile& file, Json&) { file.json["accessors"][0]["type"] = "VEC2"; }),
            "/accessors/0/type: found VEC2, VEC3 is needed");
  EXPECT_EQ(refusal([](MeshFile& file, Json&) { file.json["bufferViews"][0]["byteStride"] = 8; }),
            "/accessors/0: elements of 12 bytes do not fit into a byteStride of 8");
  EXPECT_NE(refusal([](MeshFile& file, Json&) { file.json["accessors"][0]["count"] = 5; }).find("do not fit"),
            std::string::npos);
  EXPECT_NE(refusal([](MeshFile& file, Json&) {
              file.json["accessors"][0]["count"] = std::uint64_t{1} << 31;
            }).find("limits.memory_mib"),
            std::string::npos);
  EXPECT_EQ(
      refusal([](MeshFile&, Json& of) { of["mode"] = 7; }),
      "/meshes/0/primitives/0/mode: found the number 7; allowed are 4, 5 and 6 (triangles, their strips and fans), "
      "and 0 to 3 (points and lines, which are left out)");
  EXPECT_EQ(refusal([](MeshFile& file, Json& of) {
              of["material"] = file.material({{"doubleSided", "yes"}});
            }),
            "/materials/0/doubleSided: found a string, true or false is needed");
}

TEST(Geometry, a_mode_of_blending_that_is_not_known_is_opaque_with_a_warning) {
  MeshFile file;
  Json of = primitive(file.positions(k_two_triangles));
  of["material"] = file.material({{"alphaMode", "Blend"}});
  file.node({{"mesh", file.mesh(of)}});
  const Geometry geometry = test::loaded_geometry(file.text()).geometry;
  EXPECT_FALSE(geometry.surfaces.at(0).blends);
  EXPECT_EQ(geometry.warnings,
            (std::vector<std::string>{"/materials/0/alphaMode: the mode 'Blend' is not known (OPAQUE, MASK and BLEND "
                                      "are); read as OPAQUE"}));
}

TEST(Geometry, that_takes_too_much_memory_is_refused_before_it_is_read) {
  const MemoryLimitScope little(4 << 20);
  MeshFile file;
  Json of = primitive(file.positions(k_quad));
  of["mode"] = 5;
  of["indices"] = file.indices(std::vector<std::uint8_t>(500'000, 9));  // of no vertex
  file.node({{"mesh", file.mesh(of)}});
  EXPECT_EQ(test::geometry_refusal(file.text()),
            "limits.memory_mib: 499998 triangles would take 5 MiB, and 4 MiB are allowed; raise the limit, or use "
            "simpler meshes");
}

const std::vector<Vec2f> k_quad_uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};

TEST(Geometry, texture_coordinates_are_read_only_if_they_are_asked_for) {
  MeshFile file;
  Json of = primitive(file.positions(k_two_triangles));
  of["attributes"]["TEXCOORD_0"] = file.accessor("too short", 5126, "VEC2", 6);
  file.node({{"mesh", file.mesh(of)}});
  const Geometry geometry = test::loaded_geometry(file.text()).geometry;
  EXPECT_TRUE(geometry.surfaces.at(0).uvs.empty());
  EXPECT_EQ(geometry.surfaces[0].uv_set, -1);
  EXPECT_NE(test::geometry_refusal(file.text(), GeometryParts::positions_and_uvs), "loads");
  MeshFile bare;
  bare.node({{"mesh", bare.mesh(primitive(bare.positions(k_two_triangles)))}});
  EXPECT_EQ(geometry.sha256, test::loaded_geometry(bare.text()).geometry.sha256);
  EXPECT_EQ(geometry.sha256, test::loaded_geometry(bare.text(), GeometryParts::positions_and_uvs).geometry.sha256);
}

TEST(Geometry, a_light_map_has_the_second_texture_coordinates_where_all_of_a_mesh_has_them) {
  const auto sets_of = [](bool second_has_both) {
    MeshFile file;
    Json first = primitive(file.positions(k_quad)), second = primitive(file.positions(k_quad)), lines = first;
    first["mode"] = second["mode"] = 5;
    lines["mode"] = 1;
    first["attributes"]["TEXCOORD_0"] = second["attributes"]["TEXCOORD_0"] = file.uvs({4, {9, 9}});
    first["attributes"]["TEXCOORD_1"] = file.uvs(k_quad_uvs);
    if (second_has_both) second["attributes"]["TEXCOORD_1"] = file.uvs(k_quad_uvs);
    file.mesh(first);
    file.json["meshes"][0]["primitives"] = {first, lines, second};
    file.node({{"mesh", 0}});
    return test::loaded_geometry(file.text(), GeometryParts::positions_and_uvs).geometry.surfaces;
  };
  const std::vector<Surface> both = sets_of(true), one = sets_of(false);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].uv_set, 1);
  EXPECT_EQ(both[1].uvs, k_quad_uvs);
  EXPECT_EQ(one[0].uv_set, 0);
  EXPECT_EQ(one[0].uvs, (std::vector<Vec2f>(4, {9, 9})));
}

TEST(Geometry, texture_coordinates_may_be_shares_and_need_one_per_vertex_near_0) {
  const auto with = [](auto&& add) {
    MeshFile file;
    Json of = primitive(file.positions(k_quad));
    of["mode"] = 5;
    of["attributes"]["TEXCOORD_0"] = add(file);
    file.node({{"mesh", file.mesh(of)}});
    return file.text();
  };
  const auto parts = GeometryParts::positions_and_uvs;
  const std::string shares = with([](MeshFile& file) {
    const std::size_t out = file.accessor(
        test::bytes_of(std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 65535, 65535, 65535}), 5123, "VEC2", 4);
    file.json["accessors"][out]["normalized"] = true;
    return out;
  });
  EXPECT_EQ(test::loaded_geometry(shares, parts).geometry.surfaces.at(0).uvs, k_quad_uvs);
  const std::string where = "/meshes/0/primitives/0/attributes/TEXCOORD_0: ";
  EXPECT_EQ(test::geometry_refusal(with([](MeshFile& file) {
                                     return file.uvs({{0, 0}, {1, 0}, {0, 1}});
                                   }),
                                   parts),
            where + "3 texture coordinates for 4 vertices");
  EXPECT_EQ(test::geometry_refusal(with([](MeshFile& file) {
                                     return file.uvs({{0, 0}, {1, 0}, {0, 4097}, {1, 1}});
                                   }),
                                   parts),
            where + "texture coordinate 2 lies beyond -4096..4096");
  EXPECT_EQ(test::geometry_refusal(with([](MeshFile& file) { return file.positions(k_quad); }), parts),
            "/accessors/1/type: found VEC3, VEC2 is needed");
  EXPECT_EQ(test::geometry_refusal(with([](MeshFile&) { return 7; }), parts).substr(0, where.size()), where);
}

}  // namespace
}  // namespace clusterbench::scene
