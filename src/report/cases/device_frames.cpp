#include "report/cases/device_frames.h"

#include "report/cases/case_costs.h"
#include "report/cases/contender.h"
#include "result/at.h"
#include "result/figures/case_figure.h"
#include "result/rounding.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using result::Case;

// Assignment and upload, in ns. None if the case has no times of both.
struct ListTimes {
  double assign_ns = 0.0, upload_ns = 0.0;
};

std::optional<ListTimes> of_device(const Case& result_case) {
  if (!result_case.device) return {};
  return ListTimes{result_case.device->run_ns.median, result_case.device->upload_ns.median};
}

std::optional<ListTimes> of_processor(const Case& result_case, const result::Json& config) {
  if (!result_case.timing || !config.contains("cost")) return {};
  const auto bytes =
      result::number<&Case::buffers, &result::Buffers::upload_bytes, &result::FrameBytes::mean>(result_case);
  if (!bytes) return {};
  return ListTimes{result_case.timing->frame_ns.median, *bytes / cost_model_of(config["cost"]).upload_gb_per_s};
}

result::Json reading_of(const result::Json& config) {
  return config.contains("reading") ? config["reading"] : result::Json();
}

std::optional<double> frame_ns(const Case& result_case, const result::Json& config) {
  if (reads_a_part(result_case.reading->set, config) || is_converted_untimed(result_case)) return {};
  const std::optional<double> read_us = result::figure_of(result_case, "reading_us");
  const result::Json reading = reading_of(config);
  const bool is_given = reading.is_object() && reading.contains("async");
  const bool is_on_device = runs_on_device(result_case);
  const auto lists = is_on_device ? of_device(result_case)
                     : is_given   ? of_processor(result_case, config)
                                  : std::nullopt;
  if (!read_us || !lists) return {};
  const double beside = is_given ? reading["async"].get<double>() : 0.0;
  return (1.0 - beside) * lists->assign_ns + lists->upload_ns + *read_us * 1e3;
}

}  // namespace

bool reads_a_part(const std::string& set, const result::Json& config) {
  const bool reads_surfaces = set == "opaque" || set == "transparent" || set == "mirror";
  const result::Json request = reading_of(config);
  return reads_surfaces && request.is_object() && request.value("divisor", 1) != 1;
}

bool is_converted_untimed(const Case& result_case) {
  return runs_on_device(result_case) && result_case.storage != "packed" && result_case.storage != run::k_own_structure;
}

void add_device_frames(std::vector<Case>& cases, const result::Json& config) {
  for (Case& result_case : cases)
    if (result_case.reading) {
      const std::optional<double> ns = frame_ns(result_case, config);
      result_case.reading->frame_ns = ns ? std::optional(result::measured(*ns)) : std::nullopt;
    }
}

}  // namespace clusterbench::report
