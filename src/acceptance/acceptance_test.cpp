#include "acceptance/acceptance_test.h"

#include <algorithm>

#include "core/text.h"
#include "os/call_notes.h"

namespace clusterbench::acceptance {

std::span<const AcceptanceTest> acceptance_tests() {
  static const std::vector<AcceptanceTest> all = [] {
    std::vector<AcceptanceTest> tests;
    for (const auto some : {instance_tests, list_tests, memory_tests, surrounding_tests, truth_tests})
      for (const AcceptanceTest& test : some()) tests.push_back(test);
    return tests;
  }();
  return all;
}

const AcceptanceTest* find_test(const std::string& name) {
  for (const AcceptanceTest& test : acceptance_tests())
    if (test.name == name) return &test;
  return nullptr;
}

Findings run_test(const AcceptanceTest& test, const Subject& subject) {
  Findings findings;
  os::note_setting("");
  try {
    test.run(subject, findings);
  } catch (const std::exception& error) {
    findings.fault(printable(error.what()));
  }
  if (const auto step = os::forked_step())
    findings.fault(std::string("came back twice from ") + os::name_of(*step) + ": it forked");
  return findings;
}

}  // namespace clusterbench::acceptance
