#pragma once
// Counts the instructions of a piece of this program: a comparison that works on machines too noisy for timing.

#include <cstdint>
#include <optional>

namespace clusterbench::run {

// Counts between start and stop, in user space.
struct Counted {
  std::uint64_t instructions = 0;
  std::optional<std::uint64_t> cycles;  // where the source knows them
};

class InstructionCounter {
 public:
  virtual ~InstructionCounter() = default;
  virtual const char* source() const = 0;       // its name in results
  virtual bool counts_all_threads() const = 0;  // else only the calling thread
  virtual void start() = 0;
  // Throws Error if nothing was counted.
  virtual Counted stop() = 0;
};

}  // namespace clusterbench::run
