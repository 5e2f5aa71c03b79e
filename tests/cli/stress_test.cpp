#include <gtest/gtest.h>

#include "cli/tool.h"

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

TEST(Stress, a_search_without_a_fault_says_that_nothing_was_written) {
  const Folder folder;
  const std::string place = (folder / "faults").string();
  const Outcome done = tool(k_little + " --failures " + place);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("no fault to write to " + place), std::string::npos) << done.err;
  EXPECT_EQ(done.err.find("0 faults"), std::string::npos) << done.err;
}

}  // namespace
}  // namespace clusterbench::test
