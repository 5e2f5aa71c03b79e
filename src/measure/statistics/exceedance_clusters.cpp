#include "measure/statistics/exceedance_clusters.h"

#include <algorithm>
#include <cmath>

namespace clusterbench::measure {
namespace {

// Distances in entries between consecutive entries above the threshold, per path.
std::vector<std::uint64_t> distances_above(std::span<const PathNeeds> paths, std::uint64_t threshold) {
  std::vector<std::uint64_t> distances;
  for (const PathNeeds& path : paths) {
    std::size_t last = path.needs.size();
    for (std::size_t i = 0; i < path.needs.size(); ++i) {
      if (path.needs[i] <= threshold) continue;
      if (last < path.needs.size()) distances.push_back(i - last);
      last = i;
    }
  }
  return distances;
}

// Equation 3 of the source; at least one distance must be above 2.
double intervals_estimator(const std::vector<std::uint64_t>& distances) {
  double sum = 0.0, squares = 0.0;
  for (const std::uint64_t distance : distances) {
    const auto d = static_cast<double>(distance);
    sum += d - 1.0;
    squares += (d - 1.0) * (d - 2.0);
  }
  return std::min(1.0, 2.0 * sum * sum / (static_cast<double>(distances.size()) * squares));
}

// Section 3 of the source: the largest distances, a share of `index`, are between clusters. Equal distances are treated
// alike, as within a cluster. Direct neighbours are always in one cluster: a path with a single hill has no other
// distances, and would otherwise give one peak per entry.
std::uint64_t run_of(std::vector<std::uint64_t> distances, double index) {
  std::ranges::sort(distances, std::greater<>());
  const auto between = static_cast<std::size_t>(std::floor(index * static_cast<double>(distances.size())));
  return between < distances.size() ? std::max<std::uint64_t>(distances[between], 1) : 1;
}

void add_peaks(const PathNeeds& path, std::uint64_t threshold, std::uint64_t run, std::vector<Peak>& peaks) {
  const std::size_t count = path.needs.size();
  std::size_t last = count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t need = path.needs[i];
    if (need <= threshold) continue;
    if (last == count || i - last > run) peaks.emplace_back();
    last = i;
    Peak& peak = peaks.back();
    ++peak.entries_above;
    peak.frames_above += path.frames_per_entry;
    if (need < peak.height) continue;
    // If several entries have the largest need, one inside the path shows that the peak was complete.
    const bool is_end = i == 0 || i + 1 == count;
    peak.is_cut = is_end && (need > peak.height || peak.is_cut);
    peak.height = need;
  }
}

}  // namespace

Clusters clusters_above(std::span<const PathNeeds> paths, std::uint64_t threshold) {
  Clusters clusters;
  std::vector<std::uint64_t> distances = distances_above(paths, threshold);
  const bool has_long = std::ranges::any_of(distances, [](std::uint64_t distance) { return distance > 2; });
  if (has_long) clusters.extremal_index = intervals_estimator(distances);
  clusters.run = has_long ? run_of(std::move(distances), clusters.extremal_index) : 2;
  for (const PathNeeds& path : paths) add_peaks(path, threshold, clusters.run, clusters.peaks);
  if (has_long || clusters.peaks.empty()) return clusters;
  // One hill per path, with gaps of at most one entry: the estimator, which assumes long gaps, would return 1.
  std::uint64_t above = 0;
  for (const Peak& peak : clusters.peaks) above += peak.entries_above;
  clusters.extremal_index = static_cast<double>(clusters.peaks.size()) / static_cast<double>(above);
  return clusters;
}

}  // namespace clusterbench::measure
