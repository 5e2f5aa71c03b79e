#include "config/schema/json_text.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace clusterbench::config {
namespace {

std::string parse_message(const std::string& text) {
  try {
    parse_json_text(text, "f");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(JsonText, every_key_and_value_has_its_line_and_column) {
  const JsonText text = parse_json_text("{ // one\n  \"a\": [1, /* ] */ {\"b~/\": \"x,]\"}],\n\t\"c\" : null }", "f");
  EXPECT_EQ(text.value["a"][1]["b~/"], "x,]");
  EXPECT_EQ(text.where(""), "1:1 /");
  EXPECT_EQ(text.where_key("/a"), "2:3 /a");
  EXPECT_EQ(text.where("/a/0"), "2:9 /a/0");
  EXPECT_EQ(text.where("/a/1/b~0~1"), "2:28 /a/1/b~0~1");
  EXPECT_EQ(text.where("/c"), "3:8 /c");
}

TEST(JsonText, a_column_counts_characters_not_bytes) {
  const JsonText text = parse_json_text("{\"\xC3\xA4\": \"\xE2\x82\xAC\", \"b\": 1}", "f");
  EXPECT_EQ(text.where_key("/b"), "1:12 /b");
}

TEST(JsonText, a_place_that_the_text_lacks_is_the_nearest_one_around_it) {
  EXPECT_EQ(parse_json_text("{\"a\": 1}", "f").where("/a/name/x"), "1:7 /a");
}

TEST(JsonText, a_duplicate_key_names_both_places) {
  EXPECT_EQ(parse_message("{\"a\": {\"b\": 1,\n \"b\": 2}}"),
            "f: 2:2 /a/b: duplicate key 'b'; the first one is at 1:8");
  EXPECT_EQ(parse_message("{\"a\": 1, \"\\u0061\": 2}"), "f: 1:10 /a: duplicate key 'a'; the first one is at 1:2");
}

TEST(JsonText, broken_syntax_is_named_with_its_place) {
  EXPECT_EQ(parse_message("[1,\n2,]"),
            "f: 2:3 /: syntax error while parsing value - unexpected ']'; expected '[', '{', "
            "or a literal");
  EXPECT_EQ(parse_message("[1e999]"), "f: 1:2 /: has a number that is larger than double precision can hold: 1e999");
  EXPECT_NE(parse_message(""), "accepted");
  EXPECT_NE(parse_message("/*"), "accepted");
  EXPECT_NE(parse_message("{\"a\": 1} x"), "accepted");
  EXPECT_NE(parse_message("\"\xFF\""), "accepted");
}

TEST(JsonText, nesting_has_a_limit_before_the_stack_has_one) {
  EXPECT_EQ(parse_message(std::string(256, '[') + std::string(256, ']')), "accepted");
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  EXPECT_EQ(parse_message(deep), "f: 1:257 /: is nested deeper than 256 levels");
}

}  // namespace
}  // namespace clusterbench::config
