#include <gtest/gtest.h>

#include <sstream>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

TEST(ManPage, the_value_of_an_option_is_called_as_its_text_calls_it) {
  const std::string page = tool("man").out;
  EXPECT_NE(page.find("\\fB\\-\\-images\\fR \\fIDIR\\fR\nDIR: pictures"), std::string::npos);
  EXPECT_EQ(page.find("\\fIFILE\\fR\nDIR:"), std::string::npos);
}

TEST(ManPage, a_list_of_words_begins_after_a_full_stop) {
  std::istringstream page(tool("man").out);
  std::string before;
  int lists = 0;
  for (std::string line; std::getline(page, line); before = line) {
    if (!line.starts_with("One of ")) continue;
    ++lists;
    EXPECT_TRUE(before.ends_with('.') || before.ends_with("\\fR")) << before;
  }
  EXPECT_GT(lists, 3);
}

}  // namespace
}  // namespace clusterbench::test
