#pragma once
// The subcommands. Each add_* adds one subcommand to the tree and sets `action` when the user names it.

#include "cli/command_line/command.h"
#include "core/error.h"

namespace clusterbench::cli {

using Action = std::function<ExitCode()>;

void add_run(Command& program, Action& action);
void add_compare(Command& program, Action& action);
void add_ratio(Command& program, Action& action);
void add_size(Command& program, Action& action);
void add_recommend(Command& program, Action& action);
void add_report(Command& program, Action& action);
void add_export(Command& program, Action& action);
void add_scene(Command& program, Action& action);
void add_stress(Command& program, Action& action);
void add_worst_case(Command& program, Action& action);
void add_light_map(Command& program, Action& action);
void add_check(Command& program, Action& action);
void add_plugin(Command& program, Action& action);
void add_list(Command& program, Action& action);
void add_schema(Command& program, Action& action);
void add_validate(Command& program, Action& action);
void add_history(Command& program, Action& action);
void add_merge(Command& program, Action& action);
void add_completion(Command& program, Action& action);
void add_man(Command& program, Action& action);
void add_version(Command& program, Action& action);

// Parses the command line and runs its command. Throws Error.
int run_command_line(int argc, char** argv);

}  // namespace clusterbench::cli
