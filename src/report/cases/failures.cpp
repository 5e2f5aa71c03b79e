#include "report/cases/failures.h"

namespace clusterbench::report {

std::vector<std::string> gate_failures(const result::Result& result) {
  std::vector<std::string> lines;
  for (const result::Case& result_case : result.cases)
    for (const result::Failure& failure : result_case.failures) lines.push_back(result_case.name + ": " + failure.text);
  if (result.broken)
    for (const result::BrokenCase& broken : *result.broken) lines.push_back(broken.name + ": " + broken.reason);
  return lines;
}

}  // namespace clusterbench::report
