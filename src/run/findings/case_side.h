#pragma once
// A case beside the same case without one feature: a grid that follows or reacts, a storage with limited room.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "assign/contract/lists.h"

namespace clusterbench::run {

// Smallest, mean and largest value of a number per frame.
struct Extremes {
  double least = std::numeric_limits<double>::infinity(), sum = 0.0,
         greatest = -std::numeric_limits<double>::infinity();
  int count = 0;

  void add(double value);
  double mean() const { return sum / count; }
};

// Lists whose lights differ from those of the same cell in the previous frame; all lists, if the number of cells has
// changed.
struct ListChanges {
  std::uint64_t lists = 0, changed = 0;  // over all steps

  double share() const { return static_cast<double>(changed) / static_cast<double>(lists); }
};

class ListChangeMeter {
 public:
  void add(const assign::Lists& lists);
  const ListChanges& result() const { return changes_; }

 private:
  assign::Lists before_;
  bool has_before_ = false;
  ListChanges changes_;
};

// Counts at the samples of one set.
struct EvaluatedLights {
  std::string set;
  std::uint64_t evaluated = 0, missed = 0;
};

// The compared figures of a case.
struct CaseSide {
  std::optional<double> pairs_mean;                          // with cells
  std::optional<std::uint64_t> true_pairs, false_positives;  // with cells, where accuracy is checked
  std::optional<ListChanges> list_changes;                   // with cells
  std::uint64_t index_entries = 0, bytes = 0;                // high water
  std::vector<EvaluatedLights> evaluated;                    // if samples are requested
};

}  // namespace clusterbench::run
