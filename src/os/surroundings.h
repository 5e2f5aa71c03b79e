#pragma once
// What foreign code shares with the rest of its process, and what it prints.

#include <string>
#include <vector>

#include "os/process.h"

namespace clusterbench::os {

// What a process has once, as it is when this is made: handlers and mask of signals, the working directory, the locale,
// the environment, the mask of new files, limits, the group of processes, priority and processors of this thread. On
// Windows: the working directory, the locale and the environment.
class Surroundings {
 public:
  Surroundings();
  // What is different now: "the handler of SIGALRM", "the working directory, to /".
  std::vector<std::string> changes() const;

 private:
  struct Part {
    std::string name, value;
    bool is_shown = false;  // the value, in a message
  };
  // In the same order each time.
  static std::vector<Part> parts();

  std::vector<Part> before_;
  std::vector<std::string> variables_;  // of the environment, sorted: "NAME=VALUE"
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
