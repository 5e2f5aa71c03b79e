#pragma once
// `run --baseline-binary PATH`: this program and another one, measured side by side.

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "result/result.h"
#include "run/timing/paired_rounds.h"

namespace clusterbench::cli {

struct BaselineRequest {
  std::string binary;  // "" = none
  int launches = 10, most_launches = 40;
  double timeout_s = 120.0;  // for one answer of either program
  double threshold_percent = 2.0;
};

// Throws Error if the other program cannot be measured beside this one; the user learns it before minutes of measuring.
void probe_baseline(const BaselineRequest& request, const std::vector<std::string>& arguments,
                    const std::atomic<bool>& stop);

// Starts both programs with `arguments`, from which this program made its plan, and adds the measurements to the
// result. Throws Error if the other program cannot do it, breaks down or hangs, but if one of them does so at a case of
// a plug-in, that case fails; with os::stopped_exit_code() once `stop` is true.
void measure_beside(const BaselineRequest& request, const std::vector<std::string>& arguments,
                    const config::Config& config, const run::Plan& plan, const run::OnPairedRound& on_round,
                    const std::atomic<bool>& stop, result::Result& result);

}  // namespace clusterbench::cli
