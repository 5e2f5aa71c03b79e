// `clusterbench merge RESULT...`: several results as one.

#include <memory>

#include "cli/command_line/commands.h"
#include "cli/options/gates.h"
#include "cli/output/output.h"
#include "cli/running/verdicts.h"
#include "config/config_sections.h"
#include "config/schema/json_text.h"
#include "report/documents/result_file.h"
#include "report/results/merge.h"

namespace clusterbench::cli {
namespace {

struct MergeFlags {
  std::vector<std::string> results;
  std::string output;
};

// The budgets of a shard's configuration, which has all keys.
config::LimitsRequest limits_of(const report::NamedPart& shard) {
  const config::JsonText text = config::parse_json_text(shard.result.config.dump(), shard.file);
  return config::read_sections(text.value, text).limits;
}

// Shards leave budgets and the baseline to this: the exit code is that of the undivided run.
ExitCode merge_shards(const MergeFlags& flags, const std::vector<report::NamedPart>& parts) {
  const config::LimitsRequest limits = limits_of(parts.front());
  const Gates gates(limits, parts.front().result.shard->filter.value_or(""));
  result::Result result = report::merged(parts);
  const Verdicts verdicts = verdicts_of({}, gates, result);
  write_output(flags.output, result::to_json(result));
  return report_verdicts(verdicts, result);
}

ExitCode merge(const MergeFlags& flags) {
  refuse_overwriting({flags.output}, flags.results);
  std::vector<report::NamedPart> parts;
  for (const std::string& file : flags.results) parts.push_back({file, report::read_result(file)});
  if (parts.front().result.shard) return merge_shards(flags, parts);
  write_output(flags.output, result::to_json(report::merged(std::move(parts))));
  return ExitCode::ok;
}

}  // namespace

void add_merge(Command& program, Action& action) {
  auto flags = std::make_shared<MergeFlags>();
  Command command = program.add_command("merge", "Put the cases of several results into one");
  command
      .add_option("RESULT", flags->results,
                  "Result files of `clusterbench run`: all shards of a run (--shard), or results without a case in "
                  "common")
      .required();
  command.add_option("-o,--output", flags->output, "Result file; without it the result goes to standard output");
  command.when_named([flags, &action] { action = [flags] { return merge(*flags); }; });
}

}  // namespace clusterbench::cli
