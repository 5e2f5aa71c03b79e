#include "report/exports/exports.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/documents/machine_name.h"
#include "report/exports/export_formats.h"

namespace clusterbench::report {
namespace {

using result::Case;

constexpr ExportFormat k_formats[] = {
    {"google-benchmark", "Google Benchmark's JSON, a repetition per round, for its compare.py", "json",
     google_benchmark, true, true},
    {"github-smaller", "github-action-benchmark, tool customSmallerIsBetter", "json", github_smaller_is_better, false,
     true},
    {"github-bigger", "github-action-benchmark, tool customBiggerIsBetter", "json", github_bigger_is_better, true,
     true},
    {"bencher", "Bencher Metric Format", "json", bencher, false, true},
    {"lnt", "LLVM's LNT, report format 2, test suite nts", "json", lnt, false, true},
    {"csv", "A row per case, comma-separated (RFC 4180)", "csv", csv},
    {"markdown", "What failed and a table, for comments and pages", "md", markdown},
};

void require(const std::string& text, std::size_t index, const std::string& key) {
  if (text.empty()) throw Error("", "/cases/" + std::to_string(index) + "/" + key, "is missing");
}

std::vector<std::pair<std::string, std::string>> parts_of(const Case& result_case) {
  const std::string pre_cull = result_case.pre_cull ? result_case.pre_cull->label : "";
  return {{"scene", result_case.scene},
          {"camera", result_case.camera},
          {"viewport", viewport_text(result_case.viewport)},
          {"grid", result_case.grid.name},
          {"assigner", result_case.assigner.label + (pre_cull.empty() ? "" : " after " + pre_cull)},
          {"precision", result_case.precision ? result_case.precision->label : "float32"},
          {"storage", result_case.storage}};
}

// "llvmpipe, llvmpipe Mesa 22.3.6 (software)"; "" without times on one.
std::string device_of(const result::Result& result, const Case& result_case) {
  if (!result_case.device) return "";
  return result_case.device->device + (is_on_software_device(result, result_case) ? " (software)" : "");
}

ExportCase read_case(const Case& result_case, std::size_t index, bool all) {
  require(result_case.id, index, "id");
  require(result_case.name, index, "name");
  ExportCase out{result_case.id, result_case.name, measured(result_case, all), {}, 0, parts_of(result_case)};
  if (!result_case.timing) return out;
  for (const double sample : result_case.timing->frame_ns.samples)
    if (std::isfinite(sample)) out.samples_ns.push_back(sample);
  out.frames_timed = static_cast<int>(result_case.timing->frames_timed);
  return out;
}

ExportResult read(const result::Result& result, bool all) {
  ExportResult out;
  out.all = all;
  out.name = result.name;
  out.version = result.tool.version;
  out.git_sha = result.tool.git_sha;
  out.compiler = result.tool.compiler;
  out.flags = result.tool.flags;
  out.build_type = result.tool.build_type;
  out.simd_target = result.tool.simd_target;
  out.machine = machine_name(result.machine);
  out.has_machines = result.machines.has_value();
  out.os = result.machine.os;
  out.cores = static_cast<int>(result.machine.cores);
  out.failed = result.failed.value_or(std::vector<std::string>());
  for (const result::BrokenCase& broken : result.broken.value_or(std::vector<result::BrokenCase>()))
    out.failed.push_back(broken.name + ": " + broken.reason);
  out.has_devices = std::ranges::any_of(result.cases, [](const Case& one) { return one.device.has_value(); });
  for (const Case& result_case : result.cases) {
    out.cases.push_back(read_case(result_case, out.cases.size(), all));
    if (out.has_machines) out.cases.back().parts.emplace_back("machine", result_case.machine.value_or(""));
    if (out.has_devices) out.cases.back().parts.emplace_back("device", device_of(result, result_case));
  }
  return out;
}

}  // namespace

std::span<const ExportFormat> export_formats() {
  return k_formats;
}

const ExportFormat& export_format(const std::string& name) {
  std::vector<std::string> names;
  for (const ExportFormat& format : k_formats) {
    if (format.name == name) return format;
    names.emplace_back(format.name);
  }
  throw Error("", "export", "no format '" + name + "'" + did_you_mean(name, names) + "; there are: " + joined(names));
}

std::string exported(const result::Result& result, const ExportFormat& format, bool all) {
  if (format.is_of_one_machine && result.machines)
    throw Error("", "/machines",
                "has times of several machines, and " + std::string(format.name) +
                    " is of one; export the results that were merged, or take csv or markdown");
  return format.write(read(result, all));
}

const Measured* find_figure(const ExportCase& export_case, std::string_view name) {
  for (const Measured& figure : export_case.figures)
    if (figure.figure->exported_as() == name) return &figure;
  return nullptr;
}

}  // namespace clusterbench::report
