#pragma once
// Every figure of a case, one row each: budgets, exports, tables, the page, `recommend`, `worst-case`, `history`,
// `compare` and `list figures` use it. A new figure is one row in figure_table.cpp and a formula in a test
// (CONTRIBUTING.md, "Adding a figure").

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "result/case.h"

namespace clusterbench::result {

enum class Better : std::uint8_t { smaller, bigger, neither };
const char* name_of(Better better);  // "smaller", "bigger", "neither"

// The source of a figure.
enum class Basis : std::uint8_t {
  count,         // of lists, buffers and errors: the same on every machine, and in every run
  instructions,  // nearly the same in every run; depends on the compiler and the instruction set
  time,          // depends on the machine, and is noisy
  derived        // computed from times
};
const char* name_of(Basis basis);  // "counts", "instructions", "measured times", "derived times"

// The combination of one figure over several cameras.
enum class OverCameras : std::uint8_t { mean, largest, sum };  // mean: weighted by the number of frames

// The combination of one figure over the ranking sets of samples.
enum class OverSets : std::uint8_t { largest, mean };  // mean: weighted by the number of samples per frame

template <class Record>
using Number = std::optional<double> (*)(const Record& record);

// A figure that is compared exactly: a quotient of two counts. null whole: the count itself.
template <class Record>
struct Share {
  Number<Record> count = nullptr, whole = nullptr;
};

// Frame and cell of the largest value; null: unknown.
template <class Record>
struct Place {
  Number<Record> frame = nullptr;
  const CellIndex* (*cell)(const Record& record) = nullptr;
};

// For a figure of samples. A budget can use one set: "opaque.unlit".
struct AtSamples {
  Share<SampleSet> share = {};
  OverSets over = OverSets::largest;
  bool is_of_needed = false;  // no value for a set whose samples need no light
  Number<SampleSet> worst_frame = nullptr;
};

struct Figure {
  std::string_view name;  // in budgets, `recommend` and `list figures`
  std::string_view unit;  // of the recorded number: "ns", "bytes", "pairs", "ratio" ...
  std::string_view meaning;
  Better better = Better::smaller;
  Basis basis = Basis::count;

  // The number in a result; for a figure of samples, that of random points in the view. Exports use it with this unit.
  Number<Case> recorded = nullptr;
  const Interval* (*interval)(const Case& result_case) = nullptr;  // 95 %, of the recorded number; null: none
  double dividend = 0.0;                                           // if not 0, the figure is dividend / recorded
  bool is_in_us = false;                                           // the named figure is in microseconds
  Share<Case> share = {};                                          // used for budgets if a case has the counts
  AtSamples samples = {};                                          // the same for each set
  Place<Case> worst = {};
  std::string_view none = {};  // possible reason for a missing value, in parentheses

  // `recommend`.
  bool is_choosable = false;      // depends on grid, method or structure
  bool is_modelled_cost = false;  // computed by the cost model
  bool only_grows = false;        // never decreases with more frames
  OverCameras over_cameras = OverCameras::mean;

  // Exports and histories; these names are stable.
  std::string_view export_name = {};  // "": `name`
  bool is_headline = false;           // exported by default
  bool is_kept = false;               // in histories, with the headline; derived times are in none
  bool is_of_device = false;          // exported where a device is timed; histories tell devices apart by it

  std::string_view exported_as() const { return export_name.empty() ? name : export_name; }
  std::string_view named_unit() const { return is_in_us ? "us" : unit; }
  bool is_exported() const { return recorded != nullptr; }
  bool is_at_samples() const { return samples.share.count != nullptr; }
  bool rests_on_times() const { return basis == Basis::time || basis == Basis::derived; }
};

// Headline figures first, then the others. Columns of exports have this order, so a new figure is the last of its part.
std::span<const Figure> figures();
const Figure* find_figure(std::string_view name);  // null for an unknown name

}  // namespace clusterbench::result
