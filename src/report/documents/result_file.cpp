#include "report/documents/result_file.h"

#include <map>
#include <string_view>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "report/cases/case_filter.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using namespace std::string_literals;

// The journal (report/documents/journal.h) has a document per line, the first of them its header.
bool is_journal(std::string_view text) {
  const Json first = json_or_discarded<Json>(text.substr(0, text.find('\n')));
  return first.is_object() && first.contains("header");
}

// A line per result, all of the same form.
bool is_history(std::string_view text) {
  const Json first = json_or_discarded<Json>(text.substr(0, text.find('\n')));
  return first.is_object() && first.contains("history_version");
}

// Readers of results rely on the schema.
void check(const std::string& path, const Json& result) {
  const std::vector<std::string> violations =
      config::schema_violations(config::result_schema(), nlohmann::json(result));
  if (!violations.empty())
    throw Error(path, "", "is not a valid result: " + violations.front() + "; `clusterbench validate` lists all");
}

result::Result record_of(const std::string& path, const Json& json) {
  try {
    return result::from_json<result::Result>(json);
  } catch (const Error& error) {
    throw Error(path, "", "is not a valid result: " + error.where() + ": " + error.message());
  }
}

// Cases are known by their ids. A run gives each its own.
void check_ids(const std::string& path, const result::Result& result) {
  std::map<std::string_view, const result::Case*> known;
  for (const result::Case& one : result.cases)
    if (const auto [earlier, is_new] = known.try_emplace(one.id, &one); !is_new)
      throw Error(path, "", "has two cases with the id " + one.id + ": " + earlier->second->name + " and " + one.name);
}

}  // namespace

void refuse_history(const std::string& path, std::string_view text) {
  if (is_history(text))
    throw Error(path, "", "is a history of results, which `clusterbench history show` reads; wanted is a single one");
}

result::Result read_result(const std::string& path) {
  const std::string text = file_text(path);
  if (text.empty()) throw Error(path, "", "is empty");
  if (text.starts_with("glTF")) throw Error(path, "", "is a glTF scene; wanted is a result of `clusterbench run`");
  if (is_journal(text))
    throw Error(path, "", "is what an unfinished run left; `clusterbench run` with --resume makes a result of it");
  refuse_history(path, text);
  const Json json = read_json<Json>(text, path);
  if (const config::Document document = config::document_of(json); document != config::Document::result)
    throw Error(path, "",
                document == config::Document::config
                    ? "is not a result file of `clusterbench run`"
                    : "is "s + config::row_of(document).title + "; wanted is one of `clusterbench run`");
  config::check_version(path, json, config::row_of(config::Document::result));
  check(path, json);
  result::Result result = record_of(path, json);
  check_ids(path, result);
  use_current_names(result);
  return result;
}

}  // namespace clusterbench::report
