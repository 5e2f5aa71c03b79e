#pragma once
// Notes of this process on its calls of code that is not its own (a plug-in's), in memory that a guard can read
// (os/guarded_process.h): it then knows which call crashed, hung or took too much memory. Without a guard nobody reads
// them. They take some nanoseconds a call, and nothing but calls of foreign code makes any.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clusterbench::os {

enum class CallStep : std::uint32_t { load, create, build, assign, query, destroy, unload };
const char* name_of(CallStep step);

// An object of foreign code.
struct Caller {
  std::uint32_t code = 0;   // of note_code()
  std::uint64_t label = 0;  // of noted_label()
};

// Notes a call as long as it lives. Calls of several threads are told apart. Calls of one thread do not nest.
class ForeignCall {
 public:
  // `frame`: index in a camera's path; -1 without one.
  ForeignCall(const Caller& caller, CallStep step, int frame = -1);
  // In a copy of the process, which the call has forked, it notes that and ends the copy.
  ~ForeignCall();
  ForeignCall(const ForeignCall&) = delete;
  ForeignCall& operator=(const ForeignCall&) = delete;

 private:
  void note_fork() const;

  Caller caller_;
  CallStep step_;
  int frame_;
  // Destroying is what errors lead to: once it has returned, the call before it is the last one again.
  std::uint64_t label_before_ = 0;
  std::uint32_t code_before_ = 0, step_before_ = 0;
  int frame_before_ = -1;
};

// Gives foreign code a number. All after the 32nd have one number in common. Texts in notes are cut to 100 bytes.
std::uint32_t note_code(std::string_view name);

// The names of those that have made an object (CallStep::create) in this process, or in one that has joined its notes.
std::vector<std::string> codes_that_made();

// What later calls belong to. A group of cases, by the id of one of them, and a pass over its frames: of the process. A
// label and a setting ("seed 17"), with which a person can try the same again: of this thread.
void note_group(std::string_view case_id);
void note_pass(std::string_view name);
void note_label(std::uint64_t label);
std::uint64_t noted_label();
void note_setting(std::string_view text);

// The call that began last, in this process or one that it has started.
struct LastCall {
  CallStep step = CallStep::load;
  std::uint64_t label = 0;
  int frame = -1;
  std::string pass;
};
LastCall last_call();

// The frame that a check after the calls is about, in place of that of the last call.
void note_frame(int frame);

// Whether a guard reads the notes.
bool is_guarded();
// The notes as a path that a process can join which this one starts; "" without a guard.
std::string path_of_notes();
// From here on this process writes into the notes of the one that started it. Throws Error if there are none.
void join_notes(const std::string& path);
// Ends this process at once, for its guard, because a process that it started has ended in a call of foreign code.
// Returns if no call is running, or without a guard. `wait_status`: as waitpid() tells it.
void end_with_call(int wait_status);

// Ends this process at once, because foreign code ended the thread of the call that is running. Without a guard it says
// so.
[[noreturn]] void end_as_ended_thread();

// The step from which a copy of the process has come back, after a call of this code forked it.
std::optional<CallStep> forked_step_of(std::uint32_t code);
// Of any code.
std::optional<CallStep> forked_step();

// This process is no copy that a call has forked: to be said in one that was forked on purpose.
void note_own_process();

// Whether this process, or one whose notes it has joined, has called foreign code.
bool has_called();

// Ends this process at once, for its guard, if the call that is running has closed, replaced, written to or cut a file
// that this process needs (os/kept_files.h). Without a guard it says so, where standard error is left.
void end_if_files_are_lost();
// What it did: "closed a file of the program, or put another in its place (descriptor 1)".
std::string lost_file_text(int descriptor, bool is_changed);

}  // namespace clusterbench::os
