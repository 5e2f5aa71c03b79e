#pragma once
// Random numbers for tests of statistics.

#include "core/random.h"

namespace clusterbench::measure {

// Normal, by the sum of twelve uniform numbers.
inline double normal(SplitMix64& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random.unit();
  return sum;
}

}  // namespace clusterbench::measure
