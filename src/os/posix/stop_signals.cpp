#include "os/stop_signals.h"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string_view>

namespace clusterbench::os {
namespace {

// Global, since a signal handler can access nothing else.
std::atomic<bool> g_stop{false};
std::atomic<bool> g_ends{false};  // the first signal does
std::atomic<int> g_signal{0};
std::atomic<int> g_sender{0};  // whose signals count; 0: all

ExitCode code_of(int number) {
  return number == SIGINT ? ExitCode::sigint : ExitCode::interrupted;
}

void on_signal(int number, siginfo_t* info, void* /*context*/) {
  if (g_sender != 0 && info->si_pid != g_sender) return;
  g_signal = number;
  if (g_ends) return end_at_signal(number);
  if (g_stop.exchange(true)) std::_Exit(static_cast<int>(code_of(number)));  // the second time: at once
}

void handle(int number) {
  struct sigaction action {};
  action.sa_sigaction = on_signal;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  sigaction(number, &action, nullptr);
}

// As SIGHUP under `nohup`.
bool is_ignored(int number) {
  struct sigaction action {};
  return sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void end_at_signal(int number) {
  constexpr std::string_view k_message = "clusterbench: interrupted\n";
  const ssize_t written = ::write(STDERR_FILENO, k_message.data(), k_message.size());
  static_cast<void>(written);  // there is nobody left to be told
  if (number != SIGINT) std::_Exit(static_cast<int>(code_of(number)));
  // By the signal itself, which a shell sees as exit code 130: then it ends a loop of commands, too.
  ::signal(number, SIG_DFL);
  ::raise(number);
}

void end_on_signals() {
  g_ends = true;
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (!is_ignored(number)) handle(number);
}

const std::atomic<bool>& stop_on_signals() {
  g_ends = false;
  handle(SIGINT);
  handle(SIGTERM);
  if (!is_ignored(SIGHUP)) handle(SIGHUP);
  return g_stop;
}

void stop_on_signals_of(int process) {
  g_sender = process;
}

int stop_signal() {
  return g_signal;
}

ExitCode stopped_exit_code() {
  return code_of(g_signal);
}

}  // namespace clusterbench::os
