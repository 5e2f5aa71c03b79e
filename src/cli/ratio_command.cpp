// `clusterbench ratio RESULT`: how much longer does one method take than another?

#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/output.h"
#include "core/text.h"
#include "report/ratios.h"
#include "report/result_file.h"

namespace clusterbench::cli {
namespace {

struct RatioFlags {
  std::string result, methods, csv;
  bool all_pairs = false;
};

ExitCode show_ratios(const RatioFlags& flags) {
  refuse_overwriting({flags.csv}, {flags.result});
  const nlohmann::ordered_json result = report::read_result(flags.result);
  const std::string table = report::ratio_table(result, flags.methods, flags.all_pairs);
  if (table.empty())
    throw Error(flags.result, "", "has no times" + (flags.methods.empty() ? "" : " of methods like " + flags.methods));
  if (!flags.csv.empty()) write_text(flags.csv, report::ratio_csv(result, flags.methods));
  if (flags.csv != "-") std::cout << printable_lines(table);
  return ExitCode::ok;
}

}  // namespace

void add_ratio(Command& program, Action& action) {
  auto flags = std::make_shared<RatioFlags>();
  Command command =
      program.add_command("ratio", "How much longer one method takes than another, with intervals, from one result");
  command.add_option("RESULT", flags->result, "A result file of `clusterbench run`").required();
  command.add_option("--methods", flags->methods, "Only methods whose name matches this regular expression");
  command.add_flag("--all-pairs", flags->all_pairs, "Each method beside each one that is faster");
  command.add_option("--csv", flags->csv, "Also write all pairs as CSV to this file");
  command.when_named([flags, &action] { action = [flags] { return show_ratios(*flags); }; });
}

}  // namespace clusterbench::cli
