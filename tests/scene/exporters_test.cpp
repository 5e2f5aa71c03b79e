// Files are known by their content, not by their ending.

#include "scene/gltf_document/exporters.h"

#include <gtest/gtest.h>

#include "gltf_fixture.h"

namespace clusterbench::scene::test {
namespace {

TEST(FileKinds, of_gltf_are_known_whatever_their_ending) {
  const Folder folder;
  const std::string binary = glb(chunk("JSON", document(""), ' '));
  for (const char* name : {"LEVEL.GLB", "level.vrm", "level.bin", "level.gltf", "level"}) {
    const auto path = folder.write(name, binary);
    EXPECT_TRUE(is_scene_file(path)) << name;
    EXPECT_NO_THROW(load_gltf(path)) << name;
  }
  for (const char* name : {"LEVEL.GLTF", "level.glb", "level.json.txt"}) {
    const auto path = folder.write(name, document(""));
    EXPECT_TRUE(is_scene_file(path)) << name;
    EXPECT_NO_THROW(load_gltf(path)) << name;
  }
  EXPECT_FALSE(is_scene_file(folder.write("a.json", R"({"scenes": ["level.glb"], "assigners": ["exact"]})")));
  EXPECT_FALSE(is_scene_file(folder.write("b.json", R"({"schema_version": 2, "cases": []})")));
  EXPECT_FALSE(is_scene_file(folder.path()));
  EXPECT_FALSE(is_scene_file("/no/such/file"));
}

TEST(FileKinds, of_other_programs_are_named_with_the_way_to_gltf) {
  const struct {
    std::string name, bytes, says;
  } files[] = {
      {"a.blend", "BLENDER-v300", "Punctual Lights"},
      {"b.blend", std::string("\x28\xB5\x2F\xFD\0\0", 6), "a Blender file"},
      {"c.blend", "\x1F\x8B\x08", "a Blender file"},
      {"a.fbx", "Kaydara FBX Binary  ", "an FBX file"},
      {"b.fbx", "; FBX 7.3.0 project file", "an FBX file"},
      {"a.usdc", "PXR-USDC", "a USD file"},
      {"a.usd", "#usda 1.0", "a USD file"},
      {"a.usdz", std::string("PK\x03\x04", 4), "a USD file"},
      {"a.OBJ", "# lines\nv 0 0 0\n", "meshes alone"},
      {"a.dae", "<?xml version=\"1.0\"?><COLLADA>", "COLLADA"},
      {"a.gltf", std::string("\xFF\xFE{\0", 4), "UTF-16"},
      {"a.gltf", std::string("{\0\"\0", 4), "JSON in UTF-16; glTF is UTF-8"},
      {"a.gltf", std::string("\0{\0\"", 4), "JSON in UTF-16; glTF is UTF-8"},
      {"a.gltf", std::string("\n\0{\0", 4), "JSON in UTF-16; glTF is UTF-8"},
  };
  const Folder folder;
  for (const auto& file : files) {
    const auto path = folder.write(file.name, file.bytes);
    EXPECT_TRUE(is_scene_file(path)) << file.name;
    EXPECT_NE(refusal(file.bytes, file.name).find(file.says), std::string::npos)
        << file.name << ": " << refusal(file.bytes, file.name);
  }
  // A renamed one, too; and bytes that nobody knows are no JSON.
  EXPECT_NE(refusal("BLENDER-v300", "level.glb").find("a Blender file"), std::string::npos);
  EXPECT_EQ(refusal("\x01\x02", "a.glb").find("byte 0: is neither a glb, which begins with 'glTF', nor glTF JSON"), 0U);
}

}  // namespace
}  // namespace clusterbench::scene::test
