#pragma once
// The tests of `clusterbench plugin check`, by name.

#include <span>

#include "acceptance/subject.h"

namespace clusterbench::acceptance {

struct AcceptanceTest {
  const char* name;
  const char* asks;    // what a method has to do, in a line
  bool takes_seconds;  // draws until Subject::seconds are over
  void (*run)(const Subject& subject, Findings& findings);
};

// In the order in which they are run: what later ones rest on comes first.
std::span<const AcceptanceTest> acceptance_tests();
// Null if there is none of that name.
const AcceptanceTest* find_test(const std::string& name);

// Runs a test. What it throws becomes a fault, as does a call that forked.
Findings run_test(const AcceptanceTest& test, const Subject& subject);

// The tests of each file.
std::vector<AcceptanceTest> instance_tests();
std::vector<AcceptanceTest> list_tests();
std::vector<AcceptanceTest> memory_tests();
std::vector<AcceptanceTest> surrounding_tests();
std::vector<AcceptanceTest> truth_tests();

}  // namespace clusterbench::acceptance
