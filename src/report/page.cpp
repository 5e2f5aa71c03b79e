#include "report/page.h"

#include <string_view>

#include "core/error.h"
#include "report/page_template.h"

namespace clusterbench::report {
namespace {

void replace_all(std::string& text, std::string_view found, std::string_view replacement) {
  for (std::size_t at = text.find(found); at != std::string::npos; at = text.find(found, at + replacement.size()))
    text.replace(at, found.size(), replacement);
}

}  // namespace

// "<" stands in no JSON but in strings; U+2028 and U+2029 end lines in scripts.
std::string script_json(const nlohmann::ordered_json& value) {
  std::string text = value.dump();
  replace_all(text, "<", "\\u003c");
  replace_all(text, "\u2028", "\\u2028");
  replace_all(text, "\u2029", "\\u2029");
  return text;
}

std::string page(const std::vector<NamedResult>& results, const std::string& command) {
  if (!page_obstacle().empty()) throw Error("", "report", std::string(page_obstacle()));
  nlohmann::ordered_json data{{"command", command}, {"results", nlohmann::ordered_json::array()}};
  for (const NamedResult& one : results) data["results"].push_back({{"file", one.file}, {"result", one.result}});
  std::string html(page_template());
  return html.replace(html.find(k_results_mark), k_results_mark.size(), script_json(data));
}

}  // namespace clusterbench::report
