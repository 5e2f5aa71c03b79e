#pragma once
// Empties the caches before a cold measurement: in an engine the rest of the frame has used them since the last
// assignment. The method is that of NVBench's cold measurements: write through more memory than the last cache level
// holds.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace clusterbench::run {

// `wanted_mib` (timing.sweep_mib), or a quarter more than the sum of all cache levels of this machine; 64 MiB if they
// are unknown, at most 1 GiB.
std::uint64_t sweep_bytes(std::optional<int> wanted_mib);

class CacheSweep {
 public:
  explicit CacheSweep(std::uint64_t bytes) : buffer_(bytes) {}

  // Writes every line of the buffer. Caches of other cores stay as they are, except for a shared level.
  void operator()();

 private:
  std::vector<unsigned char> buffer_;
  unsigned char value_ = 0;
};

// Number of cold passes, at least one, out of `rounds` passes over `frames` frames: as many as keep the total sweep
// time below a fixed limit. It is the same on all machines with the same caches, so all launches and methods have the
// same number.
int cold_rounds(int rounds, std::size_t frames, std::uint64_t bytes);

}  // namespace clusterbench::run
