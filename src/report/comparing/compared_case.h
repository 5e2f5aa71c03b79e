#pragma once
// One case that two results have: its time, its counts and its instructions compared.

#include "report/comparing/comparability.h"
#include "report/comparing/exact_differences.h"
#include "report/comparing/matched_cases.h"
#include "report/comparing/time_changes.h"
#include "result/documents/comparison.h"

namespace clusterbench::report {

struct CompareSettings {
  double threshold = 0.0;        // the smallest relevant change of time, 0.02 for 2 %
  bool gates_separate = false;   // times of separate runs get verdicts, not hints
  SameSettings same = {};        // of both results
  bool is_paired = false;        // the new result was measured side by side with this base
  bool is_same_program = false;  // a program beside itself: the same, independent of the measured times
};

// `times`: of all matches.
result::ComparedCase compare_case(const Match& match, const TimeChanges& times, const result::NotComparable& left_out,
                                  const CompareSettings& settings);

}  // namespace clusterbench::report
