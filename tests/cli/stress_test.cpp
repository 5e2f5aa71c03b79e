#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

// One hard case on one method: a moment.
const std::string k_little = "stress --cases 'H1$' --methods '^exact-fast$' --tries 0";

TEST(Stress, on_a_terminal_the_table_is_shown_and_the_result_only_on_request) {
  const Outcome shown = tool_on_terminal(k_little);
  EXPECT_EQ(shown.code, 0) << shown.out;
  EXPECT_EQ(shown.out.find("schema_version"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("exact-fast"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("clusterbench: the result is not kept; -o FILE keeps it"), std::string::npos) << shown.out;
  EXPECT_NE(tool_on_terminal(k_little + " -o -").out.find("schema_version"), std::string::npos);
  EXPECT_NE(tool(k_little).out.find("schema_version"), std::string::npos) << "into a pipe";
}

TEST(Stress, takes_several_methods_with_commas) {
  const auto methods = [](const std::string& names) {
    const Outcome done = tool("stress -q --cases 'H1$' --tries 0 --methods " + names);
    EXPECT_EQ(done.code, 0) << done.err;
    return nlohmann::json::parse(done.out, nullptr, false);
  };
  const nlohmann::json with_comma = methods("'^exact-fast$,^bounds$'"), with_bar = methods("'^exact-fast$|^bounds$'");
  ASSERT_TRUE(with_comma.is_object());
  EXPECT_EQ(with_comma["results"], with_bar["results"]);
  EXPECT_EQ(with_comma["results"].size(), 2u);
}

TEST(Stress, a_search_without_a_fault_says_that_nothing_was_written) {
  const Folder folder;
  const std::string place = (folder / "faults").string();
  const Outcome done = tool(k_little + " --failures " + place);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("no fault to write to " + place), std::string::npos) << done.err;
  EXPECT_EQ(done.err.find("0 faults"), std::string::npos) << done.err;
}

TEST(Stress, a_termination_signal_ends_it_with_what_is_done_and_75) {
  const Folder folder;
  const std::string at_work = (folder / "faults/at_work.txt").string(), out = (folder / "out.json").string();
  const std::string search = test::program() + " stress -q --random 100000 --methods '^bounds$' --failures " +
                             (folder / "faults").string() + " -o " + out + " 2>" + (folder / "err").string();
  const std::string wait =
      "until grep -qsE ' from seed (6[5-9]|[7-9][0-9]|[0-9]{3,}) ' " + at_work + "; do sleep 0.01; done";
  const int status = std::system((search + " & pid=$!; " + wait + "; kill -TERM $pid; wait $pid").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 75) << file_text(folder / "err");
  const auto result = nlohmann::json::parse(file_text(out));
  EXPECT_EQ(result["interrupted"], true);
  EXPECT_GE(result["random"]["settings"], 64);  // all before the first that was at work
  EXPECT_EQ(tool("validate " + out).code, 0);
}

}  // namespace
}  // namespace clusterbench::test
