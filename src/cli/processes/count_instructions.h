#pragma once
// `run --count`: instructions per case, by hardware counters in this process, or by this program run once more under
// callgrind.

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "run/passes/count_pass.h"

namespace clusterbench::cli {

enum class CountWay { none, perf, callgrind };

// From the value of --count: "perf", "callgrind", or "auto" for the first of them that works here; "" for none. Throws
// Error that names the allowed values, or the missing prerequisite.
CountWay count_way(const std::string& name);
const char* name_of(CountWay way);

// The input of a count.
struct CountTask {
  const config::Config& config;
  const run::Plan& plan;
  std::vector<std::string> ids;  // of the cases
};

// Counts every case of the task, or those before `stop` became true. Throws Error if one could not be counted.
run::Counts count_cases(CountWay way, const CountTask& task,
                        const std::function<void(const std::string& case_name)>& on_case,
                        const std::atomic<bool>& stop);

// The child process under callgrind: counts the cases listed in the next line of standard input, with `dumps` for
// callgrind's own files, and prints one line per case.
void print_callgrind_counts(const config::Config& config, const run::Plan& plan, const std::string& dumps);

}  // namespace clusterbench::cli
