#pragma once
// Empties the caches before a cold measurement: in an engine the rest of the frame has used them since the last
// assignment. The method is that of NVBench's cold measurements: write through more memory than the last cache level
// holds.

#include <cstddef>
#include <cstdint>
#include <optional>

namespace clusterbench::run {

// `wanted_mib` (timing.sweep_mib), or a quarter more than the sum of all cache levels of this machine; 64 MiB if they
// are unknown. At most 256 MiB: at 15 GB/s a core writes no more in a frame of 60 Hz, so an engine empties no larger
// cache either.
std::uint64_t sweep_bytes(std::optional<int> wanted_mib);

// Writes every line of so many bytes. Caches of other cores stay as they are, except for a shared level. The memory is
// kept for the process's next sweep, since getting it takes longer than writing it. For one thread at a time.
void sweep_caches(std::uint64_t bytes);

// Number of cold passes, at least one, out of `rounds` passes over `frames` frames: as many as keep the total sweep
// time below a fixed limit. It is the same on all machines with the same caches, so all launches and methods have the
// same number.
int cold_rounds(int rounds, std::size_t frames, std::uint64_t bytes);

}  // namespace clusterbench::run
