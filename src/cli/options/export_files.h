#pragma once
// --export FORMAT=FILE: further files with the result.

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

// Parses "FORMAT=FILE" entries. Throws Error for another form, and for an unknown format.
std::vector<ExportTarget> export_targets(const std::vector<std::string>& texts);

class ExportFiles {
 public:
  // Throws Error for a file that cannot be written, or a format that needs figures that will not be measured, so that
  // the user learns it before minutes of measuring. Creates no files yet.
  ExportFiles(const std::vector<ExportTarget>& targets, bool are_times_measured);

  // All formats are made before the first file is written.
  void write(const result::Result& result) const;

 private:
  std::vector<ExportTarget> targets_;
  std::vector<std::unique_ptr<os::OutputFile>> files_;
};

// One line per format, "google-benchmark  Google ...", for help texts.
std::string export_formats_text();

}  // namespace clusterbench::cli
