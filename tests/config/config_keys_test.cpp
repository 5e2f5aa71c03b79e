// A configuration's keys stand in the schema, with what is allowed, and as members of structs: both have to have the
// same keys, values and defaults.

#include "config/config_keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "config/config.h"
#include "config/config_scenes.h"
#include "config/schema/documents.h"
#include "config/schema/schema_reader.h"
#include "config/schema/schema_verdict.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;
using KeyNames = std::set<std::string>;

// A struct and the schema of its object.
struct Section {
  const char* schema;
  const result::Type& keys;
  Json (*defaults)();
  Json (*read_and_written)(const Json& object);
};

template <class Record>
Section section(const char* schema) {
  return {schema, result::type_of<Record>(), [] { return Json(result::to_json(Record())); },
          [](const Json& object) { return Json(result::to_json(read_keys<Record>(object))); }};
}

const Section k_sections[] = {
    section<AccuracyRequest>("/properties/accuracy"),
    section<TimingRequest>("/properties/timing"),
    section<LimitsRequest>("/properties/limits"),
    section<measure::AllocationRule>("/properties/allocation"),
    section<ShadingRequest>("/properties/shading"),
    section<StabilityRequest>("/properties/stability/anyOf/1"),
    section<LookupRequest>("/properties/lookup/anyOf/1"),
    section<ReadingRequest>("/properties/reading/anyOf/1"),
    section<DetailsRequest>("/properties/details/anyOf/1"),
    section<ShadowCullRequest>("/properties/shadow_cull"),
    section<SharedFrustaRequest>("/properties/shadow_frusta"),
    section<PrecisionRequest>("/definitions/precision"),
    section<SceneKeys>("/definitions/scene"),
    section<scene::RangeRule>("/definitions/scene/properties/range_rule"),
    section<scene::RigSpec>("/definitions/rig"),
    section<cull::VisibleSetStep>("/definitions/pre_cull_step/properties/visible_set"),
    section<cull::MostStep>("/definitions/pre_cull_step/properties/most"),
};

// With the definitions that it refers to.
Json schema_at(const std::string& pointer) {
  const Json root = config_schema();
  Json schema = root.at(Json::json_pointer(pointer));
  schema["definitions"] = root["definitions"];
  return schema;
}

KeyNames names_in(const Json& object) {
  KeyNames names;
  for (const auto& [name, member] : object.items()) names.insert(name);
  return names;
}

KeyNames names_of(const result::Type& type) {
  KeyNames names;
  for (const result::Field& field : type.fields) EXPECT_TRUE(names.insert(field.name).second) << field.name;
  return names;
}

// The schema's defaults of a section; for required keys, which have none, an example.
Json schema_defaults(const Json& schema) {
  Json least = Json::object();
  for (const Json& name : schema.value("required", Json::array())) {
    const Json& example = schema["properties"][name.get<std::string>()]["examples"][0];
    least[name.get<std::string>()] = example.is_array() ? example[0] : example;
  }
  return read_by_schema(schema, least, JsonText());
}

// Values of a key: the schema's examples, those of an axis one by one, and its words if it has some.
std::vector<Json> values_of(const Json& property, const Json& definitions) {
  const Json& single = property.value("x-axis", false) ? property["anyOf"][0] : property;
  const Json alone{{"definitions", definitions}, {"allOf", {single}}};
  std::vector<Json> values;
  for (const Json& example : property["examples"])
    if (schema_violations(alone, example).empty())
      values.push_back(example);
    else
      values.insert(values.end(), example.begin(), example.end());
  for (const Json& word : single.value("enum", Json::array())) values.push_back(word);
  if (single.contains("items") && single["items"].contains("enum")) values.push_back(single["items"]["enum"]);
  return values;
}

TEST(ConfigKeys, of_every_section_are_those_of_the_schema) {
  for (const Section& one : k_sections)
    EXPECT_EQ(names_of(one.keys), names_in(schema_at(one.schema)["properties"])) << one.schema;
}

TEST(ConfigKeys, of_the_top_level_are_members_or_have_a_reader_of_their_own) {
  KeyNames all = names_of(result::type_of<Sections>());
  for (const char* name : {"$schema",  "name",    "scenes",     "viewport",    "viewports", "grids",     "assigners",
                           "storages", "presets", "as_shipped", "plugins",     "shaders",   "precision", "pre_cull",
                           "jitter",   "shading", "samples",    "shadow_cull", "cost",      "rank_by"})
    EXPECT_TRUE(all.insert(name).second) << name;
  EXPECT_EQ(all, names_in(config_schema()["properties"]));
  for (const result::Field& field : result::type_of<Sections>().fields) {
    const result::Type* type = field.type->kind == result::Kind::nullable ? field.type->element : field.type;
    if (type->kind != result::Kind::object) continue;
    EXPECT_NE(std::ranges::find(k_sections, type, [](const Section& one) { return &one.keys; }), std::end(k_sections))
        << field.name << " is to be among the sections above";
  }
}

TEST(ConfigKeys, of_sets_of_samples_are_members_of_one_struct_for_all_sets) {
  const Json sets = config_schema()["properties"]["samples"]["properties"];
  const Json plain = result::to_json(SampleSetRequest());
  KeyNames sets_by_name, all;
  for (std::size_t i = 1; i < measure::k_sample_set_count; ++i)
    sets_by_name.insert(measure::name_of(static_cast<measure::SampleSet>(i)));
  EXPECT_EQ(names_in(sets), sets_by_name);
  for (const auto& [set, schema] : sets.items()) {
    all.merge(names_in(schema["properties"]));
    const Json defaults = schema_defaults(schema);
    for (const auto& [name, value] : defaults.items()) EXPECT_EQ(plain[name], value) << set << "/" << name;
  }
  EXPECT_EQ(all, names_of(result::type_of<SampleSetRequest>()));
}

TEST(ConfigKeys, have_the_defaults_of_the_schema) {
  for (const Section& one : k_sections) {
    const Json schema = schema_at(one.schema);
    Json expected = schema_defaults(schema), found = one.defaults();
    for (const Json& required : schema.value("required", Json::array()))
      for (Json* object : {&expected, &found}) object->erase(required.get<std::string>());
    EXPECT_EQ(found, expected) << one.schema;
  }
}

TEST(ConfigKeys, are_read_into_their_members_with_every_example_and_word_of_the_schema) {
  int values = 0;
  for (const Section& one : k_sections) {
    const Json schema = schema_at(one.schema), defaults = schema_defaults(schema);
    for (const auto& [name, property] : schema["properties"].items())
      for (const Json& value : values_of(property, schema["definitions"])) {
        Json object = defaults;
        object[name] = value;
        EXPECT_EQ(one.read_and_written(object), object) << one.schema << "/" << name;
        ++values;
      }
  }
  EXPECT_GT(values, 80);
}

}  // namespace
}  // namespace clusterbench::config
