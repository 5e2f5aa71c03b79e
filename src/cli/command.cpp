#include "cli/command.h"

#include <string>
#include <vector>

#include "core/text.h"

namespace clusterbench::cli {
namespace {

// CLI11 only says that an argument was not expected; a mistyped subcommand deserves a guess.
void check_subcommand_name(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  const std::string word = argv[1];
  for (const std::string& name : names)
    if (name == word) return;
  throw Error("", "command line",
              "no command '" + word + "'" + did_you_mean(word, names) + "; there are: " + joined(names));
}

}  // namespace

ExitCode run_command_line(CLI::App& app, int argc, char** argv) {
  Action action;
  app.require_subcommand(0, 1);
  add_run(app, action);
  add_compare(app, action);
  add_size(app, action);
  add_report(app, action);
  add_export(app, action);
  add_scene(app, action);
  add_stress(app, action);
  add_list(app, action);
  add_schema(app, action);
  add_validate(app, action);
  add_history(app, action);
  add_merge(app, action);
  add_completion(app, action);
  add_man(app, action);
  add_version(app, action);
  check_subcommand_name(app, argc, argv);
  app.parse(argc, argv);
  if (!action) throw CLI::CallForHelp();
  return action();
}

}  // namespace clusterbench::cli
