// `clusterbench run CONFIG|SCENE...`: plan, measure, show, write.

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/command_line/commands.h"
#include "cli/options/gates.h"
#include "cli/options/shard_choice.h"
#include "cli/output/output.h"
#include "cli/processes/handover.h"
#include "cli/processes/launches.h"
#include "cli/processes/rounds_protocol.h"
#include "cli/running/dry_run.h"
#include "cli/running/measured_run.h"
#include "cli/running/run_flags.h"
#include "cli/running/sharded_plan.h"
#include "cli/running/written_dumps.h"
#include "config/config.h"
#include "core/file_text.h"
#include "core/text.h"
#include "gpu/device/device.h"
#include "os/call_notes.h"
#include "os/rereadable_inputs.h"
#include "os/stop_signals.h"
#include "os/temporary_folder.h"
#include "report/documents/journal.h"
#include "run/cases/plan.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;

config::Config read_config(const RunFlags& flags) {
  std::error_code none;
  for (const char* way : {"perf", "callgrind", "auto"})
    if (!flags.count.empty() && flags.inputs.paths.back() == way && !fs::exists(way, none))
      throw Error("", "--count", std::string("takes its value with an equals sign: --count=") + way);
  config::Config config = read_inputs(flags.inputs);
  if (flags.no_timing) config = config::changed(config, {{"timing", {{"measure", false}}}});
  set_gates(config, flags.gates);
  return config;
}

void check_baseline(const RunFlags& flags) {
  std::error_code none;
  for (const std::string& input : flags.inputs.paths)
    if (is_stream_name(input) || !fs::is_regular_file(input, none))
      throw Error(input, "--baseline-binary", "is no file that the other program could read, too; save it to one");
  if (flags.no_timing)
    throw Error("", "--baseline-binary", "measures times, which --no-timing leaves out; take one of the two");
  probe_baseline(flags.baseline, plan_arguments(flags), os::stop_on_signals());
}

ExitCode serve(const RunFlags& flags, const config::Config& config, const run::Plan& plan) {
  if (flags.rounds_server != k_rounds_protocol)
    throw Error("", "--rounds-server",
                "version " + std::to_string(flags.rounds_server) + " is asked for, and this program speaks " +
                    std::to_string(k_rounds_protocol));
  serve_rounds(config, plan);
  return ExitCode::ok;
}

// The child process of a run.
ExitCode serve_run(const RunFlags& flags) {
  std::string line;
  if (!std::getline(std::cin, line)) return ExitCode::ok;  // the run has ended
  const ReceivedRun received = received_run(line, flags.inputs.paths.front());
  if (flags.serves_launch)
    serve_launch(received.config, received.plan);
  else
    print_callgrind_counts(received.config, received.plan, flags.count_dumps);
  return ExitCode::ok;
}

std::optional<ShardChoice> shard_of(const RunFlags& flags) {
  if (flags.shard.empty()) return std::nullopt;
  if (!flags.baseline.binary.empty())
    throw Error("", "--shard", "does not go with --baseline-binary, which measures two programs on one machine");
  return shard_choice(flags.shard);
}

// names_plugins() does not look into a pipe.
void refuse_unguarded(const RunFlags& flags, const config::Config& config) {
  const bool is_guarded = os::is_guarded() || flags.guard.is_in_process || flags.rounds_server != 0;
  if (is_guarded || !config.resolved.contains("plugins") || config.resolved["plugins"].empty()) return;
  throw Error(config.file.string(), "/plugins",
              "cannot be taken from a configuration that comes through a pipe; save it to a file, or name them by "
              "--plugin");
}

// Where RenderDoc is in this process.
void tell_captures() {
  for (const std::string& line : gpu::taken_captures()) print_message(printable(line));
}

ExitCode write_dumps_alone(const RunFlags& flags, const config::Config& config, const run::Plan& plan) {
  warn_of_budgets(config);
  if (plan.shard && plan.case_count() == 0) {
    print_message("no dump: shard " + std::to_string(plan.shard->index) + " of " + std::to_string(plan.shard->count) +
                  " has no cases");
    return ExitCode::ok;
  }
  const WrittenDumps written = write_dumps(config, plan, flags.dump_folder, flags.dump_frames);
  tell_captures();
  for (const std::string& line : written.remarks) print_message(printable(line));
  if (!flags.quiet)
    print_message(number_of(written.count, "dump") + " written; `clusterbench check " + flags.dump_folder +
                  "` reads them");
  return ExitCode::ok;
}

std::optional<ExitCode> run_part(const RunFlags& flags) {
  if (!flags.dump_folder.empty()) refuse_beside_dumps(flags);
  const config::Config config = read_config(flags);
  refuse_unguarded(flags, config);
  const CountWay way = count_way(flags.count);
  const std::optional<ShardChoice> shard = shard_of(flags);
  run::Plan plan = run::make_plan(config, flags.filter);
  if (flags.rounds_server != 0) return serve(flags, config, plan);
  if (shard && flags.dry_run) print_shards(config, plan, *shard);
  if (shard) plan = sharded_plan(flags, config, std::move(plan), *shard);
  const std::vector<ExportTarget> exports = export_targets(flags.exports);
  if (flags.dry_run) {
    const Gates refused_as_by_a_run(config.limits, flags.filter);
    print_plan(flags, config, std::move(plan));
    return ExitCode::ok;
  }
  if (!flags.dump_folder.empty()) return write_dumps_alone(flags, config, plan);
  if (!flags.baseline.binary.empty()) check_baseline(flags);
  const std::optional<ExitCode> code = measure(flags, config, plan, way, exports);
  tell_captures();
  return code;
}

// What an interrupted run has kept, as the end of a sentence.
std::string kept_text(const std::string& output) {
  if (is_stream(output)) return "; -o FILE keeps each case as it is finished, and then --resume goes on";
  const std::filesystem::path partial = report::partial_of(output);
  std::error_code none;
  if (!std::filesystem::is_regular_file(partial, none)) return "";
  const std::string text = file_text(partial.string());
  const bool has_cases = std::ranges::count(text, '\n') > 1;  // behind the header
  return has_cases ? "; what was measured is in " + partial.string() + ", --resume goes on" : "; no case was finished";
}

// A run of its own methods alone is one process. With plug-ins it is several, which share the inputs, and, without a
// result file, a journal in a folder of their own.
ExitCode run(RunFlags& flags) {
  if (flags.serves_launch || !flags.count_dumps.empty()) return serve_run(flags);
  if (flags.rounds_server != 0 || !names_plugins(flags.inputs)) return *run_part(flags);
  if (flags.dry_run || !flags.dump_folder.empty())
    return run_guarded_once(flags.guard, ExitCode::gate_failed, [&] { return *run_part(flags); });
  const os::RereadableInputs inputs(flags.inputs.paths);
  std::optional<os::TemporaryFolder> folder;
  std::optional<LaterOutput> output;  // a pipe stays open from the first part to the last one
  if (is_stream(flags.output) && !calls_in_process(flags.guard)) {
    folder.emplace();
    output.emplace(flags.output, is_for_reading(flags.output));
  }
  return run_guarded(
      flags.guard, [&] { inputs.rewind(); },
      [&](const GuardedPart& part) {
        flags.part = part;
        if (folder) flags.part.result_file = (*folder / "result.json").string();
        return run_part(flags);
      },
      [&] { return kept_text(flags.output); });
}

}  // namespace

void add_run(Command& program, Action& action) {
  auto flags = std::make_shared<RunFlags>();
  Command command = program.add_command("run", "Measure a configuration, or scenes with the default sweep");
  add_run_options(command, *flags);
  command.when_named([flags, &action] { action = [flags] { return run(*flags); }; });
}

}  // namespace clusterbench::cli
