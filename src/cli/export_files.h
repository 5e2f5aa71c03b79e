#pragma once
// --export FORMAT=FILE: where a result goes beside its own file.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/exports/exports.h"

namespace clusterbench::cli {

struct ExportTarget {
  const report::ExportFormat* format;
  std::string file;  // "-": standard output
};

// From "FORMAT=FILE" each. Throws Error for what is not that, and for an unknown format.
std::vector<ExportTarget> export_targets(const std::vector<std::string>& texts);

// Throws Error for a file that cannot be written, or a format that takes what is not to be measured, so that it is
// known before minutes go into measuring. Files that are not there yet are not there afterwards.
void probe_exports(const std::vector<ExportTarget>& targets, bool are_times_measured);

// All formats are made before the first file is written.
void write_exports(const std::vector<ExportTarget>& targets, const nlohmann::ordered_json& result);

// "google-benchmark  Google ..." a line each, for help texts.
std::string export_formats_text();

}  // namespace clusterbench::cli
