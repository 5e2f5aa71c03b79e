#pragma once
// Which times, instructions and figures of two results can be compared. Counts of lists, buffers and errors always can.

#include <string>
#include <vector>

#include "report/comparing/exact_differences.h"
#include "report/comparing/matched_cases.h"
#include "result/documents/comparison.h"
#include "result/result.h"

namespace clusterbench::report {

// "/machine/cpu is 'A' and 'B'" for each differing field that figures depend on. Counts of lists, buffers and errors
// depend on none.
struct Obstacles {
  std::vector<std::string> to_times, to_instructions;
};
Obstacles obstacles(const result::Result& base, const result::Result& next);

// The parts of common cases that are not compared, each with the reasons.
struct LeftOut {
  result::NotComparable parts;
  std::vector<std::string> forced;  // obstacles that the user overrides
};

// `is_paired`: their times were measured side by side, and so can be compared. `is_forced`: compares in spite of
// obstacles().
LeftOut left_out(const result::Result& base, const result::Result& next, const std::vector<Match>& matches,
                 bool is_paired, bool is_forced);

// "allocation.margin is 2.0 and 1.5"; empty if it is the same.
std::vector<std::string> differing_margin(const result::Result& base, const result::Result& next);
// "cost.ns_per_light is 0.02 and 0.005" for each price that differs; empty if a result has no modelled costs.
std::vector<std::string> differing_prices(const result::Result& base, const result::Result& next);
SameSettings same_settings(const result::Result& base, const result::Result& next);

// Both are counted: by the same counter, with the same instruction set, over as many frames.
bool are_counts_comparable(const Match& match);

}  // namespace clusterbench::report
