// The places where a run writes, and the files that it must not replace.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/small_config.h"
#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

TEST(Run, the_result_goes_to_standard_output_without_a_file) {
  const Folder folder;
  const Outcome done = tool("run --quiet --no-timing " + folder.write("small.json", small_config()).string());
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(Json::parse(done.out)["schema_version"], 2);
  EXPECT_EQ(done.err, "");
}

TEST(Run, on_a_terminal_the_table_is_shown_and_the_result_only_on_request) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const Outcome shown = tool_on_terminal("run --no-timing " + config);
  EXPECT_EQ(shown.code, 0) << shown.out;
  EXPECT_NE(shown.out.find("excess"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("clusterbench: the result is not kept; -o FILE keeps it"), std::string::npos) << shown.out;
  EXPECT_EQ(shown.out.find("schema_version"), std::string::npos) << shown.out;
  EXPECT_NE(tool_on_terminal("run --no-timing -o - " + config).out.find("schema_version"), std::string::npos);
  EXPECT_NE(tool("run --no-timing " + config).out.find("schema_version"), std::string::npos);
}

TEST(Run, quiet_hides_progress_and_table_and_no_warning) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const Outcome done =
      tool("run -q --rounds 1 --launches 1 --filter '/aabb/' -o " + (folder / "r.json").string() + " " + config);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("warning: 1 of 1 time without an interval: "), std::string::npos) << done.err;
  EXPECT_EQ(done.err.find("frame us"), std::string::npos) << done.err;
}

TEST(Run, a_place_that_cannot_be_written_is_noticed_before_measuring) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const Outcome missing = tool("run " + config + " -o " + (folder / "no/such/folder/r.json").string());
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.err.find("no/such/folder"), std::string::npos) << missing.err;
  EXPECT_EQ(missing.err.find("aabb"), std::string::npos) << "measured first: " << missing.err;
  const Outcome full = tool("run " + config + " -o /dev/full");
  EXPECT_EQ(full.code, 70);
  EXPECT_EQ(full.err.find("aabb"), std::string::npos) << "measured first: " << full.err;
}

TEST(Run, an_output_in_a_folder_that_is_not_there_names_the_folder_before_anything_is_measured) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  for (const std::string& output :
       {std::string("-o nodir/x.json"), std::string("-o x.json --export csv=nodir/x.csv")}) {
    const Outcome done = tool_in(folder.path(), "run -q " + config + " " + output);
    EXPECT_EQ(done.code, 2);
    EXPECT_NE(done.err.find("cannot be written: there is no folder 'nodir'; make it first (mkdir -p)"),
              std::string::npos)
        << done.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "x.json"));
  folder.write("file", "");
  const Outcome in_file = tool_in(folder.path(), "run -q " + config + " -o file/x.json");
  EXPECT_NE(in_file.err.find("'file' is no folder"), std::string::npos) << in_file.err;
}

TEST(Run, a_result_goes_where_a_link_leads) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const std::filesystem::path link = folder / "link.json", target = folder / "target.json";
  std::filesystem::create_symlink("target.json", link);
  ASSERT_EQ(tool("run -q --no-timing " + config + " -o " + link.string()).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(Json::parse(file_text(target))["name"], "small");
  const std::filesystem::path circle = folder / "circle.json";
  std::filesystem::create_symlink("circle.json", circle);
  EXPECT_EQ(tool("run -q --no-timing " + config + " -o " + circle.string()).code, 2);
}

// What a command reads is not written over, nor one output by another.
TEST(Run, an_output_over_an_input_or_another_output_is_refused) {
  const Folder folder;
  const std::string scene = (folder / "level.glb").string(), link = (folder / "link.glb").string();
  const std::string results = (folder / "r.json").string();
  std::filesystem::copy_file(source_file("scenes/street.glb"), scene);
  std::filesystem::create_symlink("level.glb", link);
  const std::string before = file_text(scene);
  const std::string config =
      folder.write("c.json", R"({"scenes": [{"path": "level.glb", "frames": 1}], "assigners": ["aabb"]})").string();
  for (const std::string& arguments :
       {scene + " -o " + scene, scene + " -o " + link, config + " -o " + config, config + " -o " + scene,
        config + " -o " + results + " --export csv=" + scene, config + " -o " + results + " --export csv=" + results}) {
    const Outcome refused = tool("run --no-timing " + arguments);
    EXPECT_EQ(refused.code, 2) << arguments << refused.err;
    EXPECT_NE(refused.err.find("name a"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(file_text(scene), before);
}

TEST(Run, dumps_go_with_no_flag_that_asks_for_a_measurement) {
  const Folder folder;
  const std::string scene = source_file("scenes/street.glb"), result = (folder / "r.json").string(),
                    dumps = " --grid frustum --assigner aabb-fast --write-dump " + (folder / "d").string();
  for (const std::string& flag :
       {"-o " + result, "--export csv=" + result, "--images " + result, std::string("--fail-if 'longest > 1'"),
        "--baseline " + result, "--baseline-binary " + result, std::string("--count=perf"),
        "-o " + result + " --resume"}) {
    const Outcome refused = tool("run " + scene + dumps + " " + flag);
    EXPECT_EQ(refused.code, 2) << flag;
    const std::string name = flag.substr(0, flag.find_first_of(" ="));
    EXPECT_NE(refused.err.find("--write-dump: does not go with " + name + ": it writes lists"), std::string::npos)
        << refused.err;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  const std::string config =
      folder.write("c.json", small_config(R"(, "limits": {"fail_if": ["longest > 1"]})")).string();
  const Outcome told = tool("run " + config + " --filter /aabb --write-dump " + (folder / "d").string());
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_NE(told.err.find("--write-dump measures nothing and does not look at limits.fail_if (1 budget)"),
            std::string::npos)
      << told.err;
}

TEST(Run, folders_that_cannot_be_made_are_refused_and_those_of_a_refused_run_do_not_stay) {
  const Folder folder;
  const std::string file = folder.write("file", "").string();
  std::filesystem::create_symlink("nothing", folder / "dangling");
  const std::string run =
      "run " + source_file("scenes/street.glb") + " --grid frustum --assigner aabb-fast --no-timing";
  for (const char* flag : {" --write-dump ", " --images "})
    for (const std::string& at : {file, file + "/below", (folder / "dangling").string(), std::string("/proc/none/d")}) {
      const Outcome refused = tool(run + flag + at);
      EXPECT_EQ(refused.code, 2) << flag << at << ": " << refused.err;
      EXPECT_NE(refused.err.find(at + ": no folder can be made there: "), std::string::npos) << refused.err;
    }
  const std::string made = (folder / "new" / "below").string();
  EXPECT_EQ(
      tool("run " + source_file("scenes/street.glb") + " --grid cascades --assigner cascades --write-dump " + made)
          .code,
      2);
  EXPECT_EQ(tool(run + " --images " + made + " --resume").code, 2);
  EXPECT_FALSE(exists(folder / "new"));
  std::filesystem::create_directory(folder / "mine");
  EXPECT_EQ(tool(run + " --resume --images " + (folder / "mine" / "new").string()).code, 2);
  EXPECT_TRUE(exists(folder / "mine"));
  EXPECT_FALSE(exists(folder / "mine" / "new"));
}

TEST(Run, a_folder_is_no_input) {
  for (const char* command : {"run", "validate"}) {
    const Outcome refused = tool(std::string(command) + " " + std::filesystem::temp_directory_path().string());
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_NE(refused.err.find("is a folder, not a file"), std::string::npos) << refused.err;
  }
}

}  // namespace
}  // namespace clusterbench::test
