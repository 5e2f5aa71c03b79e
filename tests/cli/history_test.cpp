#include <gtest/gtest.h>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

const std::string k_small_result = source_file("results/intel-r-xeon-r-processor/quick.json");

TEST(HistoryCommand, what_is_added_is_shown_as_text_and_as_a_page) {
  const Folder folder;
  const std::string file = (folder / "history.jsonl").string(), page = (folder / "history.html").string();
  for (const char* commit : {"c1", "c2"}) {
    const Outcome added = tool("history add " + k_small_result + " " + file + " --commit " + commit);
    ASSERT_EQ(added.code, 0) << added.err;
  }
  const Outcome shown = tool("history show " + file + " -o " + page);
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_EQ(shown.out.substr(0, 11), "2 results, ");
  EXPECT_EQ(file_text(page).substr(0, 15), "<!doctype html>");
}

TEST(HistoryCommand, a_corrupt_line_is_a_usage_error_that_names_it) {
  const Folder folder;
  const Outcome done = tool("history show " + folder.write("history.jsonl", "{}\n").string());
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("history.jsonl: line 1: "), std::string::npos) << done.err;
}

TEST(HistoryCommand, a_commit_that_no_json_can_hold_is_refused) {
  const Folder folder;
  const std::string file = (folder / "h.jsonl").string();
  const Outcome refused = tool("history add " + k_small_result + " " + file + " --commit \xff\xfe");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--commit: takes text in UTF-8"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(HistoryCommand, a_result_without_cases_or_in_the_place_of_a_history_is_refused) {
  const Folder folder;
  auto empty = nlohmann::ordered_json::parse(file_text(k_small_result));
  empty["cases"] = empty["scenes"] = nlohmann::ordered_json::array();
  const std::string without = folder.write("without.json", empty.dump()).string(), file = (folder / "h.jsonl").string();
  ASSERT_EQ(tool("history add " + k_small_result + " " + file + " --commit c1").code, 0);
  const Outcome refused = tool("history add " + without + " " + file + " --commit c2");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("without.json: /cases: is empty"), std::string::npos) << refused.err;
  const Outcome shown = tool("history show " + k_small_result);
  EXPECT_EQ(shown.code, 2);
  EXPECT_NE(shown.err.find("is a result, not a history; `clusterbench history add"), std::string::npos) << shown.err;
}

TEST(HistoryCommand, validate_knows_histories_and_results_with_a_case_twice) {
  const Folder folder;
  const std::string file = (folder / "h.jsonl").string();
  for (const char* commit : {"c1", "c2"})
    ASSERT_EQ(tool("history add " + k_small_result + " " + file + " --commit " + commit).code, 0);
  EXPECT_EQ(tool("validate " + file).out, file + ": valid, a history with 2 results\n");
  auto line = nlohmann::ordered_json::parse(file_text(file).substr(0, file_text(file).find('\n')));
  line["cases"].push_back(line["cases"][0]);
  const Outcome twice = tool("validate " + folder.write("twice.jsonl", line.dump() + "\n").string());
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.err.find("/id: found '"), std::string::npos) << twice.err;
  auto result = nlohmann::ordered_json::parse(file_text(k_small_result));
  result["cases"].push_back(result["cases"][0]);
  const Outcome refused = tool("validate " + folder.write("twice.json", result.dump()).string());
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find(result["cases"][0]["id"].get<std::string>()), std::string::npos) << refused.err;
}

// Which goes on until that is told.
TEST(HistoryCommand, that_another_process_holds_says_that_it_waits) {
  const Folder folder;
  const std::string add = test::program() + " history add " + k_small_result + " h.jsonl --commit c1 2>err";
  const int status =
      std::system(("cd " + folder.path().string() + " && touch h.jsonl err && { flock h.jsonl sh -c 'touch held; " +
                   "for i in $(seq 300); do grep -q held err && break; sleep 0.1; done' & while [ ! -e held ]; do "
                   "sleep 0.05; done; " +
                   add + "; }")
                      .c_str());
  const std::string err = file_text(folder / "err");
  EXPECT_EQ(WEXITSTATUS(status), 0) << err;
  EXPECT_NE(err.find("h.jsonl is held by another process; waiting a minute for its end"), std::string::npos) << err;
}

TEST(HistoryCommand, a_history_in_the_place_of_a_result_is_named_with_what_reads_it) {
  const Folder folder;
  const std::string result = (folder / "r.json").string(), history = (folder / "h.jsonl").string();
  const std::string run = "run " + source_file("scenes/street.glb") +
                          " --grid frustum --assigner aabb-fast --set 'scenes.*.frames=1' --no-timing -q";
  ASSERT_EQ(tool(run + " -o " + result).code, 0);
  for (const char* commit : {"c1", "c2"})
    ASSERT_EQ(tool("history add " + result + " " + history + " --commit " + commit).code, 0);
  for (const std::string& arguments :
       {"report " + history, "size " + history, "merge " + history, "compare " + result + " " + history,
        run + " --fail-if 'longest > +5 %' --baseline " + history, "size " + result + " --found " + history}) {
    const Outcome refused = tool(arguments);
    EXPECT_EQ(refused.code, 2) << arguments;
    EXPECT_NE(refused.err.find("h.jsonl: is a history of results, which `clusterbench history show` reads"),
              std::string::npos)
        << arguments << refused.err;
  }
}

TEST(MergeCommand, a_merged_result_is_valid_and_one_with_itself_is_refused) {
  const Folder folder;
  const std::string scene = source_file("scenes/mirror.glb"), out = (folder / "all.json").string();
  std::string shards;
  for (const char* assigner : {"/aabb/", "/bounds/"}) {
    const std::string file = (folder / ("shard" + std::to_string(shards.size()) + ".json")).string();
    ASSERT_EQ(tool("run " + scene + " --no-timing -q --filter " + assigner + " -o " + file).code, 0);
    shards += " " + file;
  }
  EXPECT_EQ(tool("merge" + shards + " -o " + out).code, 0);
  EXPECT_EQ(tool("validate " + out).code, 0);
  const Outcome twice = tool("merge" + shards + " " + out);
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.err.find("all.json: /cases: has id '"), std::string::npos) << twice.err;
}

}  // namespace
}  // namespace clusterbench::test
