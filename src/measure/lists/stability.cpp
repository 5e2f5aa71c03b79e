#include "measure/lists/stability.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "measure/truth/list_errors.h"

namespace clusterbench::measure {

double Churn::mean_changes() const {
  return steps == 0 ? 0.0 : static_cast<double>(changes) / steps;
}

double excess_ratio(std::uint64_t method, std::uint64_t truth) {
  return ratio_to_true(static_cast<double>(method) - static_cast<double>(truth), truth);
}

void ChurnMeter::add(const assign::Lists& lists) {
  if (has_begun_ && lists.cell_count() != last_.cell_count()) {
    add_new_grid(lists);
  } else if (has_begun_) {
    Pairs changed = changed_from_last(lists);
    ++churn_.steps;
    churn_.changes += changed.size();
    churn_.most_changes = std::max<std::uint64_t>(churn_.most_changes, changed.size());
    for (const std::uint64_t pair : changed) churn_.flickers += has_changed_lately(pair) ? 1 : 0;
    recent_changes_.push_back(std::move(changed));
    if (recent_changes_.size() > window_) recent_changes_.pop_front();
  }
  has_begun_ = true;
  last_ = lists;
}

void ChurnMeter::add_new_grid(const assign::Lists& lists) {
  const std::uint64_t changes = std::uint64_t{last_.pair_count()} + lists.pair_count();
  ++churn_.steps;
  churn_.changes += changes;
  churn_.most_changes = std::max(churn_.most_changes, changes);
  recent_changes_.clear();
}

ChurnMeter::Pairs ChurnMeter::changed_from_last(const assign::Lists& lists) const {
  assert(lists.cell_count() == last_.cell_count());
  Pairs changed;
  std::vector<std::uint32_t> lights;
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    const auto before = last_.of(cell), now = lists.of(cell);
    lights.clear();
    std::set_symmetric_difference(before.begin(), before.end(), now.begin(), now.end(), std::back_inserter(lights));
    for (const std::uint32_t light : lights) changed.push_back(std::uint64_t{cell} << 32 | light);
  }
  return changed;
}

bool ChurnMeter::has_changed_lately(std::uint64_t pair) const {
  return std::any_of(recent_changes_.begin(), recent_changes_.end(),
                     [&](const Pairs& step) { return std::binary_search(step.begin(), step.end(), pair); });
}

}  // namespace clusterbench::measure
