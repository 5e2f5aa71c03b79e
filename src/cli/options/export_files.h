#pragma once
// --export FORMAT=FILE: where a result goes beside its own file.

#include <memory>
#include <string>
#include <vector>

#include "os/output_file.h"
#include "report/exports/exports.h"
#include "result/result.h"

namespace clusterbench::cli {

struct ExportTarget {
  const report::ExportFormat* format;
  std::string file;  // "-": standard output
};

// From "FORMAT=FILE" each. Throws Error for what is not that, and for an unknown format.
std::vector<ExportTarget> export_targets(const std::vector<std::string>& texts);

class ExportFiles {
 public:
  // Throws Error for a file that cannot be written, or a format that takes what is not to be measured, so that it is
  // known before minutes go into measuring. Files that are not there yet are not there afterwards.
  ExportFiles(const std::vector<ExportTarget>& targets, bool are_times_measured);

  // All formats are made before the first file is written.
  void write(const result::Result& result) const;

 private:
  std::vector<ExportTarget> targets_;
  std::vector<std::unique_ptr<os::OutputFile>> files_;
};

// "google-benchmark  Google ..." a line each, for help texts.
std::string export_formats_text();

}  // namespace clusterbench::cli
