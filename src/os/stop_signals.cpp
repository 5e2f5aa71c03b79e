#include "os/stop_signals.h"

#include <csignal>
#include <cstdlib>

namespace clusterbench::os {
namespace {

// The only global state: a signal handler can access nothing else.
std::atomic<bool> g_stop{false};
std::atomic<int> g_signal{0};

ExitCode code_of(int number) {
  return number == SIGINT ? ExitCode::sigint : ExitCode::interrupted;
}

void on_signal(int number) {
  g_signal = number;
  if (g_stop.exchange(true)) std::_Exit(static_cast<int>(code_of(number)));  // the second time: at once
}

}  // namespace

const std::atomic<bool>& stop_on_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // ignored under `nohup`
  return g_stop;
}

ExitCode stopped_exit_code() {
  return code_of(g_signal);
}

}  // namespace clusterbench::os
