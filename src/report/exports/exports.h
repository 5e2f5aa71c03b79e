#pragma once
// Results in the formats of other tools. A new format is a file in this folder and its row in exports.cpp.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/exports/metrics.h"
#include "result/result.h"

namespace clusterbench::report {

// The input of every format.
struct ExportCase {
  std::string id, name;
  std::vector<Measured> figures;
  std::vector<double> samples_ns;  // frame times of the rounds, in order; empty without timing
  int frames_timed = 0;
  // The parts of the name: "scene", "camera", "viewport", "grid", "assigner", "precision", "storage", in this order;
  // then "machine", where times are of several, and "device", where one is timed.
  std::vector<std::pair<std::string, std::string>> parts{};
};

struct ExportResult {
  std::string name, version, git_sha, compiler, flags, build_type, simd_target;
  std::string machine, os;
  int cores = 0;
  bool has_machines = false;        // times are of several, and each case names its own
  bool has_devices = false;         // some times are a device's, and each case names its own
  bool all = false;                 // all figures of the table, not only the headline
  std::vector<std::string> failed;  // reasons of a failed run, a sentence each
  std::vector<ExportCase> cases;
};

struct ExportFormat {
  std::string_view name, summary;
  std::string_view extension;  // without the dot
  std::string (*write)(const ExportResult& result);
  bool needs_times = false;  // the format has no other figures
  bool is_of_one_machine = false;
};

std::span<const ExportFormat> export_formats();

// Throws Error that lists all formats.
const ExportFormat& export_format(const std::string& name);

// The result in the format: its headline figures, or all of the table. Throws Error if a case lacks a mandatory figure,
// if the format can express none of the measured figures, and for times of several machines if the format is of one.
std::string exported(const result::Result& result, const ExportFormat& format, bool all);

// The figure of that name, or null.
const Measured* find_figure(const ExportCase& export_case, std::string_view name);

}  // namespace clusterbench::report
