#pragma once
// Successive halving (Jamieson and Talwalkar 2016, algorithm 1) with frames as the budget: all candidates on few
// frames, the better share of them on more frames, and so on. Independent of candidates and frames: both are numbers.

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace clusterbench::search {

// The result of a candidate on some frames.
struct Standing {
  bool is_out = false;  // breaks a constraint for good, whatever further frames bring
  std::array<double, 4>
      rank{};  // smaller is better, the first number first; of equal ranks the smaller index is better
};

// Standings of these candidates, in their order, on the first `frames` frames of the search's order.
using Score = std::function<std::vector<Standing>(std::span<const std::size_t> candidates, std::size_t frames)>;

struct HalvingRequest {
  std::size_t candidates = 0, frames = 0;
  std::size_t first_frames = 1;  // of the first rung
  std::size_t growth = 4;        // factor between the frames of successive rungs
  std::size_t keep_one_in = 24;  // of a rung's candidates
  std::size_t least = 6;         // minimum number of kept candidates, if that many are not out
  // Candidates that compete only among themselves, beside the others: true at their numbers; empty: none. Of these,
  // `apart_kept` are kept from the first rung on.
  std::vector<bool> apart{};
  std::size_t apart_kept = 3;
};

// Candidates that were scored on the same frames.
struct Rung {
  std::size_t frames = 0, candidates = 0, out = 0, kept = 0;
};

struct Halving {
  std::vector<Rung> rungs;
  std::vector<std::size_t> finalists;  // best first, by the last rung; still to be scored on all frames
};

// There is at least one rung; with several, all end before the full number of frames. Deterministic if `score` is.
Halving halve(const HalvingRequest& request, const Score& score);

// Numbers below `count` that begin with `first`, in an order whose every prefix is spread over all of them (van der
// Corput's sequence).
std::vector<std::size_t> spread_order(std::size_t count, std::size_t first);

}  // namespace clusterbench::search
