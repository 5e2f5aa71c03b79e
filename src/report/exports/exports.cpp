#include "report/exports/exports.h"

#include "core/error.h"
#include "core/text.h"
#include "report/exports/formats.h"
#include "report/json_values.h"
#include "report/machine.h"

namespace clusterbench::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr ExportFormat k_formats[] = {
    {"google-benchmark", "Google Benchmark's JSON, a repetition per round, for its compare.py", "json",
     google_benchmark, true},
    {"github-smaller", "github-action-benchmark, tool customSmallerIsBetter", "json", github_smaller_is_better},
    {"github-bigger", "github-action-benchmark, tool customBiggerIsBetter", "json", github_bigger_is_better, true},
    {"bencher", "Bencher Metric Format", "json", bencher},
    {"lnt", "LLVM's LNT, report format 2, test suite nts", "json", lnt},
    {"csv", "A row per case, comma-separated (RFC 4180)", "csv", csv},
    {"markdown", "What failed and a table, for comments and pages", "md", markdown},
};

std::string string_at(const Json& from, const char* pointer) {
  const Json* found = value_at(from, pointer);
  return found != nullptr && found->is_string() ? found->get<std::string>() : "";
}

std::string needed_text(const Json& result_case, std::size_t index, const char* key) {
  std::string text = string_at(result_case, (std::string("/") + key).c_str());
  if (text.empty()) throw Error("", "/cases/" + std::to_string(index) + "/" + key, "is missing");
  return text;
}

// "" where a case lacks it.
std::vector<std::pair<std::string, std::string>> parts_of(const Json& result_case) {
  const Json *width = value_at(result_case, "/viewport/0"), *height = value_at(result_case, "/viewport/1");
  const std::string viewport = width != nullptr && height != nullptr ? width->dump() + "x" + height->dump() : "";
  const std::string precision = string_at(result_case, "/precision/label"),
                    pre_cull = string_at(result_case, "/pre_cull/label");
  return {{"scene", string_at(result_case, "/scene")},
          {"camera", string_at(result_case, "/camera")},
          {"viewport", viewport},
          {"grid", string_at(result_case, "/grid/name")},
          {"assigner", string_at(result_case, "/assigner/label") + (pre_cull.empty() ? "" : " after " + pre_cull)},
          {"precision", precision.empty() ? "float32" : precision},
          {"storage", string_at(result_case, "/storage")}};
}

ExportCase read_case(const Json& result_case, std::size_t index, bool all) {
  const bool has_frame_time = value_at(result_case, "/timing/frame_ns") != nullptr;
  ExportCase out{needed_text(result_case, index, "id"),
                 needed_text(result_case, index, "name"),
                 measured(result_case, all),
                 has_frame_time ? "frame_time" : "assign_time",
                 {},
                 0};
  const Json *samples =
                 value_at(result_case, has_frame_time ? "/timing/frame_ns/samples" : "/timing/assign_ns/samples"),
             *frames = value_at(result_case, "/timing/frames_timed");
  if (samples != nullptr)
    for (const Json& sample : *samples)
      if (sample.is_number()) out.samples_ns.push_back(sample.get<double>());
  if (frames != nullptr && frames->is_number_integer()) out.frames_timed = frames->get<int>();
  out.parts = parts_of(result_case);
  return out;
}

ExportResult read(const Json& result, bool all) {
  ExportResult out;
  out.all = all;
  out.name = string_at(result, "/name");
  out.version = string_at(result, "/tool/version");
  out.git_sha = string_at(result, "/tool/git_sha");
  out.compiler = string_at(result, "/tool/compiler");
  out.flags = string_at(result, "/tool/flags");
  out.build_type = string_at(result, "/tool/build_type");
  out.simd_target = string_at(result, "/tool/simd_target");
  out.machine = machine_name(result["machine"]);
  out.os = string_at(result, "/machine/os");
  if (const Json* cores = value_at(result, "/machine/cores"); cores != nullptr && cores->is_number_integer())
    out.cores = cores->get<int>();
  if (const Json* failed = value_at(result, "/failed"); failed != nullptr && failed->is_array())
    for (const Json& sentence : *failed) out.failed.push_back(sentence.get<std::string>());
  for (std::size_t index = 0; index < result["cases"].size(); ++index)
    out.cases.push_back(read_case(result["cases"][index], index, all));
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

std::string exported(const Json& result, const ExportFormat& format, bool all) {
  return format.write(read(result, all));
}

const Measured* find_figure(const ExportCase& export_case, std::string_view name) {
  for (const Measured& figure : export_case.figures)
    if (figure.metric->name == name) return &figure;
  return nullptr;
}

}  // namespace clusterbench::report
