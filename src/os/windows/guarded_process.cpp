#include "os/guarded_process.h"

#include "os/notes_page.h"

namespace clusterbench::os {

std::string guard_obstacle() {
  return "Windows cannot copy a process: plug-ins are called in the program's own, and one that crashes ends it";
}

ProcessGuard::ProcessGuard(const Limits& limits) : limits_(limits) {
  share_notes().message.set("");
}

// There is no copy: this process is the one that goes on.
std::optional<GuardedEnd> ProcessGuard::run(const std::atomic<bool>&) {
  return std::nullopt;
}

std::string ProcessGuard::message() const {
  return notes_page().message.text();
}

void begin_notes() {}

std::uint64_t noted_growth() {
  return 0;
}

GuardedEnd noted_end(int) {
  return {};
}

void note_measured() {
  notes_page().state = GuardState::measured;
}

void note_done(int exit_code) {
  notes_page().exit_code = exit_code;
  notes_page().state = GuardState::done;
}

void leave_message(const std::string& text) {
  notes_page().message.set(text);
}

std::string signal_name(int number) {
  return "signal " + std::to_string(number);
}

}  // namespace clusterbench::os
