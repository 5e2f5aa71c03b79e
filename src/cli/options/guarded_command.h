#pragma once
// A command that calls plug-ins, in processes of its own: where a plug-in crashes, hangs or takes too much memory, that
// is known and told, and a command that can go on does so in the next process.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line/command.h"
#include "cli/options/run_inputs.h"
#include "core/error.h"
#include "os/guarded_process.h"

namespace clusterbench::cli {

// The flags --plugin-timeout, --plugin-memory and --plugin-in-process.
struct GuardFlags {
  double timeout_s = 60.0;
  int memory_mib = 4096;
  bool is_in_process = false;  // for a debugger: no further process
};
void add_guard_options(Command& command, GuardFlags& flags);

// Whether plug-ins are called in this process: it was asked for, or the system has no other way. Then that is said
// once.
bool calls_in_process(const GuardFlags& flags);

// How a process with plug-ins ended.
struct Casualty {
  os::NotedCall call;  // the last one, if none was running
  std::string kind;    // as result::BrokenCase has it
  std::string reason;  // a sentence: "the plug-in NAME crashed (SIGSEGV) in assign, frame 12 (truth and counts)"
  std::string signal;
};

// For a part of a command: what the parts before it left.
struct GuardedPart {
  int number = 0;
  bool can_go_on = false;            // a further part is made, if this one asks for it
  std::optional<Casualty> casualty;  // the end of the part before
  std::string message;               // of os::leave_message()
  std::string result_file;           // beside which parts keep their journal, if the result itself goes to a stream
};

// `part` returns no exit code if another part is to go on. `before_each` is called here, before each part. Throws
// Error, with the reason, if a part died as plug-ins were loaded, or without a call of one. `kept_text`: ends the
// sentence of a command that is interrupted within a call of a plug-in.
ExitCode run_guarded(const GuardFlags& flags, const std::function<void()>& before_each,
                     const std::function<std::optional<ExitCode>(const GuardedPart& part)>& part,
                     const std::function<std::string()>& kept_text);

// The same for a command of one part: if it dies, throws Error with the reason, and `code`.
// `advice`: ends that reason.
ExitCode run_guarded_once(const GuardFlags& flags, ExitCode code, const std::function<ExitCode()>& command,
                          const std::string& advice = "");

// Runs a part of a command in a process of its own that ends with it, and returns its exit code; its errors are
// printed. For parts that load plug-ins and call no method. Throws Error as run_guarded_once() does.
ExitCode run_apart(const std::function<ExitCode()>& part);

// Why a plug-in cannot be loaded, found out in a process of its own; "" if it can be.
std::string loading_fault(const std::filesystem::path& plugin);

// For commands that load plug-ins and call no method: they need no flags.
GuardFlags loading_limits();

// The same for a command with these inputs, if they name plug-ins or come through a pipe; else it stays in this
// process.
ExitCode guarded_if_needed(const RunInputs& inputs, const GuardFlags& flags, const std::function<ExitCode()>& command,
                           const std::string& advice = "");

}  // namespace clusterbench::cli
