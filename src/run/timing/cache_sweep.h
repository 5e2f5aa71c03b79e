#pragma once
// Empties the caches before something is measured cold: in an engine all else of a frame has used them since the last
// assignment. As the cold measurements of NVBench do, by writing through more memory than the last level holds.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace clusterbench::run {

// A quarter more than all levels of this machine together; 64 MiB where they are not known, 1 GiB at most.
std::uint64_t sweep_bytes();

class CacheSweep {
 public:
  explicit CacheSweep(std::uint64_t bytes) : buffer_(bytes) {}

  // Writes every line of the buffer. Caches of other cores, but for a level that is shared, stay as they are.
  void operator()();

 private:
  std::vector<unsigned char> buffer_;
  unsigned char value_ = 0;
};

// How many of `rounds` passes over `frames` frames are measured cold, at least one: as many as sweep for no more than
// some time in all. The same on each machine of the same caches, so that all launches and methods have equally many.
int cold_rounds(int rounds, std::size_t frames, std::uint64_t bytes);

}  // namespace clusterbench::run
