// The two custom formats of github-action-benchmark (https://github.com/benchmark-action/github-action-benchmark): a
// list of {name, unit, value, range, extra}. Smaller is better for all figures of one format, bigger for all of the
// other.

#include <cstdio>

#include "core/error.h"
#include "report/exports/export_formats.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string plus_minus(const Measured& figure) {
  char text[48];
  std::snprintf(text, sizeof text, "\xC2\xB1 %.4g", (figure.ci95.high - figure.ci95.low) / 2.0);
  return text;
}

std::string list_of(const ExportResult& result, result::Better better, const char* format) {
  Json list = Json::array();
  for (const ExportCase& export_case : result.cases)
    for (const Measured& figure : export_case.figures) {
      if (figure.figure->better != better) continue;
      Json entry{{"name", export_case.name + " " + std::string(figure.figure->exported_as())},
                 {"unit", figure.figure->unit},
                 {"value", figure.value}};
      if (figure.ci95.is_known()) entry["range"] = plus_minus(figure);
      entry["extra"] = "case " + export_case.id;
      list.push_back(entry);
    }
  if (list.empty()) throw Error("", format, "has no figure to write: nothing of its kind was measured");
  return list.dump(1) + "\n";
}

}  // namespace

std::string github_smaller_is_better(const ExportResult& result) {
  return list_of(result, result::Better::smaller, "github-smaller");
}

std::string github_bigger_is_better(const ExportResult& result) {
  return list_of(result, result::Better::bigger, "github-bigger");
}

}  // namespace clusterbench::report
