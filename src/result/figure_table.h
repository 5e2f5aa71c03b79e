#pragma once
// Every figure of a case, one row each: budgets, exports, tables, `recommend`, `history`, `compare` and `list figures`
// read it. A new figure is one row in figure_table.cpp.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "result/case.h"

namespace clusterbench::result {

enum class Better : std::uint8_t { smaller, bigger, neither };
const char* name_of(Better better);  // "smaller", "bigger", "neither"

// What a figure rests on.
enum class Basis : std::uint8_t {
  count,         // of lists, buffers and errors: the same on every machine, and every time
  instructions,  // nearly the same every time; of a compiler and an instruction set
  time,          // of a machine, and noisy
  derived        // follows from times
};
const char* name_of(Basis basis);  // "counts", "instructions", "measured times", "derived times"

// How the figures of several cameras become one.
enum class OverCameras : std::uint8_t { mean, largest, sum };  // mean: by the number of frames

// How the figures of the sets of samples that rank become one.
enum class OverSets : std::uint8_t { largest, mean };  // mean: weighted by how many samples a frame shades

template <class Record>
using Number = std::optional<double> (*)(const Record& record);

// A figure that is decided exactly: a quotient of two counts. null whole: the count itself.
template <class Record>
struct Share {
  Number<Record> count = nullptr, whole = nullptr;
};

// Frame and cell where a figure is largest; null: it has no such place.
template <class Record>
struct Place {
  Number<Record> frame = nullptr;
  const CellIndex* (*cell)(const Record& record) = nullptr;
};

// Of a figure of samples, which a budget can ask of one set: "opaque.unlit".
struct AtSamples {
  Share<SampleSet> share = {};
  OverSets over = OverSets::largest;
  bool is_of_needed = false;  // a set whose samples need no light has none
  Number<SampleSet> worst_frame = nullptr;
};

struct Figure {
  std::string_view name;  // in budgets, `recommend` and `list figures`
  std::string_view unit;  // of the recorded number: "ns", "bytes", "pairs", "ratio" ...
  std::string_view meaning;
  Better better = Better::smaller;
  Basis basis = Basis::count;

  // The number that a result has; of samples that of random points in the view. Exports have it with this unit.
  Number<Case> recorded = nullptr;
  const Interval* (*interval)(const Case& result_case) = nullptr;  // 95 %, of the recorded number; null: it has none
  double dividend = 0.0;   // the figure is dividend / recorded where this is not 0
  bool is_in_us = false;   // under its name it is in microseconds
  Share<Case> share = {};  // decides budgets where a case has both
  AtSamples samples = {};  // likewise, of each set
  Place<Case> worst = {};
  std::string_view none = "";  // why a case may have none, in parentheses

  // `recommend`.
  bool is_choosable = false;      // grids, methods and structures differ in it
  bool is_modelled_cost = false;  // of the cost model
  bool only_grows = false;        // with further frames
  OverCameras over_cameras = OverCameras::mean;

  // Exports and histories; names there are stable.
  std::string_view export_name = "";  // "": the same
  bool is_headline = false;           // exported unless all figures are asked for
  bool is_kept = false;               // in histories, beside the headline

  std::string_view exported_as() const { return export_name.empty() ? name : export_name; }
  std::string_view named_unit() const { return is_in_us ? "us" : unit; }
  bool is_exported() const { return recorded != nullptr; }
  bool is_at_samples() const { return samples.share.count != nullptr; }
  bool rests_on_times() const { return basis == Basis::time || basis == Basis::derived; }
};

// The headline first, else in the order of a result.
std::span<const Figure> figures();
const Figure* find_figure(std::string_view name);  // null: there is none of this name

}  // namespace clusterbench::result
