#pragma once
// The current state of the machine on which this process runs.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "os/processor.h"

namespace clusterbench::os {

struct Machine {
  Processor processor;
  std::vector<std::pair<std::string, std::uint64_t>> caches;  // in the form of caches_of()
  int cores = 0;
  std::uint64_t ram_bytes = 0;
  std::string system;  // "Linux 6.1.0-18-amd64 x86_64"
};
Machine this_machine();

std::vector<std::pair<std::string, std::uint64_t>> caches_now();
std::optional<Clock> clock_now();
// Runnable processes, the mean of the last minute.
std::optional<double> load_now();

// "2026-01-31T12:00:00Z"
std::string utc_now();

}  // namespace clusterbench::os
