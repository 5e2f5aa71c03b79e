#include "search/frames_in_turn.h"

#include <algorithm>

namespace clusterbench::search {

int FramesInTurn::rated() const {
  return static_cast<int>(std::ranges::count_if(values_, [](const auto& value) { return value.has_value(); }));
}

double FramesInTurn::sum() const {
  double sum = 0.0;
  for (const std::optional<double>& value : values_) sum += value.value_or(0.0);
  return sum;
}

void FramesInTurn::add_to(BestFrames& best) const {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (!values_[i] || !best.can_enter(*values_[i])) continue;
    RatedFrame frame = frame_of_(static_cast<int>(i));
    frame.value = *values_[i];
    best.add(frame);
  }
}

}  // namespace clusterbench::search
