#include "search/halving.h"

#include <algorithm>
#include <numeric>

namespace clusterbench::search {
namespace {

bool is_apart(const HalvingRequest& request, std::size_t candidate) {
  return candidate < request.apart.size() && request.apart[candidate];
}

std::size_t count_apart(const HalvingRequest& request, std::span<const std::size_t> candidates) {
  return static_cast<std::size_t>(
      std::ranges::count_if(candidates, [&](std::size_t candidate) { return is_apart(request, candidate); }));
}

// The better candidates of those that are not out, among either the separate candidates or the others.
std::vector<std::size_t> better_share(const HalvingRequest& request, std::span<const std::size_t> candidates,
                                      std::span<const Standing> standings, bool of_those_apart, std::size_t wanted) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (!standings[i].is_out && is_apart(request, candidates[i]) == of_those_apart) order.push_back(i);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    if (standings[a].rank != standings[b].rank) return standings[a].rank < standings[b].rank;
    return candidates[a] < candidates[b];
  });
  order.resize(std::min(order.size(), wanted));
  for (std::size_t& index : order) index = candidates[index];
  return order;
}

}  // namespace

Halving halve(const HalvingRequest& request, const Score& score) {
  Halving found;
  std::vector<std::size_t> alive(request.candidates);
  std::iota(alive.begin(), alive.end(), std::size_t{0});
  std::size_t frames = std::min(request.first_frames, request.frames);
  while (!alive.empty()) {
    const std::vector<Standing> standings = score(alive, frames);
    const std::size_t together = alive.size() - count_apart(request, alive);
    const std::size_t wanted = std::max(request.least, (together + request.keep_one_in - 1) / request.keep_one_in);
    std::vector<std::size_t> kept = better_share(request, alive, standings, false, wanted);
    const std::vector<std::size_t> beside = better_share(request, alive, standings, true, request.apart_kept);
    kept.insert(kept.end(), beside.begin(), beside.end());
    const auto out = static_cast<std::size_t>(std::ranges::count_if(standings, &Standing::is_out));
    found.rungs.push_back({frames, alive.size(), out, kept.size()});
    alive = std::move(kept);
    frames *= request.growth;
    if (frames >= request.frames || alive.size() - count_apart(request, alive) <= request.least) break;
  }
  found.finalists = std::move(alive);
  return found;
}

std::vector<std::size_t> spread_order(std::size_t count, std::size_t first) {
  std::vector<std::size_t> order;
  if (count == 0) return order;
  order.push_back(first);
  std::size_t power = 1;
  while (power < count) power *= 2;
  for (std::size_t i = 0; i < power; ++i) {
    std::size_t reversed = 0;
    for (std::size_t bit = 1; bit < power; bit *= 2) reversed = 2 * reversed + ((i & bit) != 0 ? 1 : 0);
    if (reversed < count && reversed != first) order.push_back(reversed);
  }
  return order;
}

}  // namespace clusterbench::search
