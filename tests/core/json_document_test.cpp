// The one reader of JSON: its limits hold before anything is parsed.

#include "core/json_document.h"

#include <gtest/gtest.h>

#include "core/memory.h"

namespace clusterbench {
namespace {

using Sorted = nlohmann::json;
using Ordered = nlohmann::ordered_json;

template <class Json>
std::string refusal(const std::string& text, JsonComments comments = JsonComments::refused) {
  try {
    static_cast<void>(read_json<Json>(text, "f", comments));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::string nested(int depth) {
  return std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
}

TEST(JsonDocument, nesting_has_one_limit) {
  EXPECT_EQ(refusal<Sorted>(nested(256)), "accepted");
  EXPECT_EQ(refusal<Ordered>(nested(257)), "f: byte 256: is nested deeper than 256 levels");
  EXPECT_EQ(refusal<Ordered>(R"({"schema_version": 2, "cases": )" + nested(200'000) + "}"),
            "f: byte 286: is nested deeper than 256 levels");
  EXPECT_EQ(refusal<Sorted>(std::string(200'000, '[')), "f: byte 256: is nested deeper than 256 levels");
}

TEST(JsonDocument, brackets_in_strings_and_comments_are_no_nesting) {
  const std::string brackets(1000, '[');
  EXPECT_EQ(refusal<Sorted>("[\"" + brackets + "\\\"" + brackets + "\"]"), "accepted");
  EXPECT_EQ(refusal<Sorted>("[1 /* " + brackets + " */] // " + brackets, JsonComments::allowed), "accepted");
  EXPECT_NE(refusal<Sorted>("[1 /* " + brackets + " */]"), "accepted");
}

TEST(JsonDocument, values_are_counted_before_memory_is_taken) {
  const MemoryLimitScope limit(std::uint64_t{1} << 20);
  std::string list = "[0";
  for (int i = 0; i < 100'000; ++i) list += ",0";
  EXPECT_NE(refusal<Sorted>(list + "]").find("values of a JSON document"), std::string::npos);
  EXPECT_EQ(refusal<Sorted>("[0,0]"), "accepted");
}

TEST(JsonDocument, an_object_whose_members_are_looked_for_one_by_one_has_a_limit) {
  std::string object = R"({"a": 0)";
  for (int i = 0; i < 20'000; ++i) object += ",\"" + std::to_string(i) + "\":0";
  EXPECT_NE(refusal<Ordered>(object + "}").find("has an object of more than 20000 members"), std::string::npos);
  EXPECT_EQ(refusal<Sorted>(object + "}"), "accepted");
}

TEST(JsonDocument, what_is_no_json_is_said_with_its_byte) {
  EXPECT_EQ(refusal<Ordered>("[1, 2").find("f: byte 5: is not JSON: syntax error"), 0U) << refusal<Ordered>("[1, 2");
  EXPECT_EQ(refusal<Sorted>("[1e999]"), "f: byte 1: has a number that is larger than double precision can hold: 1e999");
  EXPECT_TRUE(json_or_discarded<Ordered>("{").is_discarded());
  EXPECT_TRUE(json_or_discarded<Ordered>(nested(300)).is_discarded());
}

TEST(JsonDocument, a_key_stands_once_in_an_object) {
  EXPECT_EQ(refusal<Ordered>(R"({"a": 1, "b": {"a": 2}, "a": 3})"),
            R"(f: byte 24: is the key "a" for the second time in its object)");
  EXPECT_EQ(refusal<Sorted>(R"([{"a": 1}, {"b": ":", "c": {"d": [{"e": 1, "e": 1}]}}])"),
            R"(f: byte 43: is the key "e" for the second time in its object)");
  EXPECT_EQ(refusal<Sorted>(R"({"a": 1, "\u0061": 2})"),
            "f: byte 0: has an object with a key twice, in different spellings");
  EXPECT_EQ(refusal<Sorted>(R"({/* "a": 1 */ "a": 2, // "a": 3
                                "b": "\"a\": 4"})",
                            JsonComments::allowed),
            "accepted");
  EXPECT_EQ(refusal<Ordered>(R"([{"a": 1}, {"a": 1}, {"b": {"a": 1}, "a": "a"}])"), "accepted");
}

TEST(JsonDocument, no_text_stands_behind_a_nul_byte) {
  using namespace std::string_literals;
  EXPECT_EQ(refusal<Sorted>("[1]\0[2]"s), "f: byte 3: is a NUL byte with more text behind it");
  for (const std::string& wide : {"{\0}\0"s, "\0{\0}"s, "[\0]\0"s})
    EXPECT_NE(refusal<Sorted>(wide).find("is a NUL byte, as in UTF-16; JSON is UTF-8: save it as that"),
              std::string::npos);
  EXPECT_EQ(refusal<Sorted>("[1] \0\0 \0x"s), "f: byte 4: is a NUL byte with more text behind it");
  EXPECT_EQ(refusal<Sorted>("[1]\0\0\0"s), "accepted");
}

}  // namespace
}  // namespace clusterbench
