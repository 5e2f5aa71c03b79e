#pragma once
// Compares two results: counts must be equal or better; times measured side by side get a verdict per case, times of
// separate runs a hint. docs/comparing.md explains verdicts.

#include <string>
#include <vector>

#include "core/error.h"
#include "result/documents/comparison.h"

namespace clusterbench::report {

struct CompareOptions {
  bool gates_separate = false;  // times of separate runs get verdicts, not hints
  bool is_forced = false;       // compares times and instructions in spite of obstacles
};

// `threshold`: the smallest relevant change of time, 0.02 for 2 %. Times: of rounds side by side if the new result has
// them for this base ("data": "paired"), else of medians ("separate").
result::Comparison compare_results(const result::Result& base, const result::Result& next, double threshold,
                                   const CompareOptions& options = {});

// ok, gate_failed (a failure), nothing_comparable (no common case, and none of the base that broke); with `is_strict`
// inconclusive if a verdict is, if a case of the base is missing, or if instructions could not be compared.
ExitCode outcome(const result::Comparison& comparison, bool is_strict);

// As a table for terminals, and for a pull request.
std::string comparison_text(const result::Comparison& comparison);
std::string comparison_markdown(const result::Comparison& comparison);

}  // namespace clusterbench::report
