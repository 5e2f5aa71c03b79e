#include "measure/truth/list_errors.h"

#include <algorithm>
#include <limits>

namespace clusterbench::measure {
namespace {

void add_miss(ErrorCounts& counts, const view::Frame& frame, double distance, std::uint32_t cell, std::uint32_t light) {
  ++counts.false_negatives;
  const double depth = 1.0 - distance;
  if (counts.deepest && depth <= counts.deepest->depth) return;
  counts.deepest = Miss{frame.index, cell, light, frame.lights[light].rig_index, depth};
  counts.deepest_miss = depth;
}

// A bound for the next distance: if thousands of lights are missed, only the few that are deeper than all before need
// theirs computed.
double least_distance(const ErrorCounts& counts) {
  return counts.deepest ? 1.0 - counts.deepest->depth : 1.0;
}

// distance(cell, light, below): distance of a cell from a light, in ranges of the light; 1 if it is not below `below`.
template <class Distance>
void add_pairs(ErrorCounts& counts, const view::Frame& frame, const Truth& truth, const assign::Lists& reported,
               Distance&& distance) {
  for (std::uint32_t cell = 0; cell < truth.lists.cell_count(); ++cell) {
    const auto wanted = truth.lists.of(cell), listed = reported.of(cell);
    std::size_t next = 0, found = 0;
    for (const std::uint32_t light : wanted) {
      while (next < listed.size() && listed[next] < light) ++next;
      if (next < listed.size() && listed[next] == light)
        ++found;
      else
        add_miss(counts, frame, distance(cell, light, least_distance(counts)), cell, light);
    }
    counts.false_positives += listed.size() - found;
  }
  counts.true_pairs += truth.lists.pair_count();
  counts.reported_pairs += reported.pair_count();
  counts.filter_decided += truth.filter_decided;
  counts.exact_decided += truth.exact_decided;
  counts.undecided += truth.undecided;
  ++counts.frames_checked;
}

}  // namespace

double ratio_to_true(double excess, std::uint64_t true_count) {
  if (excess == 0.0) return 0.0;
  if (true_count == 0) return std::numeric_limits<double>::quiet_NaN();
  return excess / static_cast<double>(true_count);
}

double ErrorCounts::excess_ratio() const {
  return ratio_to_true(static_cast<double>(false_positives), true_pairs);
}
double ErrorCounts::miss_ratio() const {
  return ratio_to_true(static_cast<double>(false_negatives), true_pairs);
}

void add_frame(ErrorCounts& counts, const view::Frame& frame, const grid::Grid& grid, const Truth& truth,
               const assign::Lists& reported) {
  add_pairs(counts, frame, truth, reported, [&](std::uint32_t cell, std::uint32_t light, double below) {
    return relative_distance(frame, grid, cell, light, below);
  });
}

void add_frame(ErrorCounts& counts, const view::Frame& frame, const grid::OccupiedCells& cells, const Truth& truth,
               const assign::Lists& reported) {
  add_pairs(counts, frame, truth, reported, [&](std::uint32_t cell, std::uint32_t light, double below) {
    double least = 1.0;
    for (const geom::FrustumCell& part : cells.of(cell))
      least = std::min(least, relative_distance(view::volume_of(frame.lights[light], frame.view_space), part,
                                                std::min(least, below)));
    return least;
  });
}

}  // namespace clusterbench::measure
