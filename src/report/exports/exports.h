#pragma once
// Results in the formats of other tools. Adding one is a file in this folder and its row in exports.cpp.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/exports/metrics.h"
#include "result/result.h"

namespace clusterbench::report {

// What every format is made of.
struct ExportCase {
  std::string id, name;
  std::vector<Measured> figures;
  std::vector<double> samples_ns;  // frame times of the rounds, in order; empty if nothing was timed
  int frames_timed = 0;
  // What the name is made of: "scene", "camera", "viewport", "grid", "assigner", "precision", "storage", in this order.
  std::vector<std::pair<std::string, std::string>> parts{};
};

struct ExportResult {
  std::string name, version, git_sha, compiler, flags, build_type, simd_target;
  std::string machine, os;
  int cores = 0;
  bool all = false;                 // figures of the whole table, not only the headline
  std::vector<std::string> failed;  // what the run failed for, a sentence each
  std::vector<ExportCase> cases;
};

struct ExportFormat {
  std::string_view name, summary;
  std::string_view extension;  // without the dot
  std::string (*write)(const ExportResult& result);
  bool needs_times = false;  // it has no other figure to write
};

std::span<const ExportFormat> export_formats();

// Throws Error that lists what there is.
const ExportFormat& export_format(const std::string& name);

// The result in the format: its headline figures, or all of the table. Throws Error where a case lacks what each has,
// and where the format has no place for anything that was measured.
std::string exported(const result::Result& result, const ExportFormat& format, bool all);

// The figure of that name, or null.
const Measured* find_figure(const ExportCase& export_case, std::string_view name);

}  // namespace clusterbench::report
