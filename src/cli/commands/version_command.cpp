// `clusterbench --version [--json]`.

#include <iostream>

#include "cli/command_line/commands.h"
#include "core/libraries.h"
#include "run/records/records.h"

namespace clusterbench::cli {
namespace {

// What this build lacks; nothing of a build with all libraries.
void print_missing_libraries() {
  for (const OptionalLibrary& row : optional_libraries())
    if (!row.is_built_in) std::cout << "without " << row.name << ": " << row.without << "\n";
}

ExitCode print_version(bool as_json) {
  const run::ToolFacts tool = run::tool_facts();
  if (!as_json) {
    std::cout << "clusterbench " << tool.version << " (" << tool.git_sha << ", " << tool.compiler << ", "
              << tool.build_type << ")\n";
    print_missing_libraries();
    return ExitCode::ok;
  }
  auto json = result::to_json(run::record_of(tool));
  for (const OptionalLibrary& row : optional_libraries()) json["built_in"][row.name] = row.is_built_in;
  std::cout << json.dump(2) << "\n";
  return ExitCode::ok;
}

}  // namespace

void add_version(Command& program, Action& action) {
  struct Flags {
    bool version = false, as_json = false;
  };
  auto flags = std::make_shared<Flags>();
  Option version = program.add_flag("--version", flags->version, "Print the version");
  program
      .add_flag("--json", flags->as_json,
                "With --version: as JSON, with compiler, flags, libraries and which optional ones are built in")
      .needs(version);
  program.when_named([flags, &action] {
    if (flags->version) action = [flags] { return print_version(flags->as_json); };
  });
}

}  // namespace clusterbench::cli
