#pragma once
// A case beside the same case without something: a grid that follows or reacts, a storage whose room ends.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "assign/contract/lists.h"

namespace clusterbench::run {

// Smallest, mean and largest of one number per frame.
struct Extremes {
  double least = std::numeric_limits<double>::infinity(), sum = 0.0,
         greatest = -std::numeric_limits<double>::infinity();
  int count = 0;

  void add(double value);
  double mean() const { return sum / count; }
};

// Lists that hold other lights than the same cell's in the frame before; all, where the grid has more or fewer cells
// than there.
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

// What samples of one set found.
struct EvaluatedLights {
  std::string set;
  std::uint64_t evaluated = 0, missed = 0;
};

// What of a case is compared.
struct CaseSide {
  std::optional<double> pairs_mean;                          // with cells
  std::optional<std::uint64_t> true_pairs, false_positives;  // with cells, where accuracy is checked
  std::optional<ListChanges> list_changes;                   // with cells
  std::uint64_t index_entries = 0, bytes = 0;                // high water
  std::vector<EvaluatedLights> evaluated;                    // where samples are asked for
};

}  // namespace clusterbench::run
