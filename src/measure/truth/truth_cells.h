#pragma once
// Cells of any kind for the computation of the truth: candidates, then a filter and a decision for each of them.

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

// Const, so that threads can share it.
class TruthCells {
 public:
  virtual ~TruthCells() = default;

  virtual std::uint32_t cell_count() const = 0;
  // The space of the cells.
  virtual const view::Space& space() const = 0;
  // All cells, as one row.
  virtual grid::CellRow all() const { return {0, {0, static_cast<int>(cell_count()) - 1}, {}}; }
  // The accelerator: adds the cells that a light with a finite range may touch. Default: all.
  virtual void append_candidates(const grid::BallInSpace&, std::vector<grid::CellRow>& rows) const {
    rows.push_back(all());
  }
  // Decides the candidates in one column of a row; `first_cell`: the cell of its slice 0.
  virtual void decide(std::uint32_t first_cell, const grid::IndexRange& slices, LightSearch& search) const = 0;
};

// For a cell of several parts: yes if one part is met, uncertain if one may be met and none is for certain. meets(part)
// filters and decides.
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

// The cells of a grid; and the occupied cells of a frustum grid. All arguments must outlive the result.
std::unique_ptr<TruthCells> truth_cells(const view::Frame& frame, const grid::Grid& grid);
std::unique_ptr<TruthCells> truth_cells(const view::Frame& frame, const grid::Grid& grid,
                                        const grid::OccupiedCells& occupied);

}  // namespace clusterbench::measure
