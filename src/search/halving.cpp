#include "search/halving.h"

#include <algorithm>
#include <numeric>

namespace clusterbench::search {
namespace {

// The better share of those that are not out.
std::vector<std::size_t> better_share(std::span<const std::size_t> candidates, std::span<const Standing> standings,
                                      std::size_t wanted) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (!standings[i].is_out) order.push_back(i);
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
    const std::size_t wanted = std::max(request.least, (alive.size() + request.keep_one_in - 1) / request.keep_one_in);
    std::vector<std::size_t> kept = better_share(alive, standings, wanted);
    const auto out = static_cast<std::size_t>(std::ranges::count_if(standings, &Standing::is_out));
    found.rungs.push_back({frames, alive.size(), out, kept.size()});
    alive = std::move(kept);
    frames *= request.growth;
    if (frames >= request.frames || alive.size() <= request.least) break;
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
