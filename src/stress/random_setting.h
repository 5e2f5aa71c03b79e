#pragma once
// A setting of the random search (`stress --random`): camera, picture, grid and lights, all from one seed. Half of the
// lights lie against a cell, to a few ulps, or on a lattice, since that is where decisions are close.

#include <cstdint>

#include "core/random.h"
#include "stress/trial.h"

namespace clusterbench::stress {

// The grid may be one that is refused for its camera.
Trial random_setting(std::uint64_t seed);

// Random numbers for settings.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  SplitMix64& random() { return random_; }
  // True in `of` of a hundred draws.
  bool percent(std::uint64_t of) { return random_.below(100) < of; }
  int whole(int least, int most);
  double between(double lo, double hi) { return random_.between(lo, hi); }
  double log_between(double lo, double hi);
  double sign() { return random_.below(2) == 0 ? -1.0 : 1.0; }
  // 1 plus or minus a number between these.
  double about_one(double least, double most);
  // -most to most ulps away.
  double nudged(double value, int most_ulps);
  template <class Value, std::size_t Count>
  Value one_of(const Value (&values)[Count]) {
    return values[random_.below(Count)];
  }

 private:
  SplitMix64 random_;
};

}  // namespace clusterbench::stress
