#include "cli/running/verdicts.h"

#include <algorithm>
#include <iostream>

#include "cli/output/output.h"
#include "core/text.h"
#include "report/cases/failures.h"
#include "report/choosing/conclusion.h"
#include "report/comparing/compare.h"

namespace clusterbench::cli {
namespace {

ExitCode report_gates(const result::Result& result) {
  const std::vector<std::string> failures = report::gate_failures(result);
  for (const std::string& failure : failures) print_message("FAILED " + failure);
  return failures.empty() ? ExitCode::ok : ExitCode::gate_failed;
}

}  // namespace

Verdicts verdicts_of(const BaselineRequest& baseline, const Gates& gates, result::Result& result) {
  Verdicts verdicts;
  if (!baseline.binary.empty())
    verdicts.comparison = report::compare_results(result, result, baseline.threshold_percent / 100.0);
  verdicts.changes = gates.changes(result);
  verdicts.findings = gates.findings(result);
  const std::vector<std::string> of_cases = report::gate_failures(result);
  std::vector<std::string> failures;
  if (verdicts.comparison)
    for (const std::string& failure : verdicts.comparison->failures)
      if (std::ranges::find(of_cases, failure) == of_cases.end()) failures.push_back(failure);
  for (const report::LimitFindings& some : verdicts.findings)
    failures.insert(failures.end(), some.broken.begin(), some.broken.end());
  report::conclude_failures(result, failures);
  return verdicts;
}

ExitCode report_verdicts(const Verdicts& verdicts, const result::Result& result) {
  ExitCode code = ExitCode::ok;
  if (verdicts.comparison) {
    std::cerr << printable_lines(report::comparison_text(*verdicts.comparison));
    code = report::outcome(*verdicts.comparison, false);
    // where a plug-in broke down in all cases
    if (code == ExitCode::nothing_comparable && !report::gate_failures(result).empty()) code = ExitCode::gate_failed;
  } else {
    code = report_gates(result);
  }
  std::cerr << printable_lines(verdicts.changes) << std::flush;
  const ExitCode limits = report_findings(verdicts.findings);
  return code == ExitCode::ok ? limits : code;
}

}  // namespace clusterbench::cli
