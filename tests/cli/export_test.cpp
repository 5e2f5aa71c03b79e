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

TEST(RunExport, a_run_that_is_refused_leaves_no_file_behind) {
  const Folder folder;
  const std::string csv = (folder / "a.csv").string(), google = (folder / "g.json").string();
  const std::string run = "run " + source_file("scenes/mirror.glb") + " --no-timing -q --filter aabb/packed -o " +
                          (folder / "result.json").string();
  for (const std::string& others :
       {" --export google-benchmark=" + google, " --export github-bigger=" + google,
        " --export bencher=" + (folder / "no/such.json").string(), " --export xml=" + google}) {
    const Outcome refused = tool(run + " --export csv=" + csv + others);
    EXPECT_EQ(refused.code, 2) << others << refused.err;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << others;
  }
  const Outcome times = tool(run + " --export google-benchmark=" + google);
  EXPECT_NE(
      times.err.find("--export: google-benchmark takes times, which --no-timing (timing.measure: false) leaves out"),
      std::string::npos)
      << times.err;
}

TEST(RunExport, a_file_that_is_there_stays_until_there_is_a_better_one) {
  const Folder folder;
  const std::string csv = folder.write("a.csv", "before").string();
  EXPECT_EQ(tool("run " + source_file("scenes/mirror.glb") + " --no-timing -q --export csv=" + csv +
                 " --export google-benchmark=" + (folder / "g.json").string())
                .code,
            2);
  EXPECT_EQ(file_text(csv), "before");
}

TEST(ExportCommand, a_filter_exports_some_cases) {
  const Outcome done = tool("export " + k_result + " --format csv --filter street/.*/exact-fast");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("exact-fast"), std::string::npos);
  EXPECT_EQ(done.out.find("sphere-refinement"), std::string::npos) << done.out;
  EXPECT_EQ(tool("export " + k_result + " --format csv --filter no-such-case").code, 2);
}

}  // namespace
}  // namespace clusterbench::test
