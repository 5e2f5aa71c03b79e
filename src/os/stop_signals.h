#pragma once
// Stopping on SIGINT, SIGTERM and SIGHUP. A SIGHUP that is ignored, as under `nohup`, stays ignored.

#include <atomic>

#include "core/error.h"

namespace clusterbench::os {

// From here on, until stop_on_signals() is called, a signal that is not ignored ends the program as end_at_signal does.
void end_on_signals();
// Ends with a message and the exit code of an interruption. A signal handler may call it.
void end_at_signal(int number);

// Becomes true at the first signal; the second ends the program at once.
const std::atomic<bool>& stop_on_signals();

// From here on only signals of this process count: those that a terminal sends to a whole group of processes do not.
void stop_on_signals_of(int process);

// The signal that stopped this process; 0: none did.
int stop_signal();

// sigint for SIGINT, interrupted for others.
ExitCode stopped_exit_code();

}  // namespace clusterbench::os
