// Documents that are deeper than any that this tool writes end every command that reads one in one line. Results that
// are committed, of whatever version, are valid.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

std::string nested(const std::string& before, const std::string& after) {
  return before + std::string(200'000, '[') + std::string(200'000, ']') + after;
}

void expect_one_line(const Outcome& done, const std::string& says, const std::string& command) {
  EXPECT_EQ(done.code, 2) << command << ": " << done.err;
  EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << command << ": " << done.err;
  EXPECT_NE(done.err.find(says), std::string::npos) << command << ": " << done.err;
}

TEST(DeepDocuments, of_results_end_every_command_in_a_line) {
  const Folder folder;
  const std::string result = folder.write("deep.json", nested(R"({"schema_version": 2, "cases": [)", "]}")).string();
  const std::string out = (folder / "out").string();
  for (const std::string& command :
       {"report " + result, "report " + result + " --output " + out, "compare " + result + " " + result,
        "size " + result, "merge " + result + " " + result + " -o " + out, "history add " + result + " " + out,
        "export --format csv " + result})
    expect_one_line(tool(command), "is nested deeper than 256 levels", command);
  const std::string history = folder.write("deep.jsonl", nested("{\"cases\": ", "}\n")).string();
  expect_one_line(tool("history show " + history), "is nested deeper than 256 levels", "history show");
}

TEST(DeepDocuments, of_configurations_and_scenes_end_in_a_line) {
  const Folder folder;
  const std::string deep = folder.write("deep.json", nested("{\"scenes\": ", "}")).string();
  expect_one_line(tool("run " + deep), "is nested deeper than 256 levels", "run");
  expect_one_line(tool("validate " + deep), "is nested deeper than 256 levels", "validate");
  const std::string scene =
      folder.write("deep.gltf", nested(R"({"asset": {"version": "2.0"}, "extras": )", "}")).string();
  expect_one_line(tool("scene info " + scene), "is nested deeper than 256 levels", "scene info");
}

TEST(DeepDocuments, of_interrupted_runs_are_not_resumed) {
  const Folder folder;
  const std::string run =
      "run " + source_file("configs/quick.json") + " --no-timing -q -o " + (folder / "s.json").string() + " --resume";
  for (const std::string& text : {nested("{\"header\": ", "}\n"), nested("{\"header\": {}}\n{\"case\": ", "}\n")}) {
    folder.write("s.json.partial", text);
    const Outcome done = tool(run);
    EXPECT_EQ(done.code, 2) << done.err;
    EXPECT_NE(done.err.find("s.json.partial: line 1"), std::string::npos) << done.err;
  }
}

TEST(CommittedResults, are_valid) {
  std::string files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_file("results")))
    if (entry.path().extension() == ".json") files += " " + entry.path().string();
  ASSERT_FALSE(files.empty());
  const Outcome done = tool("validate" + files);
  EXPECT_EQ(done.code, 0) << done.err;
}

}  // namespace
}  // namespace clusterbench::test
