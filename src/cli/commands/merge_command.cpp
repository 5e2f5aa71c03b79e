// `clusterbench merge RESULT...`: several results as one.

#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "cli/command_line/commands.h"
#include "cli/options/gates.h"
#include "cli/output/output.h"
#include "cli/running/verdicts.h"
#include "config/config_sections.h"
#include "config/schema/json_text.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/text.h"
#include "report/cases/timing_warnings.h"
#include "report/documents/result_file.h"
#include "report/results/merge.h"
#include "report/tables/warnings.h"

namespace clusterbench::cli {
namespace {

struct MergeFlags {
  std::vector<std::string> results;
  std::string output, baseline;
};

// The budgets of a shard's configuration, which has all keys. Their baseline is named as the shard's run named it.
config::LimitsRequest limits_of(const report::NamedPart& shard) {
  const config::JsonText text = config::parse_json_text(shard.result.config.dump(), shard.file);
  config::LimitsRequest limits = config::read_sections(text.value, text).limits;
  const std::optional<result::ShardBaseline>& baseline = shard.result.shard->baseline;
  if (!limits.baseline.empty() && !baseline)
    throw Error(shard.file, "/shard/baseline", "is missing, though /config/limits/baseline names one");
  limits.baseline = baseline ? baseline->file : "";
  return limits;
}

// Where the baseline lies. Throws Error if it is not the one that the shards were given.
std::string place_of_baseline(const MergeFlags& flags, const report::NamedPart& shard) {
  const std::optional<result::ShardBaseline>& baseline = shard.result.shard->baseline;
  if (!baseline) {
    if (flags.baseline.empty()) return "";
    throw Error("", "--baseline", "names where the baseline of the shards lies, and " + shard.file + " has none");
  }
  std::string place = flags.baseline.empty() ? baseline->file : flags.baseline;
  const std::string wanted = "the shards were measured against " + baseline->file + " with SHA-256 " +
                             baseline->sha256 + "; name that file with --baseline FILE";
  std::string found;
  try {
    found = sha256_hex(file_text(place));
  } catch (const Error& error) {
    throw Error(place, "--baseline", error.message() + ": " + wanted);
  }
  if (found != baseline->sha256) throw Error(place, "--baseline", "is another file: " + wanted);
  return place;
}

// Shards leave budgets and the baseline to this: the exit code is that of the undivided run.
ExitCode merge_shards(const MergeFlags& flags, std::vector<report::NamedPart> parts) {
  report::order_shards(parts);
  const report::NamedPart& first = parts.front();
  const config::LimitsRequest limits = limits_of(first);
  const Gates gates(limits, first.result.shard->filter.value_or(""), place_of_baseline(flags, first));
  result::Result result = report::merged(parts);
  const Verdicts verdicts = verdicts_of({}, gates, result);
  write_output(flags.output, result::to_json(result));
  std::cerr << report::warnings_text(result) << report::timing_warnings(result);
  return report_verdicts(verdicts, result);
}

ExitCode merge(const MergeFlags& flags) {
  refuse_overwriting({flags.output}, flags.results);
  refuse_overwriting({flags.output}, {flags.baseline});
  std::vector<report::NamedPart> parts;
  for (const std::string& file : flags.results) parts.push_back({file, report::read_result(file)});
  if (report::is_any_shard(parts)) return merge_shards(flags, std::move(parts));
  if (!flags.baseline.empty())
    throw Error("", "--baseline", "goes with shards (run --shard) alone, and these are whole results");
  const result::Result result = report::merged(std::move(parts));
  write_output(flags.output, result::to_json(result));
  std::cerr << report::warnings_text(result) << report::timing_warnings(result);
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
  command.add_option("--baseline", flags->baseline,
                     "Where the baseline of the shards lies, if not where their run found it; another file is refused");
  command.when_named([flags, &action] { action = [flags] { return merge(*flags); }; });
}

}  // namespace clusterbench::cli
