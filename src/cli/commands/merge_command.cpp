// `clusterbench merge RESULT...`: several results as one.

#include <memory>

#include "cli/command_line/commands.h"
#include "cli/output/output.h"
#include "report/documents/result_file.h"
#include "report/results/merge.h"

namespace clusterbench::cli {
namespace {

struct MergeFlags {
  std::vector<std::string> results;
  std::string output;
};

ExitCode merge(const MergeFlags& flags) {
  refuse_overwriting({flags.output}, flags.results);
  std::vector<report::NamedPart> parts;
  for (const std::string& file : flags.results) parts.push_back({file, report::read_result(file)});
  write_output(flags.output, result::to_json(report::merged(parts)));
  return ExitCode::ok;
}

}  // namespace

void add_merge(Command& program, Action& action) {
  auto flags = std::make_shared<MergeFlags>();
  Command command = program.add_command("merge", "Put the cases of several results into one");
  command.add_option("RESULT", flags->results, "Result files of `clusterbench run`, without a case in common")
      .required();
  command.add_option("-o,--output", flags->output, "Result file; without it the result goes to standard output");
  command.when_named([flags, &action] { action = [flags] { return merge(*flags); }; });
}

}  // namespace clusterbench::cli
