#pragma once
// Stopping on SIGINT, SIGTERM and SIGHUP.

#include <atomic>

#include "core/error.h"

namespace clusterbench::os {

// Becomes true at the first signal; the second ends the program at once. A SIGHUP that is ignored, as under `nohup`,
// stays ignored.
const std::atomic<bool>& stop_on_signals();

// From here on only signals of this process count: those that a terminal sends to a whole group of processes do not.
void stop_on_signals_of(int process);

// The signal that stopped this process; 0: none did.
int stop_signal();

// sigint for SIGINT, interrupted for others.
ExitCode stopped_exit_code();

}  // namespace clusterbench::os
