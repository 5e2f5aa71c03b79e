#include "run/counters/callgrind_counter.h"

#include <fstream>

#include "core/error.h"

#ifdef CLUSTERBENCH_HAS_CALLGRIND
#include <valgrind/callgrind.h>
#else
// A build that callgrind cannot count reports it in obstacle() and never gets here.
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#define CALLGRIND_DUMP_STATS
#endif

namespace clusterbench::run {
namespace {

// The number after "totals:" in a callgrind output file; 0 if there is none.
std::uint64_t total_in(const std::filesystem::path& dump) {
  std::ifstream in(dump);
  const std::string key = "totals: ";
  for (std::string line; std::getline(in, line);)
    if (line.compare(0, key.size(), key) == 0) return std::stoull(line.substr(key.size()));
  return 0;
}

}  // namespace

CallgrindCounter::CallgrindCounter(std::filesystem::path dumps) : dumps_(std::move(dumps)) {
  start();
  stop();
}

void CallgrindCounter::start() {
  CALLGRIND_START_INSTRUMENTATION;
}

Counted CallgrindCounter::stop() {
  CALLGRIND_DUMP_STATS;
  CALLGRIND_STOP_INSTRUMENTATION;
  const std::filesystem::path dump = dumps_.string() + "." + std::to_string(++dump_count_);
  const Counted counted{total_in(dump), {}};
  if (counted.instructions == 0) throw Error(dump.string(), "", "callgrind has written no count; is this callgrind?");
  std::error_code ignored;
  std::filesystem::remove(dump, ignored);
  return counted;
}

std::string CallgrindCounter::obstacle() {
  return CLUSTERBENCH_CALLGRIND_OBSTACLE;
}

}  // namespace clusterbench::run
