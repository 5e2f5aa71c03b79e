#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

const std::string k_mix = "light-map " + source_file("scenes/mix.glb") + " --unwrap --texels-per-metre 0.5";

Json without_time(const std::string& text) {
  Json out = Json::parse(text);
  for (Json& scene : out["scenes"]) scene.erase("seconds");
  return out;
}

TEST(LightMapCommand, what_it_writes_is_valid_and_the_same_for_any_number_of_threads) {
  const Folder folder;
  const std::string out = (folder / "maps.json").string(), tests = k_mix + " --facing --visibility";
  const Outcome done = tool(tests + " -o " + out);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("mix: 225 point lights and 75 spot lights"), std::string::npos) << done.err;
  EXPECT_EQ(tool("validate " + out).out, out + ": valid, light maps of `clusterbench light-map` with 1 scene\n");
  const Json one = without_time(file_text(out));
  EXPECT_EQ(without_time(tool(tests + " --threads 3 -q").out), one);
  const Json& all = one["scenes"][0]["all"];
  EXPECT_EQ(one["scenes"][0]["maps"].size(), 4u);
  EXPECT_GT(all["texels"]["lit"], 0);
  // Each test leaves out more, and texels are all that is counted.
  EXPECT_GT(all["left_after"]["range"], all["left_after"]["cone"]);
  EXPECT_GT(all["left_after"]["cone"], all["left_after"]["facing"]);
  EXPECT_GT(all["left_after"]["facing"], all["left_after"]["visibility"]);
  EXPECT_EQ(all["left_after"]["visibility"], all["bits_set"]);
  EXPECT_EQ(all["texels"]["covered"].get<int>() + all["texels"]["dead"].get<int>(), all["texels"]["all"]);
  const Json bare = without_time(tool(k_mix + " -q").out);
  EXPECT_TRUE(bare["scenes"][0]["all"]["left_after"]["facing"].is_null());
  EXPECT_EQ(bare["scenes"][0]["all"]["left_after"]["cone"], bare["scenes"][0]["all"]["bits_set"]);
}

TEST(LightMapCommand, a_person_reads_a_table_and_what_has_no_map) {
  const Outcome made = tool_on_terminal(k_mix);
  EXPECT_EQ(made.code, 0);
  EXPECT_EQ(made.out.find("light_map_version"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("houses"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("all 4 maps"), std::string::npos) << made.out;
  const Outcome none = tool_on_terminal("light-map " + source_file("scenes/mix.glb"));
  EXPECT_EQ(none.code, 0);
  EXPECT_NE(none.out.find("left out  'ground' has no texture coordinates, and 3 others likewise"), std::string::npos)
      << none.out;
}

TEST(LightMapCommand, what_it_cannot_do_is_told_in_a_line) {
  const Folder folder;
  const std::string slope = source_file("scenes/slope.glb");
  const std::string broken =
      folder
          .write("broken.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}}]}],
    "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3}, {"componentType": 5126, "type": "VEC2", "count": 2}]})")
          .string();
  const std::pair<std::string, const char*> rows[] = {
      {"/nowhere.glb", "/nowhere.glb"},
      {broken, "/meshes/0/primitives/0/attributes/TEXCOORD_0: 2 texture coordinates for 3 vertices"},
      {slope + " --resolution 0x4", "--resolution: '0x4' is not SIDE or WIDTHxHEIGHT"},
      {slope + " --resolution 4x", "--resolution: '4x' is not SIDE or WIDTHxHEIGHT"},
      {slope + " --resolution 4x5x6", "--resolution: '4x5x6' is not SIDE or WIDTHxHEIGHT"},
      {slope + " --resolution 99999", "--resolution: '99999' is not SIDE or WIDTHxHEIGHT"},
      {slope + " --resolution 4 --unwrap", "--resolution: has no meaning with --unwrap"},
      {slope + " --texels-per-metre 0", "--texels-per-metre: takes a number"},
      {slope + " --lamp-radius 2", "--lamp-radius"},
      {slope + " --tile 0", "--tile: takes a whole number from 1"},
      {slope + " --threads 0", "--threads: takes a whole number from 1"},
      {slope + " --unwrap --texels-per-metre 1000", "mesh 'hallway': its map would be more than 16384 texels"},
      {slope + " -o " + slope, "slope.glb"},
      {slope + " -o /nowhere/maps.json", "/nowhere/maps.json: cannot be written"},
      {"", "light-map: SCENE is required"},
  };
  for (const auto& [line, message] : rows) {
    const Outcome done = tool("light-map -q " + line);
    EXPECT_EQ(done.code, 2) << line;
    EXPECT_NE(done.err.find(message), std::string::npos) << line << ": " << done.err;
    EXPECT_EQ(done.out.find_first_not_of(' '), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace clusterbench::test
