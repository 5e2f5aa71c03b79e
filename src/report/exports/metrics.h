#pragma once
// The figures of a case that other tools are given. Names and units are stable; a figure is one row of the table.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "measure/statistics/time_statistics.h"
#include "result/case.h"

namespace clusterbench::report {

enum class Better { smaller, bigger, neither };

// What a figure rests on.
enum class Basis {
  count,         // of lists, buffers and errors: the same on every machine, and every time
  instructions,  // nearly the same every time; of a compiler and an instruction set
  time,          // of a machine, and noisy
  derived        // another figure, said in another way
};

struct Metric {
  std::string_view name;  // lower-case words with underscores
  std::string_view unit;  // "ns", "bytes", "pairs", "ratio", ...
  Better better;
  Basis basis;
  bool is_headline;  // exported unless everything is asked for
  std::optional<double> (*value)(const result::Case& result_case);
  const result::Interval* (*interval)(const result::Case& result_case) = nullptr;  // 95 %; null if it has none
  double dividend = 0.0;  // the figure is dividend / value where this is not 0
};

inline Basis basis_of(const Metric& metric) {
  return metric.basis;
}

// Headline first, else in the order of the result.
std::span<const Metric> export_metrics();

struct Measured {
  const Metric* metric;
  double value;
  measure::Interval ci95;  // unknown where there is none
};

// What the case has of the table: absent and null figures are left out.
std::vector<Measured> measured(const result::Case& result_case, bool all);

}  // namespace clusterbench::report
