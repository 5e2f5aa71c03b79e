#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/lamps.h"
#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

// A few frames of the street, in one case.
const std::string k_search =
    "worst-case " + source_file("scenes/street.glb") + " --grid frustum --tiles 128 --assigner aabb-fast";
const std::string k_short_search = k_search + " --evaluations 60 --random 20";

TEST(WorstCaseCommand, what_it_writes_is_valid_and_run_and_size_take_it) {
  const Folder folder;
  const std::string path = (folder / "worst.gltf").string(), out = (folder / "out.json").string(),
                    config = (folder / "worst.json").string(), result = (folder / "result.json").string();
  const Outcome done = tool(k_short_search + " --best 3 --path " + path + " -o " + out);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("clusterbench run " + config), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("  measure      entries: index entries of the lists, with room for all of them\n"),
            std::string::npos)
      << done.err;
  EXPECT_EQ(tool("validate " + out).out, out + ": valid, a result of `clusterbench worst-case` with 3 frames\n");
  EXPECT_EQ(tool("validate " + config).code, 0);
  const auto found = nlohmann::json::parse(file_text(out));
  EXPECT_EQ(found["written"]["scene"], path);
  ASSERT_EQ(tool("run -q " + config + " -o " + result).code, 0);
  const auto run = nlohmann::json::parse(file_text(result));
  ASSERT_EQ(run["cases"].size(), 1u);
  EXPECT_EQ(run["cases"][0]["buffers"]["index_entries"]["high_water"], found["frames"][0]["value"]);
  EXPECT_EQ(run["cases"][0]["error"]["false_negatives"], 0);
  const Outcome size = tool("size --format json " + result);
  ASSERT_EQ(size.code, 0) << size.err;
  EXPECT_EQ(nlohmann::json::parse(size.out)["structures"][0]["buffers"][0]["high_water"], found["frames"][0]["value"]);
  // Without the configuration: the same flags on the scene that was written.
  const std::string flags = " --grid frustum --tiles 128 --assigner aabb-fast --no-timing -q";
  const auto bare = nlohmann::json::parse(tool("run " + path + flags).out);
  EXPECT_EQ(bare["cases"][0]["buffers"]["index_entries"]["high_water"], found["frames"][0]["value"]);
}

TEST(WorstCaseCommand, what_could_be_chosen_goes_with_the_find_to_where_it_is_used) {
  const Folder folder;
  const std::string out = (folder / "out.json").string(),
                    level = " --grid frustum --tiles 128 --assigner aabb-fast " + source_file("scenes/street.glb"),
                    space = "--keep-direction --add-lights 4 --add-lights 4 --move-lights 0.5",
                    box = "--within=-1.5,0,-2,1,2,3 ";
  ASSERT_EQ(tool("worst-case -q --evaluations 40 --random 0 --within -1.5,0,-2,1,2,3 --keep-direction "
                 "--add-lights 2x4 --move-lights 0.5 -o " +
                 out + level)
                .code,
            0);
  const auto found = nlohmann::json::parse(file_text(out));
  EXPECT_EQ(found["space"]["flags"], box + space);
  EXPECT_EQ(tool("worst-case -q --evaluations 40 --random 0 " + box + space + level).out, file_text(out));
  const Outcome size = tool("size -q --format hlsl --found " + out + level);
  ASSERT_EQ(size.code, 0) << size.err;
  EXPECT_NE(size.out.find("tried (seed 1, " + box + space + ")"), std::string::npos) << size.out;
}

TEST(WorstCaseCommand, the_recorded_path_takes_a_quarter_of_the_seconds_at_most) {
  const Outcome done = tool(k_search + " -q --random 0 --seconds 0.1 --set 'scenes.*.frames=5000'");
  ASSERT_EQ(done.code, 0) << done.err;
  const auto found = nlohmann::json::parse(done.out);
  EXPECT_GE(found["recorded"]["frames"], 1);
  EXPECT_LT(found["recorded"]["frames"], 5000) << "no machine measures a frame in 5 us";
}

// "range": 0 would be read as none, and the range rule would give it one.
TEST(WorstCaseCommand, a_range_of_nothing_is_one_in_the_written_path) {
  const Folder folder;
  nlohmann::json level = nlohmann::json::parse(level_of(row_of(3)));
  level["extensions"]["KHR_lights_punctual"]["lights"].push_back(
      {{"type", "point"}, {"range", 1e-16}, {"intensity", 1000.0}});
  level["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 2;
  const std::string path = (folder / "worst.gltf").string();
  const Outcome done = tool("worst-case " + folder.write("level.gltf", level.dump()).string() +
                            " -q --grid frustum --tiles 8x5t --slices 4 --assigner exact-fast --evaluations 20 "
                            "--random 0 --path " +
                            path + " -o " + (folder / "out.json").string());
  EXPECT_EQ(done.code, 0) << done.err;
}

TEST(WorstCaseCommand, what_fails_leaves_what_was_there) {
  const Folder folder;
  const std::string kept = folder.write("kept.json", "old").string(), absent = (folder / "absent.json").string();
  for (const std::string& output : {kept, absent})
    EXPECT_EQ(tool("worst-case " + source_file("scenes/street.glb") + " -q --within 1,1,1,0,0,0 -o " + output).code, 2);
  EXPECT_EQ(file_text(kept), "old");
  EXPECT_FALSE(std::filesystem::exists(absent));
}

TEST(WorstCaseCommand, threads_change_nothing_and_a_person_reads_text) {
  const std::string alone = tool(k_short_search + " --threads 1").out;
  EXPECT_EQ(tool(k_short_search + " --threads 3").out, alone);
  const Outcome shown = tool_on_terminal(k_short_search);
  EXPECT_EQ(shown.out.find("schema_version"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("at most in 20 random frames"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("clusterbench: the result is not kept; -o FILE keeps it"), std::string::npos) << shown.out;
}

TEST(WorstCaseCommand, what_it_cannot_do_is_told_in_a_line) {
  const Folder folder;
  const std::string scene = source_file("scenes/street.glb");
  const std::string dark = folder
                               .write("dark.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
    "nodes": [{"camera": 0}], "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]})")
                               .string();
  const std::pair<std::string, const char*> rows[] = {
      {scene + " --add-lights 3 --within 1,0,0,0,0,0", "--within: must have"},  // one light of 3 m range
      {scene + " --add-lights x4", "--add-lights: 'x4' is not COUNTxRANGE"},
      {scene + " --add-lights 2.5x4", "--add-lights: '2.5x4' is not COUNTxRANGE"},
      {scene + " --add-lights 2xnan", "--add-lights: '2xnan' is not COUNTxRANGE"},
      {scene + " --add-lights 2x-1", "--add-lights: '2x-1' is not COUNTxRANGE"},
      {scene + " --add-lights 65x1", "--add-lights: '65x1' is not COUNTxRANGE"},
      {scene + " --add-lights 40x1 --add-lights 40x1", "--add-lights: adds more than 64 lights"},
      {scene + " --within 0,0,0,1,1", "--within: '0,0,0,1,1' is no box"},
      {scene + " --within 0,0,0,1,1,nan", "--within: '0,0,0,1,1,nan' is no box"},
      {scene + " --within 0,0,0,1,1,", "--within: '0,0,0,1,1,' is no box"},
      {scene + " --within 0,0,0,-1,1,1", "--within: must have its minimum not above its maximum"},
      {scene + " --evaluations 0", "--evaluations: takes a whole number from 1"},
      {scene + " --best 0", "--best: takes a whole number from 1"},
      {scene + " --path worst.glb", "worst.glb: --path: must end in .gltf"},
      {scene + " --path /nowhere/worst.gltf", "/nowhere/worst.gltf: cannot be written"},
      {scene + " -o /nowhere/out.json", "/nowhere/out.json: cannot be written"},
      {scene + " --walkable", "the scene has no triangles"},
      {scene + " --measure longst", "no 'longst' (did you mean 'longest'?)"},
      {scene + " --filter nothing", "--filter: 'nothing' matches none"},
      {scene + " --grid frustum --assigner bvh --filter /own --measure p99", "has no cells"},
      {scene + " --add-lights 0x5", "--add-lights: '0x5' is not COUNTxRANGE"},
      {dark, "has no point or spot light, and none is added"},
      {source_file("configs/depth.json") + " --filter tiled", "need depth"},
  };
  for (const auto& [line, message] : rows) {
    const Outcome done = tool("worst-case --random 0 -q " + line);
    EXPECT_EQ(done.code, 2) << line;
    EXPECT_NE(done.err.find(message), std::string::npos) << line << ": " << done.err;
    EXPECT_EQ(done.out, "") << line;
  }
}

TEST(WorstCaseCommand, a_search_never_writes_over_what_it_reads) {
  const Folder folder;
  const std::string scene = (folder / "level.gltf").string(), config = (folder / "level.json").string();
  folder.write("level.gltf", R"({"asset": {"version": "2.0"}})");
  folder.write("level.json", R"({"scenes": ["level.gltf"]})");
  EXPECT_NE(tool("worst-case " + scene + " --path " + scene).code, 0);
  EXPECT_EQ(file_text(scene), R"({"asset": {"version": "2.0"}})");
  EXPECT_NE(tool("worst-case " + config + " --path " + (folder / "level.gltf").string()).code, 0);
  EXPECT_EQ(file_text(config), R"({"scenes": ["level.gltf"]})");
}

TEST(WorstCaseCommand, an_interrupt_ends_it_with_the_worst_frames_by_then) {
  const Folder folder;
  const std::string out = (folder / "out.json").string(), path = (folder / "worst.gltf").string();
  const std::string search = test::program() + " " + k_search + " --evaluations 10000000 --path " + path + " -o " +
                             out + " 2>" + (folder / "err").string();
  // Until it says how long it takes, which a busy machine and sanitizers delay; then enough to find a frame, of hours.
  const std::string wait = "until grep -q 'takes about' " + (folder / "err").string() + "; do sleep 0.1; done; sleep 4";
  const int status = std::system((search + " & pid=$!; " + wait + "; kill -TERM $pid; wait $pid").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 75) << file_text(folder / "err");
  const auto found = nlohmann::json::parse(file_text(out));
  EXPECT_EQ(found["ended"], "signal");
  EXPECT_EQ(found["random"], nullptr);
  EXPECT_EQ(tool("validate " + out).code, 0);
  EXPECT_EQ(found["frames"].size(), 1u);
  EXPECT_NE(file_text(path).find("KHR_lights_punctual"), std::string::npos);
}

}  // namespace
}  // namespace clusterbench::test
