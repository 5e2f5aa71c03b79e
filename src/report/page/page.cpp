#include "report/page/page.h"

#include <string_view>

#include "core/error.h"
#include "report/cases/timing_warnings.h"
#include "report/comparing/ratios.h"
#include "report/page/page_costs.h"
#include "report/page/page_template.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

void replace_all(std::string& text, std::string_view found, std::string_view replacement) {
  for (std::size_t at = text.find(found); at != std::string::npos; at = text.find(found, at + replacement.size()))
    text.replace(at, found.size(), replacement);
}

}  // namespace

// JSON has "<" only in strings; U+2028 and U+2029 end lines in scripts.
std::string script_json(const Json& value) {
  std::string text = value.dump();
  replace_all(text, "<", "\\u003c");
  replace_all(text, "\u2028", "\\u2028");
  replace_all(text, "\u2029", "\\u2029");
  return text;
}

std::string filled_page(std::string_view page_template, const Json& data, const char* command) {
  if (!page_obstacle().empty()) throw Error("", command, std::string(page_obstacle()));
  std::string html(page_template);
  return html.replace(html.find(k_results_mark), k_results_mark.size(), script_json(data));
}

std::string page(const std::vector<NamedResult>& results, const std::string& command,
                 const std::vector<PagePicture>& pictures) {
  Json data{{"command", command}, {"results", Json::array()}, {"pictures", Json::array()}};
  for (const NamedResult& named : results)
    data["results"].push_back({{"file", named.file},
                               {"result", result::to_json(named.result)},
                               {"doubts", timing_doubts(named.result.cases)},
                               {"ratios", ratio_rankings(named.result)},
                               {"costs", page_costs(named.result)}});
  for (const PagePicture& picture : pictures)
    data["pictures"].push_back({{"kind", picture.kind},
                                {"frame", picture.frame ? Json(*picture.frame) : nullptr},
                                {"cases", picture.case_ids},
                                {"text", picture.text},
                                {"url", picture.url}});
  return filled_page(page_template(), data, "report");
}

}  // namespace clusterbench::report
