#pragma once
// Cells of any kind, as the truth asks them: candidate cells, then for each of them a filter and a decision.

#include <cstdint>
#include <memory>
#include <vector>

#include "geom/shapes/ball_and_cone.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/verdict.h"
#include "grid/broad_phase.h"
#include "grid/grid.h"
#include "grid/occupied_cells.h"
#include "measure/truth/light_search.h"
#include "view/frame.h"

namespace clusterbench::measure {

// Const, so that threads can share them.
class TruthCells {
 public:
  virtual ~TruthCells() = default;

  virtual std::uint32_t cell_count() const = 0;
  // In which the cells are.
  virtual const view::Space& space() const = 0;
  // All cells, as one row.
  virtual grid::CellRow all() const { return {0, {0, static_cast<int>(cell_count()) - 1}, {}}; }
  // The accelerator: those that a light with an end may touch. Without one: all.
  virtual void append_candidates(const grid::BallInSpace&, std::vector<grid::CellRow>& rows) const {
    rows.push_back(all());
  }
  // Settles the candidates in a row's column; `first_cell` is that of its slice 0.
  virtual void settle(std::uint32_t first_cell, const grid::IndexRange& slices, LightSearch& search) const = 0;
};

// Of a cell of several parts: yes if one of them is met, uncertain if one may be and none is known to be.
// meets(part) filters and decides.
template <class Parts, class Meets>
geom::Verdict meets_any(const Parts& parts, Meets&& meets) {
  geom::Verdict verdict = geom::Verdict::no;
  for (const auto& part : parts) {
    const geom::Verdict now = meets(part);
    if (now == geom::Verdict::yes) return now;
    if (now == geom::Verdict::uncertain) verdict = now;
  }
  return verdict;
}

// The cells of a grid; and what depths leave of a frustum grid's. All that they are made of must outlive them.
std::unique_ptr<TruthCells> truth_cells(const view::Frame& frame, const grid::Grid& grid);
std::unique_ptr<TruthCells> truth_cells(const view::Frame& frame, const grid::Grid& grid,
                                        const grid::OccupiedCells& occupied);

}  // namespace clusterbench::measure
