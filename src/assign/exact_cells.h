#pragma once
// What the exact assigners share: single cells decided from the scene's own numbers, and intervals narrowed to the
// cells that are touched.

#include <optional>

#include "geom/meets.h"
#include "grid/grid.h"
#include "grid/index_range.h"
#include "view/frame.h"

namespace clusterbench::assign {

// Decides cells of one light. Made for every light, and cheap until the first question.
class CellJudge {
 public:
  CellJudge(const grid::Grid& grid, const view::LightArrays& lights, std::uint32_t light)
      : grid_(grid), lights_(lights), light_(light) {}

  bool touches(std::uint32_t cell) {
    if (!filter_) {
      volume_ = lights_.volume(light_);
      filter_.emplace(volume_);
    }
    const geom::Cell shape = grid_.cell(cell);
    geom::Verdict verdict = filter_->meets(shape);
    if (verdict == geom::Verdict::open) verdict = geom::decide_meets(volume_, shape);
    return verdict != geom::Verdict::no;
  }

 private:
  const grid::Grid& grid_;
  const view::LightArrays& lights_;
  std::uint32_t light_;
  geom::LightVolume volume_;
  std::optional<geom::LightFilter> filter_;
};

// The cells of a range without those at its ends that misses(column) says are not touched. All cells between two
// touched ones are, so only the ends are asked.
template <class Misses>
grid::IndexRange narrowed(grid::IndexRange range, Misses&& misses) {
  while (!range.empty() && misses(range.first)) ++range.first;
  while (range.last > range.first && misses(range.last)) --range.last;
  return range;
}

}  // namespace clusterbench::assign
