#include "report/page/page_figures.h"

#include "result/figures/case_figure.h"
#include "result/rounding.h"
#include "result/sample_sets.h"

namespace clusterbench::report {
namespace {

result::ByName<double> figures_of(const result::Case& result_case) {
  result::ByName<double> values;
  for (const result::Figure& figure : result::figures()) {
    const std::string name(figure.name);
    if (const std::optional<double> value = result::figure_of(result_case, name))
      values.emplace_back(name, result::counted(*value));
  }
  return values;
}

}  // namespace

std::vector<result::FigureWords> figure_words() {
  std::vector<result::FigureWords> rows;
  for (const result::Figure& figure : result::figures())
    rows.push_back({std::string(figure.name), std::string(figure.named_unit()), std::string(figure.meaning)});
  return rows;
}

std::vector<result::PageCase> page_cases(const result::Result& result) {
  std::vector<result::PageCase> cases;
  for (const result::Case& result_case : result.cases)
    cases.push_back({figures_of(result_case), ranking_set_names(result_case)});
  return cases;
}

}  // namespace clusterbench::report
