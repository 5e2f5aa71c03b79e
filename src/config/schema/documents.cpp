// The schemas: that of configurations is the embedded text, completed by the rows of assigners and storages, with axes
// written out; the others are made from records.

#include "config/schema/documents.h"

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>

#include "assign/contract/assigner.h"
#include "assign/contract/storage.h"
#include "config/schema/schema_text.h"
#include "core/error.h"
#include "result/documents/check.h"
#include "result/documents/comparison.h"
#include "result/documents/dump.h"
#include "result/documents/light_map.h"
#include "result/documents/plugin_check.h"
#include "result/documents/ratios.h"
#include "result/documents/recommendation.h"
#include "result/documents/shader.h"
#include "result/documents/size.h"
#include "result/documents/stress.h"
#include "result/documents/worst_case.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

Json to_json(const assign::ParamValue& value) {
  return std::visit([](const auto& number) { return Json(number); }, value);
}

Json param_schema(const assign::ParamSpec& param) {
  Json schema{{"default", to_json(param.default_value)}, {"x-axis", true}};
  schema["description"] = param.summary + (param.unit.empty() ? "" : " [" + param.unit + "]");
  if (!param.unit.empty()) schema["x-unit"] = param.unit;
  if (std::holds_alternative<bool>(param.default_value)) {
    schema["type"] = "boolean";
  } else if (std::holds_alternative<double>(param.default_value)) {
    schema.update({{"type", "number"}, {"minimum", param.min}, {"maximum", param.max}});
  } else {
    schema.update({{"type", "string"}, {"enum", param.choices}});
    for (const auto& [former, current] : param.former) {
      schema["enum"].push_back(former);
      schema["x-former"][former] = current;
    }
  }
  return schema;
}

Json method_schema(const std::string& name, const std::string& summary, const std::vector<assign::ParamSpec>& params) {
  Json properties{{"name", {{"const", name}, {"description", summary}}}};
  for (const assign::ParamSpec& param : params) properties[param.name] = param_schema(param);
  return {{"type", "object"},
          {"additionalProperties", false},
          {"required", Json::array({"name"})},
          {"description", summary},
          {"properties", properties}};
}

Json method_items(const std::vector<std::string>& names, const Json& objects) {
  return {{"anyOf", {{{"type", "string"}, {"enum", names}}, {{"oneOf", objects}}}}};
}

Json name_pattern() {
  return {{"type", "string"},
          {"pattern", "[*?[]"},
          {"description", "Every method that the pattern matches (* any letters, ? one) and the list does not name."},
          {"examples", {"*-fast"}}};
}

void insert_methods(Json& properties) {
  Json assigners = Json::array(), storages = Json::array();
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors())
    assigners.push_back(method_schema(row->name, row->summary, row->params));
  for (const assign::StorageDescriptor* row : assign::storage_descriptors())
    storages.push_back(method_schema(row->name, row->summary, row->params));
  properties["assigners"]["items"] = method_items(assign::assigner_names(), assigners);
  Json& choices = properties["assigners"]["items"]["anyOf"];
  choices.insert(choices.begin(), name_pattern());
  properties["assigners"]["default"] = assign::default_assigner_names();
  properties["storages"]["items"] = method_items(assign::storage_names(), storages);
}

// Expands {"x-axis": true, ...single} to a single value or a list of them.
void expand_axis(Json& schema) {
  Json single = schema;
  Json outer{{"x-axis", true}};
  for (const char* key : {"description", "default", "examples", "x-unit", "x-used-by", "x-axis"}) {
    if (single.contains(key)) outer[key] = single[key];
    single.erase(key);
  }
  outer["anyOf"] = {single, {{"type", "array"}, {"minItems", 1}, {"items", single}}};
  schema = outer;
}

// Expresses x-used-by as `dependencies`, for validators that know only draft-07.
void require_users(Json& object) {
  const std::string selector = object["x-selector"].get<std::string>();
  const Json default_value = object["properties"][selector]["default"];
  for (const auto& [key, property] : object["properties"].items()) {
    if (!property.contains("x-used-by")) continue;
    const Json a_user{{"enum", property["x-used-by"]}};
    Json needed{{"properties", {{selector, {{"anyOf", {a_user, {{"type", "array"}, {"contains", a_user}}}}}}}}};
    const Json& users = property["x-used-by"];
    if (std::find(users.begin(), users.end(), default_value) == users.end())
      needed["required"] = Json::array({selector});
    object["dependencies"][key] = needed;
  }
}

void expand(Json& schema) {
  if (schema.is_object() && schema.contains("x-selector")) require_users(schema);
  if (schema.is_structured())
    for (Json& member : schema) expand(member);
  if (schema.is_object() && schema.contains("x-axis") && !schema.contains("anyOf")) expand_axis(schema);
}

template <result::Json (*schema)()>
Json json_of() {
  return Json(schema());
}

}  // namespace

std::shared_ptr<const Json> shared_config_schema() {
  static std::mutex mutex;
  static std::shared_ptr<const Json> known;
  static std::uint64_t version = 0;
  const std::lock_guard lock(mutex);
  if (known == nullptr || version != assign::registry_version()) {
    version = assign::registry_version();
    Json schema = Json::parse(config_schema_text());
    insert_methods(schema["properties"]);
    expand(schema);
    known = std::make_shared<const Json>(std::move(schema));
  }
  return known;
}

Json config_schema() {
  return *shared_config_schema();
}

Json result_schema() {
  return json_of<result::result_schema>();
}

std::span<const DocumentRow> document_rows() {
  static const std::array<DocumentRow, 13> rows{{
      {Document::config, "config", "a configuration", config_schema},
      {Document::result, "result", "a result of `clusterbench run`", result_schema},
      {Document::comparison, "comparison", "a comparison of `clusterbench compare`",
       json_of<result::comparison_schema>},
      {Document::ratios, "ratios", "ratios of `clusterbench ratio`", json_of<result::ratios_schema>},
      {Document::recommendation, "recommendation", "a recommendation of `clusterbench recommend`",
       json_of<result::recommendation_schema>},
      {Document::stress, "stress", "a result of `clusterbench stress`", json_of<result::stress_schema>},
      {Document::worst_case, "worst-case", "a result of `clusterbench worst-case`", json_of<result::worst_case_schema>},
      {Document::size, "size", "allocations of `clusterbench size`", json_of<result::size_schema>},
      {Document::light_map, "light-map", "light maps of `clusterbench light-map`", json_of<result::light_map_schema>},
      {Document::dump, "dump", "a dump for `clusterbench check`", json_of<result::dump_schema>},
      {Document::check, "check", "a verdict of `clusterbench check`", json_of<result::check_schema>},
      {Document::plugin_check, "plugin-check", "a verdict of `clusterbench plugin check`",
       json_of<result::plugin_check_schema>},
      {Document::shader, "shader", "a method of --shader", json_of<result::shader_schema>},
  }};
  return rows;
}

void check_version(const std::string& path, const Json& document, const DocumentRow& row) {
  const Json schema = row.schema();
  for (const char* key :
       {"schema_version", "comparison_version", "ratios_version", "recommendation_version", "size_version",
        "light_map_version", "dump_version", "check_version", "plugin_check_version", "shader_version"}) {
    if (!document.contains(key) || !schema["properties"].contains(key)) continue;
    const Json &found = document[key], &wanted = schema["properties"][key]["const"];
    if (found == wanted) continue;
    const Json tool = document.value("tool", Json::object());
    std::string maker = "the clusterbench that wrote it";
    if (tool.is_object() && tool.contains("version") && tool["version"].is_string())
      maker += ", " + tool["version"].get<std::string>();
    throw Error(
        path, std::string("/") + key,
        "is " + found.dump() + "; this version reads " + wanted.dump() + ": measure again, or read it with " + maker);
  }
}

const DocumentRow& row_of(Document document) {
  const std::span<const DocumentRow> rows = document_rows();
  return *std::ranges::find(rows, document, &DocumentRow::document);
}

}  // namespace clusterbench::config
