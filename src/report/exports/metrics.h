#pragma once
// The figures of a case that other tools are given. Names and units are stable; a figure is one row of the table.

#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "measure/time_statistics.h"

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
  std::string_view name;      // lower-case words with underscores
  std::string_view unit;      // "ns", "bytes", "pairs", "ratio", ...
  std::string_view pointer;   // of the value in a result's case, as a JSON pointer
  std::string_view interval;  // of its 95 % interval [low, high]; "" if it has none
  Better better;
  bool is_headline;       // exported unless everything is asked for
  double dividend = 0.0;  // the figure is dividend / value where this is not 0
};

Basis basis_of(const Metric& metric);

// Headline first, else in the order of the result.
std::span<const Metric> export_metrics();

struct Measured {
  const Metric* metric;
  double value;
  measure::Interval ci95;  // unknown where there is none
};

// What the case has of the table: absent and null figures are left out.
std::vector<Measured> measured(const nlohmann::ordered_json& result_case, bool all);

}  // namespace clusterbench::report
