#pragma once
// Peaks of series along paths: frames above a threshold come in clusters, since neighbouring frames see nearly the
// same. Source: Ferro and Segers 2003, "Inference for clusters of extreme values".

#include <cstdint>
#include <span>
#include <vector>

namespace clusterbench::measure {

// The need of a buffer along one path, in the order of the frames.
struct PathNeeds {
  std::span<const std::uint64_t> needs{};
  std::uint64_t frames_per_entry = 1;  // an entry is the maximum over that many consecutive frames
};

struct Peak {
  std::uint64_t height = 0;         // the largest need of the cluster
  std::uint64_t entries_above = 0;  // how many entries of the cluster are above the threshold
  std::uint64_t frames_above = 0;   // upper bound: an entry of several frames counts all of them
  // The largest need is at the first or last entry of its path: the real peak may be higher and longer.
  bool is_cut = false;
};

struct Clusters {
  std::vector<Peak> peaks;      // path by path, in the order of the frames
  double extremal_index = 1.0;  // in (0, 1]: the inverse of the mean cluster length, in entries, for high thresholds
  std::uint64_t run = 0;        // entries above the threshold with a larger distance are in different clusters
};

// Clusters of the entries above the threshold. The intervals estimator uses the distances between these entries: the
// run length is a result, not a parameter. Two paths never share a cluster.
Clusters clusters_above(std::span<const PathNeeds> paths, std::uint64_t threshold);

}  // namespace clusterbench::measure
