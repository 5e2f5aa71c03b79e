#include "measure/truth/truth.h"

#include <atomic>
#include <cmath>

#include "core/memory.h"
#include "core/parallel.h"
#include "geom/filter/light_filter.h"
#include "measure/truth/truth_cells.h"

namespace clusterbench::measure {
namespace {

// Adds candidates that are touched for certain, and decides the others.
void decide_row(const grid::CellRow& row, const TruthCells& cells, LightSearch& search) {
  const auto first_cell = [&](int column) { return row.first_cell + static_cast<std::uint32_t>(column); };
  const auto decide = [&](int first, int last) {
    for (int column = first; column <= last; ++column) cells.decide(first_cell(column), row.slices, search);
  };
  if (search.is_spot() || search.is_box() || row.inner.empty()) return decide(row.outer.first, row.outer.last);
  decide(row.outer.first, row.inner.first - 1);
  search.add_touched(first_cell(row.inner.first), static_cast<std::uint32_t>(row.inner.count()));
  decide(row.inner.last + 1, row.outer.last);
}

LightCells cells_of_light(const geom::LightVolume& light, const TruthCells& cells) {
  if (geom::range_of(light) == 0.0) return {};
  LightSearch search(light);
  std::vector<grid::CellRow> rows;
  if (search.is_endless())
    rows.push_back(cells.all());
  else
    cells.append_candidates(search.ball(), rows);
  for (const grid::CellRow& row : rows) decide_row(row, cells, search);
  return std::move(search).found();
}

// Of the runs of true cells that were found, and of the pairs in them. Which of the two sums is too large first depends
// on the threads that add to them, and so does its value: the error says neither.
void check_sums(std::uint64_t runs, std::uint64_t pairs) {
  const std::uint64_t most_pairs = memory_limit() / sizeof(std::uint32_t);
  if (runs > memory_limit() / sizeof(LightCells::Run) || pairs > most_pairs)
    check_memory("true pairs", most_pairs + 1, sizeof(std::uint32_t));
}

// Throws Error beyond the limit on memory.
std::vector<LightCells> cells_of_lights(const view::Frame& frame, const TruthCells& cells, int threads) {
  std::vector<LightCells> found(frame.lights.size());
  std::atomic<std::uint64_t> runs = 0, true_pairs = 0;
  parallel_ranges(found.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t light = begin; light < end; ++light) {
      found[light] = cells_of_light(view::volume_of(frame.lights[light], cells.space()), cells);
      std::uint64_t now = 0;
      for (const LightCells::Run& run : found[light].runs) now += run.count;
      check_sums(runs += found[light].runs.size(), true_pairs += now);
    }
  });
  return found;
}

}  // namespace

Truth find_truth(const view::Frame& frame, const TruthCells& cells, int threads) {
  const std::vector<LightCells> found = cells_of_lights(frame, cells, threads);
  Truth truth;
  assign::PairBuffer pairs;
  pairs.start(cells.cell_count());
  for (std::uint32_t light = 0; light < found.size(); ++light) {
    for (const LightCells::Run& run : found[light].runs) pairs.add_row(run.first_cell, run.count, light);
    truth.filter_decided += found[light].filter_decided;
    truth.exact_decided += found[light].exact_decided;
    truth.undecided += found[light].undecided;
  }
  pairs.finish(truth.lists);
  return truth;
}

Truth find_truth(const view::Frame& frame, const grid::Grid& grid, int threads) {
  return find_truth(frame, *truth_cells(frame, grid), threads);
}

Truth find_truth(const view::Frame& frame, const grid::Grid& grid, const grid::OccupiedCells& cells, int threads) {
  return find_truth(frame, *truth_cells(frame, grid, cells), threads);
}

double relative_distance(const view::Frame& frame, const grid::Grid& grid, std::uint32_t cell, std::uint32_t light,
                         double below) {
  return relative_distance(view::volume_of(frame.lights[light], grid::space_of(grid, frame)), grid.cell(cell), below);
}

double relative_distance(const geom::LightVolume& light, const geom::Cell& cell, double below) {
  const double range = geom::range_of(light);
  if (std::isinf(range)) return 0.0;
  constexpr double k_nothing = 0x1p-39;  // the bisection ends before that
  if (below <= k_nothing) return 1.0;
  if (below < 1.0 && geom::filter_meets(geom::with_range(light, range * below), cell) == geom::Verdict::no) return 1.0;
  double misses = 0.0, meets = 1.0;
  constexpr int k_halvings = 40;
  for (int i = 0; i < k_halvings; ++i) {
    const double middle = 0.5 * (misses + meets);
    (geom::filter_meets(geom::with_range(light, range * middle), cell) == geom::Verdict::no ? misses : meets) = middle;
  }
  return meets;
}

}  // namespace clusterbench::measure
