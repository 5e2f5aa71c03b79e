#include "measure/lists/path_series.h"

#include <algorithm>

namespace clusterbench::measure {

void PathSeries::add_frame(std::uint64_t value) {
  if (!entries_.empty() && frames_in_last_ < frames_per_entry_) {
    entries_.back() = std::max(entries_.back(), value);
    ++frames_in_last_;
    return;
  }
  if (entries_.size() == most_entries_) join_neighbours();
  entries_.push_back(value);
  frames_in_last_ = 1;
}

// Precondition: the entries are full and their number is even.
void PathSeries::join_neighbours() {
  for (std::size_t i = 0; i < entries_.size() / 2; ++i) entries_[i] = std::max(entries_[2 * i], entries_[2 * i + 1]);
  entries_.resize(entries_.size() / 2);
  frames_per_entry_ *= 2;
}

}  // namespace clusterbench::measure
