#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

std::string result_text() {
  static const std::string text = [] {
    const Folder folder;
    const Outcome done = tool("run " + source_file("scenes/street.glb") + " -q --no-timing --filter /bounds/ -o " +
                              (folder / "r.json").string());
    EXPECT_EQ(done.code, 0) << done.err;
    return file_text(folder / "r.json");
  }();
  return text;
}

// What `report` says of a file with this text.
Outcome report_of(const std::string& text) {
  const Folder folder;
  return tool("report " + folder.write("r.json", text).string());
}

TEST(Report, what_is_no_result_is_refused_with_the_reason) {
  const auto expect_refused = [](const std::string& text, const std::string& reason) {
    const Outcome done = report_of(text);
    EXPECT_EQ(done.code, 2) << reason;
    EXPECT_NE(done.err.find(reason), std::string::npos) << done.err;
    EXPECT_EQ(done.out, "");
  };
  expect_refused("", "is empty");
  expect_refused("# A page", "is not JSON");
  expect_refused(R"({"scenes": []})", "is not a result file of `clusterbench run`");
  expect_refused(result_text().substr(0, result_text().size() / 2), "is not JSON");
  expect_refused(R"({"header": {"name": "quick"}})"
                 "\n{}\n",
                 "an unfinished run");
}

TEST(Report, another_schema_version_is_refused) {
  Json result = Json::parse(result_text());
  result["schema_version"] = 3;
  const Outcome done = report_of(result.dump());
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("/schema_version: is 3; this version reads 2"), std::string::npos) << done.err;
}

// Names and meanings of version 1 are others; a reader that took it would miss figures and not say so.
TEST(Report, a_result_of_version_1_is_refused_by_all_that_read_results) {
  Json result = Json::parse(result_text());
  result["schema_version"] = 1;
  result["front"] = result["pareto_front"];
  result.erase("pareto_front");
  for (Json& entry : result["cases"]) entry.erase("eligible");
  const Folder folder;
  const std::string old = folder.write("old.json", result.dump()).string(),
                    fresh = folder.write("new.json", result_text()).string();
  for (const std::string& command :
       {"report " + old, "compare " + old + " " + fresh, "compare --force " + fresh + " " + old, "size " + old,
        "export --format csv " + old, "history add " + old + " " + (folder / "h.jsonl").string(), "validate " + old,
        "merge " + old}) {
    const Outcome done = tool(command);
    EXPECT_EQ(done.code, 2) << command;
    EXPECT_NE(done.err.find("old.json: /schema_version: is 1; this version reads 2: measure again"), std::string::npos)
        << command << ": " << done.err;
    EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << command << ": " << done.err;
  }
}

TEST(Report, a_result_broken_by_hand_is_refused_with_the_place) {
  Json result = Json::parse(result_text());
  result["cases"][0]["frames"] = "twenty";
  const Outcome done = report_of(result.dump());
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("/cases/0/frames"), std::string::npos) << done.err;
}

TEST(Report, the_page_names_the_command_that_made_it) {
  const Folder folder;
  const std::string file = folder.write("my result.json", result_text()).string(), page = (folder / "p.html").string();
  const Outcome done = tool("report '" + file + "' -o " + page);
  if (done.err.find("configure and build again") != std::string::npos) GTEST_SKIP() << done.err;
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(file_text(page).find("\"command\":\"clusterbench report '" + file + "' -o " + page + "\""),
            std::string::npos);
}

}  // namespace
}  // namespace clusterbench::test
