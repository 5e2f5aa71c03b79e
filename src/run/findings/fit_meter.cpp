#include "run/findings/fit_meter.h"

#include <cmath>

namespace clusterbench::run {

void GridMoveMeter::add(const grid::ScreenGrid& grid, const grid::Span& needed) {
  const std::vector<float>& now = grid.slices.boundaries;
  if (!needed.is_empty()) moves_.near_m.add(static_cast<double>(now[near_boundary_]));
  moves_.far_m.add(static_cast<double>(now.back()));
  if (!before_.empty()) {
    ++moves_.steps;
    moves_.changed += before_ == now ? 0 : 1;
    int changed = 0;
    for (std::size_t i = 1; i < now.size(); ++i) {
      changed += before_[i - 1] == now[i - 1] && before_[i] == now[i] ? 0 : 1;
      const double thickness = static_cast<double>(before_[i]) - static_cast<double>(before_[i - 1]);
      moves_.moved.add(std::abs(static_cast<double>(now[i]) - static_cast<double>(before_[i])) / thickness);
    }
    moves_.cells_changed += static_cast<double>(changed) / static_cast<double>(now.size() - 1);
  }
  before_ = now;
}

config::Config without_fit(const config::Config& config, std::size_t grid) {
  config::Config out = config;
  out.grids[grid] = out.grids[grid].unfitted();
  return out;
}

}  // namespace clusterbench::run
