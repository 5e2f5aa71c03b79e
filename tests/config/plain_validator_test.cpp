#include "config/schema/plain_validator.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "core/random.h"
#include "effort.h"
#include "needs.h"
#include "places.h"

namespace clusterbench::config {
namespace {

using nlohmann::json;
using Lines = std::vector<std::string>;

json json_file(const std::filesystem::path& path) {
  std::ifstream in(path);
  return json::parse(in, nullptr, true, true);
}

TEST(PlainValidator, names_the_place_of_each_violation) {
  const json schema = json::parse(R"({"type": "object", "required": ["a"], "additionalProperties": false,
    "properties": {"a": {"type": "array", "items": {"$ref": "#/definitions/share"}, "maxItems": 2, "uniqueItems": true},
                   "b": {"enum": ["x", "y"]}, "c": {"anyOf": [{"type": "null"}, {"type": "string", "minLength": 2}]}},
    "definitions": {"share": {"type": "number", "minimum": 0, "exclusiveMaximum": 1}}})");
  const auto found = [&](const char* text) { return plain_violations(schema, json::parse(text)); };
  EXPECT_EQ(found(R"({"a": [0, 0.5], "b": "x", "c": null})"), Lines{});
  EXPECT_EQ(found("{}"), Lines{"/: Missing required property 'a'."});
  EXPECT_EQ(found(R"({"a": [0, 1]})"), Lines{"/a/1: Expected number less than 1"});
  EXPECT_EQ(found(R"({"a": [-1]})"), Lines{"/a/0: Expected number greater than or equal to 0"});
  EXPECT_EQ(found(R"({"a": ["0"]})"), Lines{"/a/0: Value type not permitted by 'type' constraint."});
  EXPECT_EQ(found(R"({"a": [0, 0.1, 0.2]})"), Lines{"/a: It has 3 items, and should have at most 2."});
  EXPECT_EQ(found(R"({"a": [0, 0.0]})"), Lines{"/a: Two items are the same, and each must differ from the others."});
  EXPECT_EQ(found(R"({"a": [], "b": "z"})"), Lines{"/b: Failed to match against any enum values."});
  EXPECT_EQ(found(R"({"a": [], "c": "z"})").size(), 1u);
  EXPECT_EQ(found(R"({"a": [], "d": 1})").front().substr(0, 40), "/: Object contains a property that could");
}

// A keyword that it ignored would accept too much.
TEST(PlainValidator, refuses_a_schema_that_it_cannot_check) {
  EXPECT_THROW(plain_violations(json::parse(R"({"if": {"type": "null"}})"), json()), Error);
  EXPECT_THROW(plain_violations(json::parse(R"({"$ref": "other.json"})"), json()), Error);
  EXPECT_THROW(plain_violations(json::parse(R"({"$ref": "#"})"), json()), Error) << "without end";
}

// Of a schema and of those within it.
void collect_keywords(const json& schema, std::map<std::string, json>& keywords) {
  if (!schema.is_object()) return;
  for (const auto& [keyword, rule] : schema.items()) {
    keywords.emplace(keyword, rule);
    if (keyword == "properties" || keyword == "definitions")
      for (const json& part : rule) collect_keywords(part, keywords);
    if (keyword == "anyOf" || keyword == "oneOf" || keyword == "allOf")
      for (const json& part : rule) collect_keywords(part, keywords);
    if (keyword == "items" || keyword == "additionalProperties" || keyword == "not" || keyword == "contains")
      collect_keywords(rule, keywords);
  }
}

TEST(PlainValidator, knows_every_keyword_of_the_tools_schemas) {
  std::map<std::string, json> keywords;
  for (const DocumentRow& row : document_rows()) collect_keywords(row.schema(), keywords);
  EXPECT_GT(keywords.size(), 20u);
  for (const auto& [keyword, rule] : keywords)
    if (keyword != "$ref" && keyword != "anyOf" && keyword != "oneOf") {  // whose parts refer to the whole
      EXPECT_NO_THROW(plain_violations({{keyword, rule}}, json())) << keyword;
    }
}

// A document with something else at a random place.
json mutated(const json& document, SplitMix64& random) {
  const json flat = document.flatten();
  auto leaf = flat.begin();
  std::advance(leaf, static_cast<std::ptrdiff_t>(random.below(flat.size())));
  json::json_pointer at(leaf.key());
  while (!at.empty() && random.below(3) == 0) at = at.parent_pointer();
  json out = document;
  const json values[] = {
      json(), true, -1, 0, 1, 2.5, 1e300, "", "x", json::array(), json::object(), json::array({1, 1})};
  json& place = out[at];
  if (place.is_object() && random.below(2) == 0)
    place["unknown"] = 1;
  else if (place.is_object() && !place.empty())
    place.erase(place.begin());
  else
    place = values[random.below(std::size(values))];
  return out;
}

void compare_with_library(const json& schema, const json& document, SplitMix64& random, int tries) {
  int refused = 0;
  for (int i = 0; i < tries; ++i) {
    const json instance = i == 0 ? document : mutated(document, random);
    const Lines theirs = schema_violations(schema, instance), ours = plain_violations(schema, instance);
    ASSERT_EQ(theirs.empty(), ours.empty()) << (theirs.empty() ? ours : theirs).front() << " " << instance.dump(2);
    refused += ours.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, tries / 4);
  EXPECT_LT(refused, tries);
}

TEST(PlainValidator, decides_as_valijson_does) {
  NEEDS(valijson);
  SplitMix64 random(3);
  const std::filesystem::path source = test::source_dir();
  for (const char* name : {"details", "fit", "pre-cull", "quick"})
    compare_with_library(config_schema(), json_file(source / "configs" / (std::string(name) + ".json")), random,
                         test::tries(50));
  compare_with_library(result_schema(), json_file(source / "results/amd-epyc/peers-w5.json"), random,
                       test::k_sanitized ? 5 : 15);
}

}  // namespace
}  // namespace clusterbench::config
