// `clusterbench ratio RESULT`: how much longer does one method take than another?

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>

#include "cli/command_line/commands.h"
#include "cli/output/output.h"
#include "core/text.h"
#include "report/comparing/ratios.h"
#include "report/documents/result_file.h"

namespace clusterbench::cli {
namespace {

struct RatioFlags {
  std::string result, csv, json, markdown;
  report::RatioRequest request;
  bool all_pairs = false;  // of the tables: not a ranking
};

ExitCode show_ratios(const RatioFlags& flags) {
  refuse_overwriting({flags.csv, flags.json, flags.markdown}, {flags.result});
  const report::RatioRequest& request = flags.request;
  const result::Ratios ratios = report::ratios_of(report::read_result(flags.result), request);
  if (ratios.blocks.empty())
    throw Error(
        flags.result, "",
        "has no times of the processor" + (request.methods.empty() ? "" : " of methods like " + request.methods));
  if (!flags.csv.empty()) write_text(flags.csv, report::ratio_csv(ratios));
  if (!flags.json.empty()) write_output(flags.json, result::to_json(ratios));
  if (!flags.markdown.empty()) write_text(flags.markdown, report::ratio_markdown(ratios, flags.all_pairs));
  const auto is_standard_output = [](const std::string& output) { return output == "-"; };
  if (std::ranges::none_of(std::array{flags.csv, flags.json, flags.markdown}, is_standard_output))
    std::cout << printable_lines(report::ratio_table(ratios, flags.all_pairs));
  return ExitCode::ok;
}

}  // namespace

void add_ratio(Command& program, Action& action) {
  auto flags = std::make_shared<RatioFlags>();
  Command command =
      program.add_command("ratio", "How much longer one method takes than another, with intervals, from one result");
  command.add_option("RESULT", flags->result, "A result file of `clusterbench run`").required();
  command.add_option("--methods", flags->request.methods,
                     "Only methods whose name has this in it, or matches it as a regular expression");
  command.add_flag("--all-pairs", flags->all_pairs, "Each method beside each one that is faster");
  command.add_flag("--across-grids", flags->request.across_grids,
                   "All grids of a scene, camera and viewport in one ranking");
  command.add_option("--csv", flags->csv, "Write all pairs as CSV to this file (-: in place of the table)");
  command.add_option("--json", flags->json, "Write all pairs as JSON to this file");
  command.add_option("--markdown", flags->markdown, "Write the table as Markdown to this file");
  command.when_named([flags, &action] { action = [flags] { return show_ratios(*flags); }; });
}

}  // namespace clusterbench::cli
