#pragma once
// A copy of this process that may crash, hang or take too much memory in code that is not its own: this one goes on,
// and knows in which call (os/call_notes.h) it happened.

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "os/call_notes.h"

namespace clusterbench::os {

// A call as a guard finds it in the notes.
struct NotedCall {
  std::string code;  // its name
  CallStep step = CallStep::load;
  int frame = -1;  // of a camera's path; -1: of none
  std::uint64_t label = 0;
  std::string group, pass, setting;
};

struct GuardedEnd {
  // `measured`, `done`: by itself, having said so. `died`: by a signal, or by exit() in foreign code. The others: ended
  // by the guard.
  enum class How : std::uint8_t { measured, done, died, timed_out, out_of_memory };
  How how = How::done;
  int exit_code = 0;              // of `done`
  int signal = 0;                 // by which it died; 0: by exit()
  int died_with_code = 0;         // of exit()
  bool has_ended_thread = false;  // ... because foreign code ended the thread that called it
  int lost_descriptor = -1;       // ... because foreign code closed, replaced or changed a file that the process needs
  bool is_file_changed = false;   // ... its length
  bool has_forked = false;        // ... because foreign code forked it, and the copy came back from the call
  std::vector<std::string> made;  // codes of which it had made an object, if it died
  int orphans = 0;                // processes that it left running, and that were ended
  // Of a process that did not end by itself: the call that was running, or the last one before; none if it made none.
  std::optional<NotedCall> call;
  bool is_call_running = false;
};

// Why this system has no such copies, as a sentence; "" if it has. Without them run() goes on in this process.
std::string guard_obstacle();

class ProcessGuard {
 public:
  struct Limits {
    double call_s = 60.0;                                 // of one call, and of the end of the process
    std::uint64_t growth_bytes = std::uint64_t{4} << 30;  // of the process since its first call
  };

  // Call it while this process has one thread. Throws Error.
  explicit ProcessGuard(const Limits& limits);

  // Makes a copy of this process. Returns nothing in the copy, which goes on, and in this process the end of the copy.
  // `stop`: of stop_on_signals(). Once it is true the copy gets the same signal, and a call may go on for two seconds;
  // the one that a terminal sends to both does not reach it.
  std::optional<GuardedEnd> run(const std::atomic<bool>& stop);

  // Text that an earlier copy left with leave_message(); cut to 1000 bytes.
  std::string message() const;

 private:
  Limits limits_;
};

// Notes for the next process that this one starts, which joins them (os/call_notes.h). Throws Error.
void begin_notes();
// How much more memory it has than when it first made something, in bytes, if it is in a call; else 0.
std::uint64_t noted_growth();
// The end of such a process.
GuardedEnd noted_end(int wait_status);

// In the copy: says how far it has come, as its last act before it ends like any process.
void note_measured();
void note_done(int exit_code);
void leave_message(const std::string& text);

// "SIGSEGV"; "signal 40" without a name.
std::string signal_name(int number);

}  // namespace clusterbench::os
