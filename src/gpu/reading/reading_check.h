#pragma once
// Do the shaders walk the lights that the structure has on the host, sample for sample? And do they find its cells?

#include <cstdint>
#include <string>

#include "gpu/reading/reading.h"

namespace clusterbench::gpu {

struct ReadingCheck {
  std::uint64_t samples = 0;    // compared ones
  std::uint64_t lights = 0;     // walked at them
  std::uint64_t differing = 0;  // samples whose number of lights, or hash of their indices, is not that of lights_at()
  std::string first;            // such a sample, as a sentence; "" if there is none
};

// The lookup is the host's (grid::Log2::rounded), so that every sample can be compared.
ReadingCheck check_walk(ReadingStructure& structure, ReadingSamples& samples, Walking walking);
// The lookup is the device's, as in timed readings. Samples for which it finds another cell than the host are left out:
// check_lookup() is about them.
ReadingCheck check_own_lookup(ReadingStructure& structure, ReadingSamples& samples, Walking walking);

struct LookupDifferences {
  std::uint64_t samples = 0;
  std::uint64_t differing = 0;    // found another cell than the host
  std::uint64_t unexplained = 0;  // of those, by more than the device's logarithm, root and divisions may be off
  std::string first;              // an unexplained one, as a sentence; "" if there is none
};
LookupDifferences check_lookup(ReadingStructure& structure, ReadingSamples& samples);

}  // namespace clusterbench::gpu
