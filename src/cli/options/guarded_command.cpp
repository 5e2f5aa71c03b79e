#include "cli/options/guarded_command.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <set>
#include <utility>

#include "cli/output/output.h"
#include "core/text.h"
#include "os/standard_streams.h"
#include "os/stop_signals.h"
#include "os/terminal.h"
#include "plugin/plugins.h"
#include "report/cases/columns.h"
#include "run/findings/broken_cases.h"

namespace clusterbench::cli {
namespace {

using How = os::GuardedEnd::How;

std::string death_text(const os::GuardedEnd& end) {
  if (end.has_forked) return "came back twice (it forked)";
  const std::string signal = os::signal_name(end.signal);
  if (signal == "SIGKILL") return "was killed (SIGKILL), as where memory runs out,";
  if (end.signal != 0) return "crashed (" + signal + ")";
  if (end.lost_descriptor >= 0) return os::lost_file_text(end.lost_descriptor, end.is_file_changed);
  if (end.has_ended_thread) return "ended the process by ending its thread (pthread_exit)";
  return "ended the process (exit code " + std::to_string(end.died_with_code) + ")";
}

std::string end_text(const os::GuardedEnd& end, const GuardFlags& flags) {
  if (end.how == How::timed_out) return "did not return within " + report::text("%g s", flags.timeout_s);
  if (end.how == How::out_of_memory) return "took more than " + std::to_string(flags.memory_mib) + " MiB of memory";
  return death_text(end);
}

const char* kind_of(How how) {
  if (how == How::timed_out) return "timed_out";
  return how == How::out_of_memory ? "out_of_memory" : "crashed";
}

// "in assign, frame 12 (truth and counts)"; "after" if the call had returned.
std::string call_text(const os::GuardedEnd& end) {
  const os::NotedCall& call = *end.call;
  const bool is_within = end.is_call_running || call.step == os::CallStep::unload;
  std::string out = std::string(end.has_forked ? " from " : is_within ? " in " : " after ") + os::name_of(call.step);
  if (call.frame >= 0) out += ", frame " + std::to_string(call.frame);
  if (!call.pass.empty() && call.step != os::CallStep::unload) out += " (" + call.pass + ")";
  return out;
}

Casualty casualty_of(const os::GuardedEnd& end, const GuardFlags& flags) {
  if (!end.call) throw Error("", "", "ended without a call of a plug-in: " + death_text(end), ExitCode::internal);
  std::string reason = "the plug-in " + end.call->code + " " + end_text(end, flags) + call_text(end);
  if (end.signal != 0) reason += run::suspects_text(end.made, end.call->code);
  return {*end.call, kind_of(end.how), reason, end.signal != 0 ? os::signal_name(end.signal) : ""};
}

// Of processes that plug-ins have started.
void tell_orphans(const os::GuardedEnd& end) {
  if (end.orphans == 0) return;
  const bool is_one = end.orphans == 1;
  print_message("warning: plug-ins left " + std::to_string(end.orphans) +
                (is_one ? " process running, which was ended" : " processes running, which were ended"));
}

// A process that died cannot remove its progress line.
void clear_line() {
  if (os::terminal(os::StandardStream::error).interactive) std::cerr << "\r\033[K" << std::flush;
}

os::ProcessGuard::Limits limits_of(const GuardFlags& flags) {
  return {flags.timeout_s, static_cast<std::uint64_t>(flags.memory_mib) << 20};
}

// Runs a part, and notes its end: what ends the process after it is no end of the part. Where a plug-in has closed
// files of the program, the part can have failed for that, and nobody would read its message.
ExitCode ended(const std::function<std::optional<ExitCode>()>& part) {
  try {
    const std::optional<ExitCode> code = part();
    os::end_if_files_are_lost();
    if (!code) os::note_measured();
    if (code) os::note_done(static_cast<int>(*code));
    return code.value_or(ExitCode::ok);
  } catch (const Error& error) {
    os::end_if_files_are_lost();
    os::note_done(static_cast<int>(error.code()));
    throw;
  } catch (...) {
    os::end_if_files_are_lost();
    os::note_done(static_cast<int>(ExitCode::internal));
    throw;
  }
}

// A plug-in that cannot be loaded is an input that cannot be taken.
ExitCode code_of(const Casualty& casualty, ExitCode other) {
  return casualty.call.step == os::CallStep::load ? ExitCode::usage : other;
}

// A plug-in that was within a call when a signal came cannot be asked to stop.
ExitCode stopped(const os::GuardedEnd& end, const std::string& advice) {
  if (end.call) print_message("interrupted; the plug-in " + end.call->code + " was ended" + call_text(end) + advice);
  return os::stopped_exit_code();
}

[[noreturn]] void refuse(const Casualty& casualty, ExitCode code, const std::string& advice = "") {
  const std::string setting = casualty.call.setting.empty() ? "" : "; with " + casualty.call.setting;
  throw Error("", "", casualty.reason + setting + advice, code);
}

}  // namespace

void add_guard_options(Command& command, GuardFlags& flags) {
  command.add_option("--plugin-timeout", flags.timeout_s, "Longest time of one call of a plug-in, in seconds")
      .range(0.1, 1e6)
      .shows_standard();
  command
      .add_option("--plugin-memory", flags.memory_mib,
                  "Most memory that the process may take beyond what it had when it first called a plug-in, in MiB")
      .range(1, 1 << 30)
      .shows_standard();
  command.add_flag("--plugin-in-process", flags.is_in_process,
                   "Call plug-ins in this process, for a debugger: if one crashes, the command ends with it");
}

bool calls_in_process(const GuardFlags& flags) {
  static const std::string obstacle = os::guard_obstacle();
  if (!flags.is_in_process && obstacle.empty()) return false;
  os::keep_output_apart();
  if (flags.is_in_process) return true;
  static std::once_flag is_said;
  std::call_once(is_said, [] { print_message("warning: " + obstacle); });
  return true;
}

ExitCode run_guarded(const GuardFlags& flags, const std::function<void()>& before_each,
                     const std::function<std::optional<ExitCode>(const GuardedPart& part)>& part,
                     const std::function<std::string()>& kept_text) {
  if (calls_in_process(flags)) return *part({});
  const std::atomic<bool>& stop = os::stop_on_signals();
  os::ProcessGuard guard(limits_of(flags));
  std::set<std::pair<std::string, std::uint64_t>> broken;  // group and method
  GuardedPart next;
  next.can_go_on = true;
  for (;; ++next.number) {
    before_each();
    const std::optional<os::GuardedEnd> end = guard.run(stop);
    if (!end) return ended([&] { return part(next); });
    tell_orphans(*end);
    if (end->how == How::done) return static_cast<ExitCode>(end->exit_code);
    next.message = guard.message();
    next.casualty.reset();
    if (end->how == How::measured) continue;
    clear_line();
    if (stop) return stopped(*end, kept_text());
    next.casualty = casualty_of(*end, flags);
    if (next.casualty->call.group.empty()) refuse(*next.casualty, code_of(*next.casualty, ExitCode::gate_failed));
    // A method is called no more in the group that it broke down in.
    const bool is_new = broken.emplace(next.casualty->call.group, next.casualty->call.label).second;
    if (!is_new) refuse(*next.casualty, ExitCode::internal);
  }
}

ExitCode run_guarded_once(const GuardFlags& flags, ExitCode code, const std::function<ExitCode()>& command,
                          const std::string& advice) {
  if (calls_in_process(flags)) return command();
  const std::atomic<bool>& stop = os::stop_on_signals();
  os::ProcessGuard guard(limits_of(flags));
  const std::optional<os::GuardedEnd> end = guard.run(stop);
  if (!end) return ended([&]() -> std::optional<ExitCode> { return command(); });
  tell_orphans(*end);
  if (end->how == How::done) return static_cast<ExitCode>(end->exit_code);
  clear_line();
  if (stop) return stopped(*end, "");
  const Casualty casualty = casualty_of(*end, flags);
  refuse(casualty, code_of(casualty, code), advice);
}

GuardFlags loading_limits() {
  return {10.0, 4096, false};
}

namespace {

// Ends this process without the ends of what plug-ins have loaded.
[[noreturn]] void end_part(const std::function<ExitCode()>& part) {
  ExitCode code = ExitCode::internal;
  try {
    code = part();
    check_standard_output();
  } catch (const Error& error) {
    print_message(printable(error.what()));
    code = error.code();
  } catch (const std::exception& error) {
    print_message(printable(std::string("internal error: ") + error.what()));
    code = ExitCode::internal;
  }
  std::cout << std::flush;
  std::cerr << std::flush;
  os::note_done(static_cast<int>(code));
  std::_Exit(static_cast<int>(code));
}

// What comes through a pipe is not looked into, and may name some.
bool may_name_plugins(const RunInputs& inputs) {
  std::error_code none;
  const auto is_pipe = [&](const std::string& path) { return std::filesystem::is_fifo(path, none) || path == "-"; };
  return names_plugins(inputs) || std::ranges::any_of(inputs.paths, is_pipe);
}

std::string fault_found_here(const std::filesystem::path& file) {
  try {
    plugin::describe_plugin(file);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

ExitCode describe_or_leave_message(const std::filesystem::path& file) {
  try {
    plugin::describe_plugin(file);
    return ExitCode::ok;
  } catch (const Error& error) {
    os::leave_message(error.what());
    return error.code();
  }
}

}  // namespace

ExitCode run_apart(const std::function<ExitCode()>& part) {
  if (!os::guard_obstacle().empty()) return part();
  const GuardFlags flags = loading_limits();
  const std::atomic<bool>& stop = os::stop_on_signals();
  os::ProcessGuard guard(limits_of(flags));
  const std::optional<os::GuardedEnd> end = guard.run(stop);
  if (!end) end_part(part);
  if (end->how == How::done) return static_cast<ExitCode>(end->exit_code);
  if (stop) return stopped(*end, "");
  refuse(casualty_of(*end, flags), ExitCode::usage);
}

std::string loading_fault(const std::filesystem::path& plugin) {
  if (!os::guard_obstacle().empty()) return fault_found_here(plugin);
  const GuardFlags flags = loading_limits();
  os::ProcessGuard guard(limits_of(flags));
  const std::optional<os::GuardedEnd> end = guard.run(os::stop_on_signals());
  if (!end) end_part([&] { return describe_or_leave_message(plugin); });
  if (end->how != How::done) return plugin.string() + ": " + casualty_of(*end, flags).reason;
  if (end->exit_code == 0) return "";
  const std::string message = guard.message();
  return message.empty() ? plugin.string() + ": cannot be loaded" : message;
}

ExitCode guarded_if_needed(const RunInputs& inputs, const GuardFlags& flags, const std::function<ExitCode()>& command,
                           const std::string& advice) {
  if (!os::guard_obstacle().empty() && !names_plugins(inputs)) return command();
  return may_name_plugins(inputs) ? run_guarded_once(flags, ExitCode::gate_failed, command, advice) : command();
}

}  // namespace clusterbench::cli
