// Compressed buffers as gltfpack and gltf-transform write them, made here by the libraries' own encoders.

#include <gtest/gtest.h>

#include <cmath>

#include "scene/gltf_document/gltf_draco.h"
#include "scene/gltf_document/gltf_meshopt.h"
#include "scene/mesh_fixture.h"

#if CLUSTERBENCH_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>

namespace clusterbench::scene::test {
namespace {

using Json = nlohmann::json;

std::string encoded_vertices(const std::string& bytes, std::size_t count, std::size_t stride) {
  std::string out(meshopt_encodeVertexBufferBound(count, stride), '\0');
  out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), bytes.data(), count,
                                        stride));
  return out;
}

std::string encoded_triangles(const std::vector<unsigned int>& indices) {
  std::string out(meshopt_encodeIndexBufferBound(indices.size(), 1000), '\0');
  out.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), indices.data(),
                                       indices.size()));
  return out;
}

std::string encoded_sequence(const std::vector<unsigned int>& indices) {
  std::string out(meshopt_encodeIndexSequenceBound(indices.size(), 1000), '\0');
  out.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(out.data()), out.size(), indices.data(),
                                         indices.size()));
  return out;
}

// A file whose bufferViews are compressed; their own buffer is a fallback that is not there.
class CompressedFile {
 public:
  Json json = {{"asset", {{"version", "2.0"}}},
               {"extensionsRequired", {"EXT_meshopt_compression"}},
               {"bufferViews", Json::array()},
               {"accessors", Json::array()},
               {"nodes", {Json::object()}}};

  void view(const std::string& stream, std::size_t count, std::size_t stride, const std::string& mode = "ATTRIBUTES",
            const std::string& filter = "", const std::string& extension = "EXT_meshopt_compression") {
    Json object = {{"buffer", 0},    {"byteOffset", stream_.size()}, {"byteLength", stream.size()},
                   {"count", count}, {"byteStride", stride},         {"mode", mode}};
    if (!filter.empty()) object["filter"] = filter;
    json["bufferViews"].push_back(
        {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", count * stride}, {"extensions", {{extension, object}}}});
    stream_ += stream;
    while (stream_.size() % 4 != 0) stream_ += '\0';
  }
  void accessor(int component, const std::string& type, std::size_t count, bool normalized = false) {
    json["accessors"].push_back({{"bufferView", json["accessors"].size()},
                                 {"componentType", component},
                                 {"type", type},
                                 {"count", count},
                                 {"normalized", normalized},
                                 {"min", {0}},
                                 {"max", {0}}});
  }
  void animate(const std::string& path) {
    json["animations"] = {{{"samplers", {{{"input", 0}, {"output", 1}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
  }
  std::string text() const {
    Json out = json;
    out["buffers"] = {
        {{"byteLength", stream_.size()}, {"uri", "data:application/octet-stream;base64," + base64(stream_)}},
        {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return out.dump();
  }

 private:
  std::string stream_;
};

constexpr std::size_t k_keys = 301;

CompressedFile walk(const std::string& extension = "EXT_meshopt_compression") {
  std::vector<float> times, values;
  for (std::size_t i = 0; i < k_keys; ++i) {
    times.push_back(static_cast<float>(i) / 30.0F);
    values.insert(values.end(), {static_cast<float>(i), 1.5F, -0.25F * static_cast<float>(i)});
  }
  CompressedFile file;
  file.view(encoded_vertices(bytes_of(times), k_keys, 4), k_keys, 4, "ATTRIBUTES", "", extension);
  file.view(encoded_vertices(bytes_of(values), k_keys, 12), k_keys, 12, "ATTRIBUTES", "NONE", extension);
  file.accessor(5126, "SCALAR", k_keys);
  file.accessor(5126, "VEC3", k_keys);
  file.animate("translation");
  return file;
}

TEST(Meshopt, keys_of_an_animation_are_what_was_encoded) {
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const Scene scene = loaded(walk(extension).text());
    ASSERT_EQ(scene.channels.size(), 1U);
    ASSERT_EQ(scene.channels[0].times_s.size(), k_keys);
    EXPECT_EQ(scene.channels[0].times_s[300], 10.0);
    EXPECT_EQ(scene.channels[0].values[300].x, 300.0);
    EXPECT_EQ(scene.channels[0].values[300].z, -75.0);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  }
}

TEST(Meshopt, the_filters_of_rotations_and_of_floats_are_undone) {
  std::vector<float> turns, heights;
  const std::vector<float> times{0, 1, 2, 3, 4};
  for (const float t : times) {
    turns.insert(turns.end(), {0.0F, std::sin(t / 4.0F), 0.0F, std::cos(t / 4.0F)});
    heights.insert(heights.end(), {t, 2.0F * t, 4.0F * t});
  }
  std::string filtered(8 * times.size(), '\0');
  meshopt_encodeFilterQuat(filtered.data(), times.size(), 8, 16, turns.data());
  CompressedFile file;
  file.view(encoded_vertices(bytes_of(times), 5, 4), 5, 4);
  file.view(encoded_vertices(filtered, 5, 8), 5, 8, "ATTRIBUTES", "QUATERNION");
  file.accessor(5126, "SCALAR", 5);
  file.accessor(5122, "VEC4", 5, true);
  file.animate("rotation");
  Scene scene = loaded(file.text());
  EXPECT_NEAR(scene.channels.at(0).values[4].y, std::sin(1.0), 1e-3);
  EXPECT_NEAR(scene.channels.at(0).values[4].w, std::cos(1.0), 1e-3);
  filtered.assign(12 * times.size(), '\0');
#if MESHOPTIMIZER_VERSION >= 190
  meshopt_encodeFilterExp(filtered.data(), times.size(), 12, 20, heights.data(), meshopt_EncodeExpSharedVector);
#else
  meshopt_encodeFilterExp(filtered.data(), times.size(), 12, 20, heights.data());
#endif
  file = CompressedFile();
  file.view(encoded_vertices(bytes_of(times), 5, 4), 5, 4);
  file.view(encoded_vertices(filtered, 5, 12), 5, 12, "ATTRIBUTES", "EXPONENTIAL");
  file.accessor(5126, "SCALAR", 5);
  file.accessor(5126, "VEC3", 5);
  file.animate("translation");
  scene = loaded(file.text());
  EXPECT_EQ(scene.channels.at(0).values[3].z, 12.0);
}

// Positions of 16 bits (KHR_mesh_quantization) and both codes of indices.
CompressedFile quad(const std::string& mode) {
  const std::vector<std::uint16_t> corners{0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 2, 2, 0, 0};
  const std::vector<unsigned int> indices{0, 1, 2, 1, 3, 2};
  CompressedFile file;
  file.view(encoded_vertices(bytes_of(corners), 4, 8), 4, 8);
  file.json["bufferViews"][0]["byteStride"] = 8;
  file.view(mode == "TRIANGLES" ? encoded_triangles(indices) : encoded_sequence(indices), 6, 2, mode);
  file.accessor(5123, "VEC3", 4);
  file.accessor(5123, "SCALAR", 6);
  file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
  file.json["nodes"] = {{{"mesh", 0}}};
  return file;
}

TEST(Meshopt, triangles_and_sequences_of_indices_and_quantized_positions_are_read) {
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    const LoadedGeometry read = loaded_geometry(quad(mode).text());
    ASSERT_EQ(read.geometry.surfaces.size(), 1U) << mode;
    EXPECT_EQ(read.geometry.surfaces[0].triangles.size(), 2U);
    EXPECT_EQ(read.geometry.surfaces[0].vertices.at(3), Vec3f(2, 2, 0));
  }
}

TEST(Meshopt, views_that_nobody_reads_are_not_decoded) {
  CompressedFile file = quad("TRIANGLES");
  file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["mode"] = "NEW";
  EXPECT_EQ(refusal(file.text()), "loads");
  EXPECT_EQ(geometry_refusal(file.text()).find("/bufferViews/0/extensions/EXT_meshopt_compression/mode: found 'NEW'"),
            0U);
}

TEST(Meshopt, what_a_view_claims_is_checked_before_memory_is_taken) {
  const std::string where = "/bufferViews/1/extensions/EXT_meshopt_compression";
  const struct {
    const char* key;
    Json value;
    std::string says;
  } cases[] = {
      {"count", 9000000000000000ULL, "/count: 9000000000000000 elements of 12 bytes do not fit into a stream of"},
      {"count", 100000, "/count: 100000 elements"},
      {"count", 330, ": the compressed data is broken"},
      {"count", 12, ": the compressed data is broken"},
      {"byteStride", 13, "/byteStride: found the number 13, a multiple of 4"},
      {"byteStride", 260, "/byteStride: found"},
      {"byteStride", 0, "/byteStride: found"},
      {"byteLength", 20, ": the compressed data is broken"},
      {"byteLength", 1e9, "do not fit into buffer 0"},
      {"mode", "TRIANGLES", "/byteStride: found the number 12, indices are 2 or 4"},
      {"mode", 5, "/mode: found the number 5, a string"},
      {"filter", "QUATERNION", "/byteStride: found the number 12, QUATERNION has 8"},
      {"filter", "ROT13", "/filter: found 'ROT13', one of NONE, OCTAHEDRAL"},
      {"buffer", 7, "/buffer: refers to buffer 7"},
  };
  for (const auto& broken : cases) {
    CompressedFile file = walk();
    file.json["bufferViews"][1]["extensions"]["EXT_meshopt_compression"][broken.key] = broken.value;
    const std::string found = refusal(file.text());
    EXPECT_NE(found.find(broken.says), std::string::npos) << broken.key << " " << broken.value << ": " << found;
    EXPECT_NE(found, "loads");
  }
}

TEST(Meshopt, any_change_of_a_byte_loads_or_is_refused) {
  const std::string sound = quad("TRIANGLES").text();
  const std::size_t begin = sound.find("base64,") + 7, end = sound.find('"', begin);
  for (std::size_t at = begin; at < end; ++at)
    for (const char change : {'A', '/', 'x'}) {
      std::string broken = sound;
      broken[at] = change;
      static_cast<void>(geometry_refusal(broken));
    }
  EXPECT_EQ(geometry_refusal(sound), "loads");
}

}  // namespace
}  // namespace clusterbench::scene::test
#endif

#if CLUSTERBENCH_HAS_DRACO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
#pragma GCC diagnostic ignored "-Woverloaded-virtual"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#pragma GCC diagnostic pop

namespace clusterbench::scene::test {
namespace {

std::string draco_quad(bool edgebreaker) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  const Vec3f p[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const int corners[2][3] = {{0, 1, 2}, {1, 3, 2}};
  for (int face = 0; face < 2; ++face) {
    const auto* at = corners[face];
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(face)), &p[at[0]],
                                      &p[at[1]], &p[at[2]]);
    builder.SetAttributeValuesForFace(uv, draco::FaceIndex(static_cast<std::uint32_t>(face)), &p[at[0]], &p[at[1]],
                                      &p[at[2]]);
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING : draco::MESH_SEQUENTIAL_ENCODING);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

std::string draco_file(const std::string& stream) {
  MeshFile file;
  file.view(stream);
  for (const char* type : {"VEC3", "SCALAR", "VEC2"})
    file.json["accessors"].push_back({{"componentType", type == std::string("SCALAR") ? 5125 : 5126},
                                      {"type", type},
                                      {"count", type == std::string("SCALAR") ? 6 : 4}});
  nlohmann::json primitive = {{"attributes", {{"POSITION", 0}, {"TEXCOORD_1", 2}}}, {"indices", 1}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                           {"attributes", {{"POSITION", 0}, {"TEXCOORD_1", 1}}}};
  file.node({{"mesh", file.mesh(primitive)}});
  return file.text();
}

TEST(Draco, triangles_and_texture_coordinates_are_what_was_encoded) {
  for (const bool edgebreaker : {false, true}) {
    const LoadedGeometry read = loaded_geometry(draco_file(draco_quad(edgebreaker)), GeometryParts::positions_and_uvs);
    ASSERT_EQ(read.geometry.surfaces.size(), 1U);
    const Surface& surface = read.geometry.surfaces[0];
    EXPECT_EQ(surface.triangles.size(), 2U);
    ASSERT_EQ(surface.vertices.size(), 4U);
    ASSERT_EQ(surface.uvs.size(), 4U);
    EXPECT_EQ(surface.uv_set, 1);
    Vec3f sum(0.0F);
    for (std::size_t i = 0; i < 4; ++i) {
      sum += surface.vertices[i];
      EXPECT_EQ(surface.uvs[i].x, surface.vertices[i].x);
    }
    EXPECT_EQ(sum, Vec3f(2, 2, 0));
  }
}

TEST(Draco, broken_data_is_refused_at_the_primitive_and_unread_where_nobody_asks) {
  const std::string sound = draco_quad(true), where = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
  EXPECT_EQ(geometry_refusal(draco_file(sound.substr(0, 20))).find(where + ": Draco: "), 0U);
  EXPECT_EQ(refusal(draco_file("no such thing")), "loads");
  EXPECT_EQ(geometry_refusal(draco_file("no such thing")).find(where), 0U);
  for (std::size_t at = 0; at < sound.size(); ++at)
    for (const int bit : {0, 3, 7}) {
      std::string broken = sound;
      broken[at] = static_cast<char>(broken[at] ^ (1 << bit));
      static_cast<void>(geometry_refusal(draco_file(broken)));
    }
}

}  // namespace
}  // namespace clusterbench::scene::test
#endif
