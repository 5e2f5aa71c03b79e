#include "os/stop_signals.h"

#include <csignal>
#include <cstdlib>
#include <string_view>

#include "os/windows/windows_api.h"

namespace clusterbench::os {
namespace {

// Global, since the handler, which runs on a thread of its own, can access nothing else.
std::atomic<bool> g_stop{false};
std::atomic<int> g_signal{0};

ExitCode code_of(int number) {
  return number == SIGINT ? ExitCode::sigint : ExitCode::interrupted;
}

// Windows ends the process when this returns from the end of a console or session: until then it has some seconds.
BOOL WINAPI on_console_event(DWORD event) {
  constexpr DWORD k_time_to_end_ms = 10'000;
  const int number = event == CTRL_C_EVENT ? SIGINT : SIGTERM;
  g_signal = number;
  if (g_stop.exchange(true)) std::_Exit(static_cast<int>(code_of(number)));  // the second time: at once
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) ::Sleep(k_time_to_end_ms);
  return TRUE;
}

BOOL WINAPI end(DWORD event) {
  end_at_signal(event == CTRL_C_EVENT ? SIGINT : SIGTERM);
  return TRUE;
}

}  // namespace

void end_at_signal(int number) {
  constexpr std::string_view k_message = "clusterbench: interrupted\n";
  DWORD written = 0;  // not by stderr, which another thread may hold
  ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), k_message.data(), static_cast<DWORD>(k_message.size()), &written,
              nullptr);
  std::_Exit(static_cast<int>(code_of(number)));
}

void end_on_signals() {
  ::SetConsoleCtrlHandler(end, TRUE);
}

// The handler that was set last is called first.
const std::atomic<bool>& stop_on_signals() {
  static const BOOL is_set = ::SetConsoleCtrlHandler(on_console_event, TRUE);
  static_cast<void>(is_set);
  return g_stop;
}

void stop_on_signals_of(int) {}

int stop_signal() {
  return g_signal;
}

ExitCode stopped_exit_code() {
  return code_of(g_signal);
}

}  // namespace clusterbench::os
