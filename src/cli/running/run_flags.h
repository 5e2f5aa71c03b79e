#pragma once
// The flags of `clusterbench run`.

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line/command.h"
#include "cli/options/gates.h"
#include "cli/options/guarded_command.h"
#include "cli/options/picture_files.h"
#include "cli/options/run_inputs.h"
#include "cli/processes/baseline_run.h"

namespace clusterbench::cli {

struct RunFlags {
  RunInputs inputs;
  std::string output, filter, count, shard;
  std::vector<std::string> exports;
  bool resume = false, dry_run = false, no_timing = false, quiet = false;

  GuardFlags guard;
  GuardedPart part;  // of a run with plug-ins

  BaselineRequest baseline;
  GateFlags gates;
  ImageFlags images;

  std::string dump_folder;
  int dump_frames = 1;

  // Set only if this program is measured beside another one.
  int rounds_server = 0;

  // Set only in a child process of a run: a launch, or a count under callgrind. Its input comes on standard input.
  bool serves_launch = false;
  std::string count_dumps;
};

// `flags` must outlive the command.
void add_run_options(Command& command, RunFlags& flags);

// The given flags of config_flags() as arguments, except those in `without`.
std::vector<std::string> setting_arguments(const RunInputs& inputs, std::initializer_list<std::string_view> without);

}  // namespace clusterbench::cli
