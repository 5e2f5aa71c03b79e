// What the schema of a result owes its readers.

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "config/schema/documents.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

struct Leaf {
  std::string place, unit, over;
  Json schema;
};

bool says(const Json& schema, const char* key) {
  return schema.contains(key) && schema[key].is_string() && !schema[key].get<std::string>().empty();
}

// What holds a value, with the unit and the population that it has or that what holds it has.
class Leaves {
 public:
  explicit Leaves(const Json& root) : root_(root) { walk({"", "", "", root}); }

  std::vector<Leaf> found;

 private:
  void walk(Leaf at) {
    if (says(at.schema, "$ref")) {
      Json aimed = root_.at(Json::json_pointer(at.schema["$ref"].get<std::string>().substr(1)));
      aimed.merge_patch(at.schema);
      aimed.erase("$ref");
      at.schema = aimed;
    }
    if (says(at.schema, "x-unit")) at.unit = at.schema["x-unit"];
    if (says(at.schema, "x-over")) at.over = at.schema["x-over"];
    const auto step = [&](const std::string& name, const Json& schema) {
      walk({at.place + "/" + name, at.unit, at.over, schema});
    };
    if (at.schema.contains("properties"))
      for (const auto& [name, schema] : at.schema["properties"].items()) step(name, schema);
    else if (at.schema.contains("additionalProperties") && at.schema["additionalProperties"].is_object())
      step("*", at.schema["additionalProperties"]);
    else if (at.schema.contains("items") && at.schema["items"].contains("properties"))
      step("[]", at.schema["items"]);
    else
      found.push_back(at);
  }

  const Json& root_;
};

bool is_number(const Json& schema) {
  if (schema.contains("items")) return is_number(schema["items"]);
  const std::string type = schema.value("type", Json(schema.contains("const") ? "integer" : "string")).dump();
  return type.find("integer") != std::string::npos || type.find("number") != std::string::npos;
}

TEST(ResultSchema, describes_every_value_and_gives_every_number_its_unit_and_what_it_is_taken_over) {
  const Json schema = result_schema();
  const std::vector<Leaf> leaves = Leaves(schema).found;
  EXPECT_GT(leaves.size(), 200u);
  for (const Leaf& leaf : leaves) {
    EXPECT_TRUE(says(leaf.schema, "description")) << leaf.place << " has no description";
    if (!is_number(leaf.schema)) continue;
    EXPECT_FALSE(leaf.unit.empty()) << leaf.place << " has no unit";
    EXPECT_FALSE(leaf.over.empty()) << leaf.place << " does not say what it is taken over";
  }
}

void count_objects(const Json& schema, std::map<std::string, int>& uses) {
  if (schema.is_object() && schema.contains("properties") && schema["properties"].size() > 2)
    ++uses[schema["properties"].dump()];
  if (schema.is_structured())
    for (const Json& member : schema) count_objects(member, uses);
}

TEST(ResultSchema, says_what_repeats_once) {
  std::map<std::string, int> uses;
  count_objects(result_schema(), uses);
  for (const auto& [object, count] : uses) EXPECT_EQ(count, 1) << object;
}

TEST(ResultSchema, speaks_of_lights_per_cell_only) {
  EXPECT_EQ(result_schema().dump().find("luster_"), std::string::npos);
  EXPECT_EQ(result_schema().dump().find("per_cluster"), std::string::npos);
}

}  // namespace
}  // namespace clusterbench::config
