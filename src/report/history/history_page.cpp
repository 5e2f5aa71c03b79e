#include "report/history/history_page.h"

#include <algorithm>

#include "report/page/page.h"
#include "report/page/page_template.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

bool varies(const Series& series) {
  return std::adjacent_find(series.values.begin(), series.values.end(), std::not_equal_to<>()) != series.values.end();
}

std::string sentence(const Series& series, const measure::ChangePoint& change) {
  const std::string way = direction_text(series, change);
  return series.commits[change.index] + ": " + figure_text(change.before) + " to " + figure_text(change.after) + ", " +
         change_text(change) + (way.empty() ? "" : ", " + way);
}

Json to_json(const Series& series) {
  Json changes = Json::array();
  for (const measure::ChangePoint& change : series.changes)
    changes.push_back(
        {{"index", change.index}, {"text", sentence(series, change)}, {"direction", direction(series, change)}});
  return {{"metric", series.figure->exported_as()},
          {"unit", series.figure->unit},
          {"case", series.case_name},
          {"machine", series.machine},
          {"since", series.settings_since},
          {"commits", series.commits},
          {"values", series.values},
          {"changes", changes}};
}

}  // namespace

std::string history_page(const std::vector<Series>& series, std::size_t entries,
                         const std::vector<std::string>& light_changes) {
  Json data{{"entries", entries}, {"count", series.size()}, {"lights", light_changes}, {"series", Json::array()}};
  for (const Series& case_series : series)
    if (varies(case_series)) data["series"].push_back(to_json(case_series));
  return filled_page(history_template(), data, "history show");
}

}  // namespace clusterbench::report
