#include "os/guarded_process.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "core/error.h"
#include "os/kept_files.h"
#include "os/notes_page.h"
#include "os/orphans.h"
#include "os/posix/system_calls.h"
#include "os/process_memory.h"
#include "os/standard_streams.h"
#include "os/stop_signals.h"

namespace clusterbench::os {
namespace {

using WatchClock = std::chrono::steady_clock;

std::uint64_t grown_bytes(const ThreadNotes& notes) {
  const std::uint64_t now = resident_bytes(notes.process), before = notes.resident_before;
  return now > before && before > 0 ? now - before : 0;
}

// Watches the calls of a copy for those that last too long or take too much.
class CallWatch {
 public:
  explicit CallWatch(const ProcessGuard::Limits& limits) : limits_(limits) {}

  std::optional<GuardedEnd::How> look(double seconds) {
    const NotesPage& page = notes_page();
    for (std::size_t i = 0; i < page.threads.size(); ++i) {
      const ThreadNotes& notes = page.threads[i];
      if (notes.process == 0 || !notes.is_running()) continue;
      Seen& seen = seen_[i];
      seen.seconds = seen.begun == notes.begun ? seen.seconds + seconds : 0.0;
      seen.begun = notes.begun;
      thread_ = static_cast<int>(i);
      if (seen.seconds > most_seconds()) return GuardedEnd::How::timed_out;
      if (grown_bytes(notes) > limits_.growth_bytes) return GuardedEnd::How::out_of_memory;
    }
    thread_ = -1;
    return look_at_end(seconds);
  }

  int thread() const { return thread_; }

  // From here on a call, and the end of the process, may take no more than two seconds.
  void hurry() {
    is_hurried_ = true;
    ending_s_ = 0.0;
    for (Seen& seen : seen_) seen.seconds = 0.0;
  }

 private:
  struct Seen {
    std::uint64_t begun = 0;
    double seconds = 0.0;
  };

  double most_seconds() const { return is_hurried_ ? std::min(2.0, limits_.call_s) : limits_.call_s; }

  // Foreign code can also hang where the process ends.
  std::optional<GuardedEnd::How> look_at_end(double seconds) {
    ending_s_ = notes_page().state == GuardState::working ? 0.0 : ending_s_ + seconds;
    return ending_s_ > most_seconds() ? std::optional(GuardedEnd::How::timed_out) : std::nullopt;
  }

  const ProcessGuard::Limits& limits_;
  std::array<Seen, NotesPage::k_threads> seen_{};
  int thread_ = -1;
  double ending_s_ = 0.0;
  bool is_hurried_ = false;
};

int running_thread(const NotesPage& page) {
  const auto found = std::ranges::find_if(page.threads, &ThreadNotes::is_running);
  return found == page.threads.end() ? -1 : static_cast<int>(found - page.threads.begin());
}

NotedCall call_of(const NotesPage& page, const ThreadNotes& notes) {
  NotedCall call;
  call.code = page.names[std::min<std::size_t>(notes.code, page.names.size() - 1)].text();
  call.step = static_cast<CallStep>(notes.step.load());
  call.frame = notes.frame;
  call.label = notes.label;
  call.group = page.group.text();
  call.pass = page.pass.text();
  call.setting = notes.setting.text();
  return call;
}

// `thread`: in which the guard saw it happen; -1: unknown.
void add_call(GuardedEnd& end, int thread) {
  const NotesPage& page = notes_page();
  if (thread < 0) thread = page.crashed_thread;
  if (thread < 0) thread = running_thread(page);
  end.is_call_running = thread >= 0;
  if (thread < 0 && page.has_called) thread = page.last_thread;
  if (thread < 0 || thread >= static_cast<int>(page.threads.size())) return;
  end.call = call_of(page, page.threads[static_cast<std::size_t>(thread)]);
  if (end.is_call_running || page.state == GuardState::working) return;
  end.call->step = CallStep::unload;
  end.call->frame = -1;
}

void add_fork(GuardedEnd& end) {
  const NotesPage& page = notes_page();
  end.how = GuardedEnd::How::died;
  end.has_forked = end.is_call_running = true;
  NotedCall call;
  call.code = page.names[std::min<std::size_t>(page.forked_code, page.names.size() - 1)].text();
  call.step = static_cast<CallStep>(page.forked_step.load());
  call.frame = page.forked_frame;
  call.label = page.forked_label;
  call.group = page.group.text();
  call.pass = page.pass.text();
  end.call = call;
}

GuardedEnd end_of(int status) {
  const NotesPage& page = notes_page();
  if (page.has_forked) {
    GuardedEnd end;
    add_fork(end);
    return end;
  }
  if (page.has_child_status) status = page.child_status;
  GuardedEnd end;
  const GuardState state = page.has_child_status ? GuardState::working : page.state.load();
  const bool has_exited = WIFEXITED(status);
  if (state == GuardState::done) {
    // The result is complete, whatever unloading did.
    const int code = has_exited ? WEXITSTATUS(status) : 0;
    end.exit_code = code != 0 ? code : page.exit_code.load();
    return end;
  }
  end.how = state == GuardState::measured && has_exited ? GuardedEnd::How::measured : GuardedEnd::How::died;
  if (end.how == GuardedEnd::How::measured) return end;
  if (has_exited)
    end.died_with_code = WEXITSTATUS(status);
  else
    end.signal = WTERMSIG(status);
  end.has_ended_thread = page.has_ended_thread;
  end.lost_descriptor = page.lost_descriptor;
  end.is_file_changed = page.is_file_changed;
  end.made = codes_that_made();
  add_call(end, -1);
  return end;
}

// Waits for its end for at most so long.
std::optional<int> status_after(pid_t copy, int wait_ms) {
  ::poll(nullptr, 0, wait_ms);
  int status = 0;
  const pid_t ended = ::waitpid(copy, &status, WNOHANG);
  if (ended == copy || (ended < 0 && errno == ECHILD)) return status;
  return std::nullopt;
}

void end_now(pid_t copy) {
  ::kill(copy, SIGKILL);
  while (::waitpid(copy, nullptr, 0) < 0 && errno == EINTR) {
  }
}

GuardedEnd watched(pid_t copy, const ProcessGuard::Limits& limits, const std::atomic<bool>& stop) {
  constexpr int k_least_wait_ms = 1, k_most_wait_ms = 50;  // so that little time is taken from what is measured
  constexpr double k_most_step_s = 0.1;                    // both processes can be suspended meanwhile
  CallWatch watch(limits);
  bool has_stopped = false;
  int wait_ms = k_least_wait_ms;
  for (WatchClock::time_point before = WatchClock::now();; wait_ms = std::min(k_most_wait_ms, wait_ms + 1)) {
    if (const std::optional<int> status = status_after(copy, wait_ms)) return end_of(*status);
    if (stop && !has_stopped) {
      ::kill(copy, stop_signal());
      watch.hurry();
      has_stopped = true;
    }
    const WatchClock::time_point now = WatchClock::now();
    const auto how = watch.look(std::min(k_most_step_s, std::chrono::duration<double>(now - before).count()));
    before = now;
    if (notes_page().has_forked) {
      end_now(copy);
      return end_of(0);
    }
    if (!how) continue;
    GuardedEnd end;
    end.how = *how;
    ::kill(copy, SIGSTOP);  // what is read of its notes is of one moment
    add_call(end, watch.thread());
    const bool is_complete = notes_page().state == GuardState::done;
    end_now(copy);
    if (!is_complete) return end;
    end = {};
    end.exit_code = notes_page().exit_code;
    return end;
  }
}

}  // namespace

std::string guard_obstacle() {
  return "";
}

ProcessGuard::ProcessGuard(const Limits& limits) : limits_(limits) {
  share_notes().message.set("");
}

std::optional<GuardedEnd> ProcessGuard::run(const std::atomic<bool>& stop) {
  clear_notes(notes_page());
  std::cout << std::flush;
  std::cerr << std::flush;
  std::fflush(nullptr);
  const Orphans orphans;
  const std::string notes = path_of_notes();
  const pid_t self = ::getpid(), copy = ::fork();
  if (copy < 0) throw Error("", "", errno_text("no process for plug-ins could be started"), ExitCode::internal);
  if (copy > 0) {
    GuardedEnd end = watched(copy, limits_, stop);
    end.orphans = orphans.end_all();
    if (notes_page().has_forked) add_fork(end);  // it came back later than the call ended
    return end;
  }
  note_own_process();
  close_notes_file(notes);
  if (!end_with_parent(self)) ::_exit(static_cast<int>(ExitCode::internal));
  end_on_signals();
  stop_on_signals_of(self);
  watch_for_crashes();
  keep_output_apart();
  keep_standard_files();
  return std::nullopt;
}

std::string ProcessGuard::message() const {
  return notes_page().message.text();
}

void begin_notes() {
  clear_notes(share_notes());
}

std::uint64_t noted_growth() {
  const NotesPage& page = notes_page();
  const int thread = running_thread(page);
  return thread < 0 ? 0 : grown_bytes(page.threads[static_cast<std::size_t>(thread)]);
}

GuardedEnd noted_end(int wait_status) {
  return end_of(wait_status);
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
  const std::string name = name_of_signal(number);
  return name.empty() ? "signal " + std::to_string(number) : name;
}

}  // namespace clusterbench::os
