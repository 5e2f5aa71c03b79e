#include "report/page/page.h"

#include <string_view>

#include "core/error.h"
#include "core/text.h"
#include "report/cases/timing_warnings.h"
#include "report/comparing/ratios.h"
#include "report/page/page_costs.h"
#include "report/page/page_figures.h"
#include "report/page/page_template.h"
#include "result/sample_sets.h"

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

std::string check_page(const result::CheckPage& data) {
  return filled_page(check_template(), result::to_json(data), "--page");
}

std::string page(const std::vector<NamedResult>& results, const std::string& command,
                 const std::vector<PagePicture>& pictures) {
  result::PageData data{.command = command, .figures = figure_words(), .pictures = pictures};
  for (const NamedResult& named : results)
    data.results.push_back({.file = printable(named.file),
                            .recorded = named.result,
                            .cases = page_cases(named.result),
                            .doubts = timing_doubts(named.result),
                            .ratios = ratio_rankings(named.result),
                            .costs = page_costs(named.result)});
  for (const std::string& set : result::sample_set_names())
    data.sample_sets.emplace_back(set, result::words_of_set(set));
  return filled_page(page_template(), result::to_json(data), "report");
}

}  // namespace clusterbench::report
