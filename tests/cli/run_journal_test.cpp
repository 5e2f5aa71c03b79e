// Runs that are interrupted, and --resume.

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/small_config.h"
#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

Json without_timing(Json result) {
  for (const char* key : {"machine", "pareto_front", "conclusions", "date", "command"}) result.erase(key);
  for (Json& entry : result["cases"])
    for (const char* key : {"timing", "count"}) entry.erase(key);
  return result;
}

// Starts a run, waits for its journal, then ends it as a shutting-down machine would.
int interrupt(const std::string& config, const std::string& out, const std::string& messages = "/dev/null",
              const std::string& signal = "TERM") {
  const std::string run = test::program() + " run -q " + config + " -o " + out;
  const std::string wait_for_journal = "while [ ! -s " + out + ".partial ]; do sleep 0.01; done";
  const int status = std::system(
      (run + " 2>" + messages + " & pid=$!; " + wait_for_journal + "; kill -" + signal + " $pid; wait $pid").c_str());
  return WEXITSTATUS(status);
}

std::string slow_config() {
  std::string text = small_config();
  const std::string quick = R"("rounds": 3)";
  return text.replace(text.find(quick), quick.size(), R"("rounds": 500)");
}

TEST(Run, a_termination_signal_keeps_what_is_finished_and_exits_75) {
  const Folder folder;
  const std::string config = folder.write("slow.json", slow_config()).string();
  const std::string out = (folder / "r.json").string();
  const std::string messages = (folder / "messages").string();
  EXPECT_EQ(interrupt(config, out, messages), 75);
  EXPECT_FALSE(std::filesystem::exists(out));
  const std::string told = file_text(messages);
  const bool has_finished_some = told.find("what was measured is in") != std::string::npos;
  EXPECT_EQ(std::filesystem::exists(out + ".partial"), has_finished_some) << told;
  EXPECT_NE(told.find("interrupted"), std::string::npos);
  EXPECT_NE(told.find("--resume goes on"), std::string::npos) << told;
}

TEST(Run, an_interrupted_run_resumes_to_the_same_counts) {
  const Folder folder;
  const std::string config = folder.write("slow.json", slow_config()).string();
  const std::string whole = (folder / "whole.json").string(), cut = (folder / "cut.json").string();
  ASSERT_EQ(tool("run -q " + config + " -o " + whole).code, 0);
  ASSERT_EQ(interrupt(config, cut, "/dev/null", "KILL"), 128 + 9);
  const Json complete = Json::parse(file_text(whole));
  std::ofstream(cut + ".partial", std::ios::app) << journal_line(complete["cases"][0]) << "\n";

  const Outcome refused = tool("run -q --resume --filter aabb " + config + " -o " + cut);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("is an interrupted run of another"), std::string::npos) << refused.err;
  EXPECT_EQ(tool("run -q --resume --tiles 32 " + config + " -o " + cut).code, 2);

  const std::size_t all = complete["cases"].size();
  const Outcome left = tool("run --resume --dry-run " + config + " -o " + cut);
  EXPECT_EQ(left.code, 0) << left.err;
  EXPECT_NE(left.err.find(" left of " + std::to_string(all) + ", "), std::string::npos) << left.err;
  EXPECT_EQ(left.out.find(complete["cases"][0]["id"].get<std::string>()), std::string::npos) << left.out;
  EXPECT_FALSE(std::filesystem::exists(cut)) << "nothing is measured";

  const Outcome resumed = tool("run -q --resume --threads 2 " + config + " -o " + cut);
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(resumed.err.find("clusterbench: "), std::string::npos) << resumed.err;  // warnings of times may be
  Json same = without_timing(Json::parse(file_text(cut)));
  EXPECT_EQ(same["config"]["threads"], 2);
  same["config"]["threads"] = nullptr;
  EXPECT_EQ(same.dump(), without_timing(complete).dump());
}

TEST(Run, resuming_without_an_interrupted_run_says_that_it_begins_anew) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string(), out = (folder / "r.json").string();
  const Outcome done = tool("run -q --no-timing --resume " + config + " -o " + out);
  EXPECT_EQ(done.code, 0);
  EXPECT_EQ(done.err, "clusterbench: note: no interrupted run has left finished cases in " + out +
                          ".partial, so --resume begins anew\n");
}

TEST(Run, a_run_that_died_does_not_block_the_next_one) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const std::string out = (folder / "r.json").string();
  ASSERT_EQ(tool("run -q --no-timing " + config + " -o " + out).code, 0);
  const Json kept{{"case", Json::parse(file_text(out))["cases"][0]}};
  folder.write("r.json.partial", "{\"header\": {}}\n" + kept.dump() + "\n");
  const Outcome again = tool("run -q --no-timing " + config + " -o " + out);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.err, "clusterbench: " + out + ".partial, left by a run that did not end, is now " + out +
                           ".partial.1 (--resume goes on with such a file)\n");
  EXPECT_NE(file_text(out + ".partial.1").find(kept.dump()), std::string::npos);
}

}  // namespace
}  // namespace clusterbench::test
