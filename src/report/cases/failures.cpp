#include "report/cases/failures.h"

namespace clusterbench::report {

std::vector<std::string> gate_failures(const result::Result& result) {
  std::vector<std::string> lines;
  for (const result::Case& result_case : result.cases)
    for (const result::Failure& failure : result_case.failures) lines.push_back(result_case.name + ": " + failure.text);
  for (const result::Skipped& skipped : result.skipped)
    if (skipped.failed.value_or(false)) lines.push_back(skipped.name + ": " + skipped.reason);
  return lines;
}

}  // namespace clusterbench::report
