#pragma once
// How full the cells are, over all frames of a case.

#include <cstdint>
#include <vector>

#include "assign/contract/lists.h"
#include "grid/grid.h"
#include "measure/lists/path_series.h"

namespace clusterbench::measure {

struct Spread {
  double mean = 0.0, p50 = 0.0, p95 = 0.0, p99 = 0.0, max = 0.0;
};
// Nearest-rank percentiles.
Spread spread_of(std::vector<double> values);
// The same for a histogram: entry n is the number of values n.
Spread spread_of_histogram(const std::vector<std::uint64_t>& histogram);

struct Occupancy {
  Spread pairs;                          // per frame
  Spread lights_per_cell;                // all cells of all frames, with empty ones, without holes
  std::vector<std::uint64_t> histogram;  // [n] = cells with n lights
  Spread occupied_fraction;              // per frame: cells with at least one light / cells
  int worst_frame = 0;                   // with the longest list
  std::uint32_t worst_cell = 0;
  std::uint32_t worst_count = 0;
  int fullest_frame = 0;                            // with the most pairs; the first if several
  PathSeries pairs_along_path, longest_along_path;  // longest: the longest list of the frame
  std::vector<std::uint32_t> longest_by_slice;      // LongestBySlice
};

// A histogram of at most 256 bins, each of a power of two of consecutive lengths.
struct Histogram {
  std::uint64_t lights_per_entry = 1;
  std::vector<std::uint64_t> cells;
};
Histogram short_histogram(std::vector<std::uint64_t> cells_by_lights);

class OccupancyMeter {
 public:
  explicit OccupancyMeter(std::uint32_t real_cells) : real_cells_(real_cells) {}  // without holes
  // For the next frames, whose grid has other cells.
  void set_real_cells(std::uint32_t real_cells) { real_cells_ = real_cells; }
  void add_frame(int frame, const assign::Lists& lists);
  Occupancy result() const;

 private:
  std::uint32_t real_cells_;
  std::vector<double> pairs_, occupied_;
  std::vector<std::uint64_t> histogram_;
  int worst_frame_ = 0, fullest_frame_ = 0;
  std::uint32_t worst_cell_ = 0, worst_count_ = 0;
  std::uint64_t most_pairs_ = 0;
  PathSeries pairs_along_path_, longest_along_path_;
};

// The longest list among the cells of each slice, over all frames: shows the number of lights by depth. Empty for a
// world grid, which has no slices, and for slices that move along the path.
class LongestBySlice {
 public:
  void add_frame(const grid::Grid& grid, const assign::Lists& lists);  // `lists`: one per cell of the grid
  std::vector<std::uint32_t> result() const;

 private:
  std::vector<std::uint32_t> longest_;
  std::vector<float> boundaries_;
  bool stay_ = true;
};

}  // namespace clusterbench::measure
