#pragma once
// The subcommands. Each add_* hangs one subcommand into the tree and, when the user names it, sets `action`.

#include <CLI/CLI.hpp>
#include <functional>

#include "core/error.h"

namespace clusterbench::cli {

using Action = std::function<ExitCode()>;

void add_run(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_size(CLI::App& app, Action& action);
void add_report(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_scene(CLI::App& app, Action& action);
void add_stress(CLI::App& app, Action& action);
void add_list(CLI::App& app, Action& action);
void add_schema(CLI::App& app, Action& action);
void add_validate(CLI::App& app, Action& action);
void add_history(CLI::App& app, Action& action);
void add_merge(CLI::App& app, Action& action);
void add_completion(CLI::App& app, Action& action);
void add_man(CLI::App& app, Action& action);
void add_version(CLI::App& app, Action& action);

// Parses the command line and does what it says. Throws Error; CLI::ParseError for a bad command line.
ExitCode run_command_line(CLI::App& app, int argc, char** argv);

}  // namespace clusterbench::cli
