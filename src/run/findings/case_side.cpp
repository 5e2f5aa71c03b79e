#include "run/findings/case_side.h"

#include <algorithm>

namespace clusterbench::run {

void Extremes::add(double value) {
  least = std::min(least, value);
  greatest = std::max(greatest, value);
  sum += value;
  ++count;
}

void ListChangeMeter::add(const assign::Lists& lists) {
  if (has_before_) {
    const bool has_other_cells = lists.cell_count() != before_.cell_count();
    changes_.lists += lists.cell_count();
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
      changes_.changed += has_other_cells || !std::ranges::equal(lists.of(cell), before_.of(cell)) ? 1 : 0;
  }
  before_ = lists;
  has_before_ = true;
}

}  // namespace clusterbench::run
