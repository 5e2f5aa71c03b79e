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

// Throws Error for a file that cannot be written, so that it is known before minutes go into measuring.
void probe_exports(const std::vector<ExportTarget>& targets);

void write_exports(const std::vector<ExportTarget>& targets, const nlohmann::ordered_json& result);

// "google-benchmark  Google ..." a line each, for help texts.
std::string export_formats_text();

}  // namespace clusterbench::cli
