#include "cli/running/run_flags.h"

#include <algorithm>

#include "cli/processes/launches.h"

namespace clusterbench::cli {
namespace {

void add_baseline_options(Command& command, BaselineRequest& baseline) {
  command.add_option("--baseline-binary", baseline.binary,
                     "Another clusterbench: both are measured side by side, and compared");
  command.add_option("--baseline-launches", baseline.launches, "How often both are started, at least")
      .range(2, 1000)
      .shows_standard();
  command
      .add_option("--baseline-most-launches", baseline.most_launches,
                  "How often at most, where intervals are wider than half the threshold on either side")
      .range(2, 1000)
      .shows_standard();
  command.add_option("--baseline-timeout", baseline.timeout_s, "Longest wait for one answer, in seconds")
      .range(0.1, 1e6)
      .shows_standard();
  command
      .add_option("--threshold", baseline.threshold_percent,
                  "Smallest change against the baseline that matters, in percent")
      .range(0.01, 1000.0)
      .shows_standard();
}

}  // namespace

void add_run_options(Command& command, RunFlags& flags) {
  command.add_option("INPUT", flags.inputs.paths, "One configuration (.json), or scenes (.glb, .gltf)").required();
  command.add_option(
      "-o,--output", flags.output,
      "Result file; -: standard output. Without it a terminal shows the table only, a pipe gets the result");
  command.add_option("--export", flags.exports, "FORMAT=FILE, repeatable: also write another tool's format")
      .once_a_name();
  add_image_options(command, flags.images);
  command.add_option("--filter", flags.filter,
                     "Only cases whose name has this in it, or matches it as a regular expression");
  command.add_option("--shard", flags.shard,
                     "I/N: only part I of N of the cases, as 2/7, for several machines; `clusterbench merge` takes all "
                     "parts. auto, auto/N: as an array job's environment says");
  add_config_options(command, flags.inputs);
  command.add_flag("--count{auto}", flags.count,
                   "Count instructions, too: --count=perf (hardware), =callgrind (valgrind), or what works");
  command.add_option("--count-dumps", flags.count_dumps, "").hidden();
  add_guard_options(command, flags.guard);
  add_baseline_options(command, flags.baseline);
  add_gate_options(command, flags.gates);
  command.add_option("--rounds-server", flags.rounds_server, "").hidden();
  command.add_flag(k_serve_launch, flags.serves_launch, "").hidden();
  command.add_flag("--resume", flags.resume, "Continue the interrupted run of the same -o FILE");
  command.add_flag("--dry-run", flags.dry_run,
                   "List the cases and what is skipped, and tell about how long the run takes; write nothing");
  const Option dumps = command.add_option("--write-dump", flags.dump_folder,
                                          "Folder: write the lists as dumps for `clusterbench check`, and end");
  command.add_option("--dump-frames", flags.dump_frames, "With --write-dump: frames of each case, evenly spaced")
      .needs(dumps)
      .range(1, 100000)
      .shows_standard();
  command.add_flag("--no-timing", flags.no_timing, "Count only; what is counted is the same on every machine");
  command.add_flag("-q,--quiet", flags.quiet, "No progress and no table; warnings stay");
}

std::vector<std::string> setting_arguments(const RunInputs& inputs, std::initializer_list<std::string_view> without) {
  std::vector<std::string> arguments;
  for (const config::FlagValue& setting : flag_values(inputs))
    if (std::ranges::find(without, setting.name) == without.end()) arguments.push_back(setting.text());
  return arguments;
}

}  // namespace clusterbench::cli
