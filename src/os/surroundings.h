#pragma once
// What foreign code shares with the rest of its process, and what it prints.

#include <array>
#include <string>
#include <vector>

#include "os/process.h"

namespace clusterbench::os {

// Handlers of signals, the working directory and the locale, as they are when this is made.
class Surroundings {
 public:
  Surroundings();
  // What is different now: "the handler of SIGALRM".
  std::vector<std::string> changes() const;

 private:
  static constexpr std::size_t k_signals = 65;
  [[maybe_unused]] std::array<const void*, k_signals> handlers_{};  // not on Windows
  std::string folder_, locale_;
};

// What this process prints to standard output while this lives. At its end it goes to standard error.
class CaughtOutput {
 public:
  CaughtOutput();
  ~CaughtOutput();
  CaughtOutput(const CaughtOutput&) = delete;
  CaughtOutput& operator=(const CaughtOutput&) = delete;

  // The last 2,000 bytes.
  std::string text() const;

 private:
  MemoryFile file_;
  [[maybe_unused]] int before_;  // not on Windows
};

}  // namespace clusterbench::os
