#pragma once
// Counts the instructions that a piece of this program runs: what a machine that is too noisy to time on can still
// tell.

#include <cstdint>
#include <optional>

namespace clusterbench::run {

// Between a start and its stop, in user space.
struct Counted {
  std::uint64_t instructions = 0;
  std::optional<std::uint64_t> cycles;  // where the source knows them
};

class InstructionCounter {
 public:
  virtual ~InstructionCounter() = default;
  virtual const char* source() const = 0;       // as results name it
  virtual bool counts_all_threads() const = 0;  // else only the calling one
  virtual void start() = 0;
  // Throws Error if nothing was counted.
  virtual Counted stop() = 0;
};

}  // namespace clusterbench::run
