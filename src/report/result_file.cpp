#include "report/result_file.h"

#include <cerrno>
#include <fstream>

#include "config/documents.h"
#include "config/schema_verdict.h"
#include "core/error.h"
#include "report/case_filter.h"
#include "report/result_json.h"

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

// Readers of results rely on the schema.
void check(const std::string& path, const Json& result) {
  const std::vector<std::string> violations =
      config::schema_violations(config::result_schema(), nlohmann::json(result));
  if (!violations.empty())
    throw Error(path, "", "is not a valid result: " + violations.front() + "; `clusterbench validate` lists all");
}

}  // namespace

Json read_result(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || in.peek() == std::ifstream::traits_type::eof())
    throw Error(path, "", in.eof() ? "is empty" : errno_says("cannot be read"));
  if (is_journal(in))
    throw Error(path, "", "is what an unfinished run left; `clusterbench run` with --resume makes a result of it");
  in.clear();
  in.seekg(0);
  Json result;
  try {
    result = Json::parse(in);
  } catch (const nlohmann::json::parse_error& error) {
    throw Error(path, "byte " + std::to_string(error.byte), "is not JSON");
  } catch (const nlohmann::json::out_of_range&) {
    throw Error(path, "", "has a number that is larger than double precision can hold");
  }
  if (const config::Document document = config::document_of(result); document != config::Document::result)
    throw Error(path, "",
                document == config::Document::config
                    ? "is not a result file of `clusterbench run`"
                    : "is "s + config::row_of(document).title + "; wanted is one of `clusterbench run`");
  config::check_version(path, result, config::row_of(config::Document::result));
  check(path, result);
  use_current_names(result);
  return result;
}

}  // namespace clusterbench::report
