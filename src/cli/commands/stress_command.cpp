// `clusterbench stress`: every assigner on every hard case.

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/command_line/commands.h"
#include "cli/options/guarded_command.h"
#include "cli/options/plugin_option.h"
#include "cli/output/output.h"
#include "cli/output/progress_line.h"
#include "core/text.h"
#include "core/work_in_order.h"
#include "gpu/device/device.h"
#include "gpu/user_shaders/shader_method.h"
#include "os/stop_signals.h"
#include "report/searches/stress_report.h"

namespace clusterbench::cli {
namespace {

struct StressFlags {
  std::string output, cases, methods, device, failures;
  std::vector<std::string> plugins, shaders;
  GuardFlags guard;
  stress::StressRequest request;
  bool quiet = false;
};

// A name for a file: "H32-naive-bounds-flaw=log-slice".
std::string file_name(const std::string& hard_case, const std::string& method) {
  std::string name = hard_case + "-";
  for (const char c : method)
    if (c == '(' || c == ',' || c == ' ')
      name += '-';
    else if (c != ')')
      name += c;
  return name;
}

const stress::StressMethod& method_of(const stress::StressResult& result, const std::string& label) {
  for (const stress::StressMethod& method : result.methods)
    if (method.label == label) return method;
  throw Error("", "stress", "knows no method '" + label + "'", ExitCode::internal);
}

// Without names, every hard case; none together with random settings.
std::string cases_of(const StressFlags& flags) {
  if (!flags.cases.empty()) return flags.cases;
  return flags.request.random > 0 ? "none" : ".*";
}

void write_replays(const std::string& folder, const stress::StressResult& result) {
  int written = 0;
  const auto write = [&](const std::string& hard_case, const std::string& label,
                         const std::optional<stress::Loss>& loss) {
    if (!loss) return;
    stress::write_replay(folder, file_name(hard_case, label), *loss, method_of(result, label));
    ++written;
  };
  for (const stress::StressCell& cell : result.cells) write(cell.hard_case, cell.method, cell.deepest);
  for (const stress::SearchResult& search : result.searches) write("H31", search.method, search.deepest);
  if (result.random)
    for (const stress::RandomFault& found : result.random->faults) {
      stress::write_replay(folder, found.name(), found.scene, stress::methods_that_show(found.fault, result.methods));
      ++written;
    }
  print_message(written == 0
                    ? "no fault to write to " + folder
                    : number_of(static_cast<std::uint64_t>(written), "fault") + " written to " + folder +
                          (written == 1 ? ", a configuration" : ", each a configuration") + " for `clusterbench run`");
}

// The current step of a search in a file, in case the process dies; removed when the search has ended.
class StepFile {
 public:
  explicit StepFile(const StressFlags& flags) {
    if (flags.failures.empty() || flags.request.random == 0) return;
    std::error_code failed;
    std::filesystem::create_directories(flags.failures, failed);
    path_ = std::filesystem::path(flags.failures) / "at_work.txt";
  }
  ~StepFile() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }
  StepFile(const StepFile&) = delete;
  StepFile& operator=(const StepFile&) = delete;

  void write(const std::string& doing) const {
    if (!path_.empty()) os::write_file(path_, doing + "\n");
  }

 private:
  std::filesystem::path path_;
};

// Whether a device is named. Throws Error if it is not there.
bool takes_device(const std::string& wanted) {
  gpu::use_device(wanted);
  if (!wanted.empty() && !gpu::device_obstacle().empty()) throw Error("", "--device", gpu::device_obstacle());
  return !wanted.empty();
}

// "a,b" as "a|b", where it is names alone: a regular expression can have commas of its own.
std::string alternatives(std::string methods) {
  constexpr const char* k_of_names = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_,^$*";
  if (methods.find_first_not_of(k_of_names) == std::string::npos) std::ranges::replace(methods, ',', '|');
  return methods;
}

// Without a name all methods, or those of --shader alone.
std::string methods_of(const StressFlags& flags) {
  std::string own;
  for (const std::string& shader : flags.shaders)
    own += (own.empty() ? "^(" : "|") + gpu::add_shader_method(shader).name;
  if (!flags.methods.empty()) return alternatives(flags.methods);
  return own.empty() ? ".*" : own + ")$";
}

ExitCode stress(const StressFlags& flags) {
  load_plugins(flags.plugins);
  stress::StressRequest request = flags.request;
  if (request.random > 0 && request.random - 1 > k_most_seed - request.seed)
    throw Error("", "--random", "goes beyond the seed 2^53 - 1: setting i has the seed --seed + i");
  const std::string methods = methods_of(flags);
  request.cases = Pattern(cases_of(flags), "--cases");
  request.methods = Pattern(methods, "--methods");
  request.takes_device = takes_device(flags.device);
  LaterOutput output(flags.output, is_for_reading(flags.output));
  const std::atomic<bool>& stop = os::stop_on_signals();
  ProgressLine progress(os::terminal(os::StandardStream::error), flags.quiet);
  const StepFile step_file(flags);
  stress::StressListener listener;
  listener.on_progress = [&](const std::string& doing, double done, double whole) {
    step_file.write(doing);
    progress.show({static_cast<std::size_t>(done), static_cast<std::size_t>(whole), done, whole, doing});
  };
  listener.on_left_out = [&](const std::string& reason) {
    if (!flags.quiet) print_message("left out " + reason + (flags.device.empty() ? " (--device NAME)" : ""));
  };
  const stress::StressResult result = stress::run_stress(request, listener, stop);
  progress.clear();
  if (result.methods.empty()) throw Error("", "--methods", "'" + methods + "' names none" + pattern_hint(methods));
  if (!result.interrupted && result.cases.empty() && result.searches.empty() &&
      (!result.random || !flags.cases.empty()))
    throw Error("", "--cases",
                "'" + flags.cases + "' names none" + pattern_hint(flags.cases) + "; there are H1 to H35");
  const bool for_reading = is_for_reading(flags.output);
  output.write(result::to_json(report::stress_document(result, request)));
  if (!flags.quiet) report::print_stress(for_reading ? std::cout : std::cerr, result);
  if (for_reading) warn_result_not_saved();
  if (!flags.failures.empty()) write_replays(flags.failures, result);
  const std::vector<std::string> failures = report::stress_failures(result);
  for (const std::string& failure : failures) print_message("FAILED " + failure);
  if (result.interrupted) {
    print_message("interrupted; all output is of what was done by then" +
                  files_text({flags.output, flags.failures}, "written"));
    return os::stopped_exit_code();
  }
  return failures.empty() ? ExitCode::ok : ExitCode::gate_failed;
}

// A crash of a plug-in is a fault that was found.
ExitCode guarded_stress(const StressFlags& flags) {
  const bool has_plugins = !flags.plugins.empty() || has_plugin_path();
  return has_plugins ? run_guarded_once(flags.guard, ExitCode::gate_failed, [&] { return stress(flags); })
                     : stress(flags);
}

}  // namespace

void add_stress(Command& program, Action& action) {
  auto flags = std::make_shared<StressFlags>();
  Command command =
      program.add_command("stress", "Every assigner on the hard cases for numerical stability, and a search for more");
  command.add_option("-o,--output", flags->output,
                     "JSON file; without it the JSON goes to standard output, on a terminal the table alone");
  command.add_option("--cases", flags->cases,
                     "Only hard cases of this name, or that match it as a regular expression (H1 .. H35)");
  command.add_option("--methods", flags->methods,
                     "Only methods whose name has this in it, or matches it as a regular expression; several: A,B");
  add_plugin_option(command, flags->plugins);
  add_guard_options(command, flags->guard);
  command
      .add_option("--shader", flags->shaders,
                  "FILE, repeatable: your own compute shaders as a method (docs/shaders.md); without --methods only "
                  "these")
      .utf8();
  command.add_option("--device", flags->device,
                     "NAME, UUID or number: also methods that run on a device, on this one, as `clusterbench list "
                     "devices` shows it; without it only those that --methods names, on the best one");
  command
      .add_option("--tries", flags->request.tries,
                  "Tries of the search H31 per method, in whole rounds of 48; 0 = no search")
      .shows_standard();
  command
      .add_option("--random", flags->request.random,
                  "Check so many random settings in place of the hard cases (with --cases: beside them); setting i has "
                  "the seed "
                  "--seed + i")
      .at_least(1);
  command
      .add_option("--seconds", flags->request.seconds,
                  "End the search of a method, or that of random settings, after so many; 0 = by their number")
      .non_negative()
      .shows_standard();
  command.add_option("--seed", flags->request.seed, "Seed of everything random").seed();
  flags->request.threads = processors();
  command
      .add_option("--threads", flags->request.threads,
                  "Threads (default: all processors); results do not depend on them")
      .range(1, 1024);
  command.add_option("--failures", flags->failures, "Folder for every loss or fault as a scene and a configuration");
  command.add_flag("-q,--quiet", flags->quiet, "No progress and no table");
  command.when_named([flags, &action] { action = [flags] { return guarded_stress(*flags); }; });
}

}  // namespace clusterbench::cli
