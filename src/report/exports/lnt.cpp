// A report of LLVM's LNT, format 2 (https://llvm.org/docs/lnt/importing_data.html). The headline fits LNT's own test
// suite "nts": execution_time in seconds, a value per round, and mem_bytes. More figures (--all) need a test suite that
// names them.

#include "report/exports/export_formats.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// All rounds: LNT uses their minimum and keeps their spread.
Json seconds(const std::vector<double>& samples_ns) {
  Json list = Json::array();
  for (const double sample : samples_ns) list.push_back(sample * 1e-9);
  return list;
}

Json test(const ExportCase& export_case) {
  Json out{{"name", export_case.name}};
  if (!export_case.samples_ns.empty()) out["execution_time"] = seconds(export_case.samples_ns);
  for (const Measured& figure : export_case.figures) {
    if (figure.figure->exported_as() == "list_bytes") out["mem_bytes"] = figure.value;
    if (!figure.figure->is_headline) out[std::string(figure.figure->exported_as())] = figure.value;
  }
  return out;
}

}  // namespace

std::string lnt(const ExportResult& result) {
  Json out{{"format_version", "2"},
           {"machine", {{"name", result.machine}, {"os", result.os}, {"cores", std::to_string(result.cores)}}},
           {"run",
            {{"llvm_project_revision", result.git_sha},
             {"version", result.version},
             {"compiler", result.compiler},
             {"flags", result.flags},
             {"simd_target", result.simd_target}}},
           {"tests", Json::array()}};
  for (const ExportCase& export_case : result.cases) out["tests"].push_back(test(export_case));
  return out.dump(1) + "\n";
}

}  // namespace clusterbench::report
