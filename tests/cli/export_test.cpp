#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

const std::string k_result = source_file("results/intel-r-xeon-r-processor/quick.json");

TEST(ExportCommand, every_format_of_its_help_can_be_written) {
  const Folder folder;
  for (const char* format :
       {"google-benchmark", "github-smaller", "github-bigger", "bencher", "lnt", "csv", "markdown"}) {
    EXPECT_NE(tool("export --help").out.find(format), std::string::npos) << format;
    const std::string file = (folder / format).string();
    const Outcome done = tool("export " + k_result + " --format " + format + " -o " + file);
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_GT(file_text(file).size(), 1000u) << format;
    EXPECT_EQ(tool("export " + k_result + " --format " + format).out, file_text(file));
  }
}

TEST(ExportCommand, an_unknown_format_or_no_result_is_a_usage_error) {
  const Outcome unknown = tool("export " + k_result + " --format xml");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("no format 'xml'; there are: google-benchmark,"), std::string::npos) << unknown.err;
  EXPECT_EQ(tool("export " + source_file("configs/quick.json") + " --format csv").code, 2);
}

TEST(RunExport, exports_are_what_the_command_makes_of_the_result) {
  const Folder folder;
  const std::string out = (folder / "result.json").string(), csv = (folder / "a.csv").string(),
                    bmf = (folder / "b.json").string();
  const Outcome done = tool("run " + source_file("scenes/mirror.glb") + " --no-timing -q --filter aabb/packed -o " +
                            out + " --export csv=" + csv + " --export bencher=" + bmf);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(file_text(csv), tool("export " + out + " --format csv").out);
  EXPECT_EQ(Json::parse(file_text(bmf)).size(), Json::parse(file_text(out))["cases"].size());
}

TEST(RunExport, what_cannot_be_exported_is_known_before_anything_is_measured) {
  const Folder folder;
  const std::string run = "run " + source_file("configs/quick.json") + " -o " + (folder / "result.json").string();
  const Outcome unwritable = tool(run + " --export csv=" + (folder / "no/such.csv").string());
  EXPECT_EQ(unwritable.code, 2);
  EXPECT_NE(unwritable.err.find("no/such.csv: cannot be written"), std::string::npos) << unwritable.err;
  const Outcome unnamed = tool(run + " --export result.csv");
  EXPECT_EQ(unnamed.code, 2);
  EXPECT_NE(unnamed.err.find("takes FORMAT=FILE, not 'result.csv'"), std::string::npos) << unnamed.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "result.json.partial"));
}

}  // namespace
}  // namespace clusterbench::test
