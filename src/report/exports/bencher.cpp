// Bencher Metric Format (https://bencher.dev/docs/reference/bencher-metric-format): benchmark -> measure -> value and
// bounds.

#include <algorithm>

#include "report/exports/export_formats.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// Bencher knows the time of a benchmark as `latency`, in nanoseconds; its other names have dashes.
std::string measure_name(std::string_view metric) {
  if (metric == "frame_time") return "latency";
  std::string name(metric);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

}  // namespace

std::string bencher(const ExportResult& result) {
  Json out = Json::object();
  for (const ExportCase& export_case : result.cases) {
    Json& measures = out[export_case.name] = Json::object();
    for (const Measured& figure : export_case.figures) {
      Json& measure = measures[measure_name(figure.figure->exported_as())];
      measure = {{"value", figure.value}};
      if (!figure.ci95.is_known()) continue;
      measure["lower_value"] = figure.ci95.low;
      measure["upper_value"] = figure.ci95.high;
    }
  }
  return out.dump(1) + "\n";
}

}  // namespace clusterbench::report
