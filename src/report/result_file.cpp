#include "report/result_file.h"

#include <fstream>

#include "config/documents.h"
#include "config/schema_check.h"
#include "core/error.h"
#include "report/json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using namespace std::string_literals;

// The journal (report/journal.h) has a document per line, the first of them its header.
bool is_journal(std::istream& in) {
  std::string line;
  in.clear();
  in.seekg(0);
  std::getline(in, line);
  const Json first = Json::parse(line, nullptr, false);
  return first.is_object() && first.contains("header");
}

// Takes away what a result of another schema version may do otherwise: have another number, and further properties.
void relax(nlohmann::json& schema) {
  if (schema.is_object()) schema.erase("additionalProperties");
  if (schema.is_structured())
    for (nlohmann::json& member : schema) relax(member);
}

// Whoever reads results relies on what the schema promises.
void check(const std::string& path, const Json& result, Schema version) {
  nlohmann::json schema = config::result_schema();
  if (version == Schema::any) {
    relax(schema);
    schema["properties"].erase("schema_version");
  }
  const std::vector<std::string> violations = config::schema_violations(schema, nlohmann::json(result));
  if (!violations.empty())
    throw Error(path, "", "is not a valid result: " + violations.front() + "; `clusterbench validate` lists all");
}

}  // namespace

Json read_result(const std::string& path, Schema schema) {
  std::ifstream in(path, std::ios::binary);
  if (!in || in.peek() == std::ifstream::traits_type::eof())
    throw Error(path, "", in.eof() ? "is empty" : "cannot be read");
  if (is_journal(in))
    throw Error(path, "", "is what an unfinished run left; `clusterbench run` with --resume makes a result of it");
  in.clear();
  in.seekg(0);
  Json result;
  try {
    result = Json::parse(in);
  } catch (const nlohmann::json::parse_error& error) {
    throw Error(path, "byte " + std::to_string(error.byte), "is not JSON");
  }
  if (const config::Document document = config::document_of(result); document != config::Document::result)
    throw Error(path, "",
                document == config::Document::config
                    ? "is not a result file of `clusterbench run`"
                    : "is "s + config::row_of(document).title + "; wanted is one of `clusterbench run`");
  if (schema == Schema::this_version && result["schema_version"] != k_schema_version)
    throw Error(path, "/schema_version",
                "is " + result["schema_version"].dump() + "; this version reads " + std::to_string(k_schema_version));
  check(path, result, schema);
  return result;
}

}  // namespace clusterbench::report
