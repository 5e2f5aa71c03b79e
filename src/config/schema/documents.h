#pragma once
// The JSON documents that clusterbench reads and writes, each with its JSON Schema (draft-07).

#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace clusterbench::config {

enum class Document {
  config,
  result,
  comparison,
  ratios,
  recommendation,
  stress,
  worst_case,
  size,
  light_map,
  dump,
  check,
  plugin_check,
  shader
};

struct DocumentRow {
  Document document;
  const char* name;   // argument of `clusterbench schema`
  const char* title;  // for messages: "a result of `clusterbench run`"
  nlohmann::json (*schema)();
};
std::span<const DocumentRow> document_rows();
const DocumentRow& row_of(Document document);

// Detects the type of a JSON document by its keys; a document without the keys of any other type is a configuration.
template <class Json>
Document document_of(const Json& value) {
  if (!value.is_object()) return Document::config;
  if (value.contains("comparison_version")) return Document::comparison;
  if (value.contains("ratios_version")) return Document::ratios;
  if (value.contains("kind") && value["kind"] == "worst-case") return Document::worst_case;
  if (value.contains("recommendation_version")) return Document::recommendation;
  if (value.contains("size_version")) return Document::size;
  if (value.contains("light_map_version")) return Document::light_map;
  if (value.contains("dump_version")) return Document::dump;
  if (value.contains("check_version")) return Document::check;
  if (value.contains("plugin_check_version")) return Document::plugin_check;
  if (value.contains("shader_version")) return Document::shader;
  // One that lacks its version is told so.
  if (value.contains("passes") && value.contains("buffers") && !value.contains("scenes")) return Document::shader;
  if (!value.contains("schema_version") || !value.contains("cases")) return Document::config;
  return value.contains("kind") && value["kind"] == "stress" ? Document::stress : Document::result;
}

// Throws Error if a written document has another version than its schema: names and meanings differ.
void check_version(const std::string& path, const nlohmann::json& document, const DocumentRow& row);

// The embedded text, completed by the rows of assigners and storages; made again only where a method came or went.
std::shared_ptr<const nlohmann::json> shared_config_schema();
nlohmann::json config_schema();
nlohmann::json result_schema();

}  // namespace clusterbench::config
