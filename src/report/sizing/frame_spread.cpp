#include "report/sizing/frame_spread.h"

#include <algorithm>
#include <cmath>

namespace clusterbench::report {
namespace {

// A value, and the number of frames with it.
struct Weighed {
  std::uint64_t value, frames;
};

std::uint64_t at_rank(const std::vector<Weighed>& ascending, double share, double frames) {
  const double rank = std::ceil(share * frames);
  double counted = 0.0;
  for (const Weighed& weighed : ascending) {
    counted += static_cast<double>(weighed.frames);
    if (counted >= rank) return weighed.value;
  }
  return ascending.back().value;
}

}  // namespace

std::optional<FrameSpread> spread_of(const std::vector<PathNeed>& paths) {
  std::vector<Weighed> all;
  double frames = 0.0;
  FrameSpread spread;
  for (const PathNeed& path : paths) {
    if (path.frames_per_entry != 1 && path.elements.size() > 1) spread.is_exact = false;
    for (const std::uint64_t value : path.elements) {
      all.push_back({value, path.frames_per_entry});
      frames += static_cast<double>(path.frames_per_entry);
    }
  }
  if (all.empty()) return {};
  std::ranges::sort(all, {}, &Weighed::value);
  spread.min = all.front().value;
  spread.max = all.back().value;
  spread.p50 = at_rank(all, 0.5, frames);
  spread.p90 = at_rank(all, 0.9, frames);
  spread.p99 = at_rank(all, 0.99, frames);
  return spread;
}

std::vector<Growth> growth_of(const std::vector<PathNeed>& paths) {
  std::size_t longest = 0;
  for (const PathNeed& path : paths) {
    if (path.elements.empty() || (path.frames_per_entry > 1 && path.elements.size() > 1)) return {};
    longest = std::max(longest, path.elements.size());
  }
  std::vector<Growth> out;
  if (longest <= 8) return out;
  for (const int every : {8, 4, 2, 1}) {
    std::uint64_t most = 0;
    for (const PathNeed& path : paths)
      for (std::size_t i = 0; i < path.elements.size(); i += static_cast<std::size_t>(every))
        most = std::max(most, path.elements[i]);
    out.push_back({every, most});
  }
  return out;
}

}  // namespace clusterbench::report
