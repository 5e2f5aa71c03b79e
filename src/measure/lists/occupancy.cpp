#include "measure/lists/occupancy.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace clusterbench::measure {
namespace {

// Index of the nearest-rank percentile among `count` ascending values.
std::uint64_t rank_of(double share, std::uint64_t count) {
  const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count)));
  return std::clamp<std::uint64_t>(rank, 1, count) - 1;
}

}  // namespace

Spread spread_of_histogram(const std::vector<std::uint64_t>& histogram) {
  const std::uint64_t count = std::accumulate(histogram.begin(), histogram.end(), std::uint64_t{0});
  if (count == 0) return {};
  const auto value_at = [&](double share) {
    std::uint64_t left = rank_of(share, count);
    std::size_t value = 0;
    while (left >= histogram[value]) left -= histogram[value++];
    return static_cast<double>(value);
  };
  double sum = 0.0;
  for (std::size_t value = 0; value < histogram.size(); ++value)
    sum += static_cast<double>(value) * static_cast<double>(histogram[value]);
  return {sum / static_cast<double>(count), value_at(0.50), value_at(0.95), value_at(0.99), value_at(1.0)};
}

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const auto at = [&](double share) { return values[rank_of(share, values.size())]; };
  return {sum / static_cast<double>(values.size()), at(0.50), at(0.95), at(0.99), values.back()};
}

void OccupancyMeter::add_frame(int frame, const assign::Lists& lists) {
  std::uint32_t occupied = 0, longest = 0;
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    const std::uint32_t count = lists.begin[cell + 1] - lists.begin[cell];
    if (count == 0) continue;
    ++occupied;
    longest = std::max(longest, count);
    if (count >= histogram_.size()) histogram_.resize(count + std::size_t{1});
    ++histogram_[count];
    if (count <= worst_count_) continue;
    worst_count_ = count;
    worst_frame_ = frame;
    worst_cell_ = cell;
  }
  if (histogram_.empty()) histogram_.resize(1);
  histogram_[0] += real_cells_ - occupied;
  if (pairs_.empty() || lists.pair_count() > most_pairs_) {
    most_pairs_ = lists.pair_count();
    fullest_frame_ = frame;
  }
  pairs_.push_back(lists.pair_count());
  pairs_along_path_.add_frame(lists.pair_count());
  longest_along_path_.add_frame(longest);
  occupied_.push_back(real_cells_ == 0 ? 0.0 : static_cast<double>(occupied) / real_cells_);
}

Occupancy OccupancyMeter::result() const {
  Occupancy out;
  out.pairs = spread_of(pairs_);
  out.lights_per_cell = spread_of_histogram(histogram_);
  out.histogram = histogram_;
  out.occupied_fraction = spread_of(occupied_);
  out.worst_frame = worst_frame_;
  out.worst_cell = worst_cell_;
  out.worst_count = worst_count_;
  out.fullest_frame = fullest_frame_;
  out.pairs_along_path = pairs_along_path_;
  out.longest_along_path = longest_along_path_;
  return out;
}

void LongestBySlice::add_frame(const grid::Grid& grid, const assign::Lists& lists) {
  if (grid.kind() == grid::Kind::world) return;
  const std::vector<float> boundaries = grid.has_tiles() ? grid.screen().slices.boundaries : std::vector<float>{};
  const Vec3i cells = grid.cells();
  if (longest_.empty()) {
    boundaries_ = boundaries;
    longest_.resize(static_cast<std::size_t>(cells.z));
  }
  stay_ = stay_ && boundaries == boundaries_;
  if (!stay_) return;
  const auto cells_of_slice = static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y);
  const std::uint32_t* begin = lists.begin.data();
  for (std::uint32_t& longest : longest_)
    for (const std::uint32_t* const end = begin + cells_of_slice; begin < end; ++begin)
      longest = std::max(longest, begin[1] - begin[0]);
}

std::vector<std::uint32_t> LongestBySlice::result() const {
  return stay_ ? longest_ : std::vector<std::uint32_t>{};
}

Histogram short_histogram(std::vector<std::uint64_t> cells_by_lights) {
  constexpr std::size_t k_most_entries = 256;
  Histogram out{1, std::move(cells_by_lights)};
  while (out.cells.size() > k_most_entries) {
    for (std::size_t i = 0; i < out.cells.size(); ++i)
      if (i % 2 == 0)
        out.cells[i / 2] = out.cells[i];
      else
        out.cells[i / 2] += out.cells[i];
    out.cells.resize((out.cells.size() + 1) / 2);
    out.lights_per_entry *= 2;
  }
  return out;
}

}  // namespace clusterbench::measure
