// `clusterbench compare BASE NEW`: has anything become slower, or any count changed?

#include <fstream>
#include <iostream>
#include <memory>

#include "cli/command_line/commands.h"
#include "cli/output/output.h"
#include "core/text.h"
#include "report/cases/case_filter.h"
#include "report/comparing/compare.h"
#include "report/comparing/compare_advice.h"
#include "report/documents/result_file.h"

namespace clusterbench::cli {
namespace {

struct CompareFlags {
  std::string base, next, markdown, json, filter;
  double threshold_percent = 2.0;
  bool gates_separate = false, is_strict = false, is_forced = false;
};

// Reports a gate on times that cannot be applied.
void check_gate(const CompareFlags& flags, const result::Comparison& comparison) {
  if (!flags.gates_separate || !comparison.left_out.times) return;
  throw Error(flags.next, "",
              "its times cannot be compared with those of " + flags.base + ": " +
                  joined(*comparison.left_out.times, "; ") + "; --force compares all the same",
              ExitCode::nothing_comparable);
}

ExitCode compare(const CompareFlags& flags) {
  refuse_overwriting({flags.markdown, flags.json}, {flags.base, flags.next});
  result::Result base = report::read_result(flags.base), next = report::read_result(flags.next);
  report::keep_cases(base, flags.filter, flags.base);
  report::keep_cases(next, flags.filter, flags.next);
  const result::Comparison comparison =
      report::compare_results(base, next, flags.threshold_percent / 100.0, {flags.gates_separate, flags.is_forced});
  check_gate(flags, comparison);
  if (flags.markdown != "-" && flags.json != "-") std::cout << printable_lines(report::comparison_text(comparison));
  if (!flags.markdown.empty()) write_text(flags.markdown, report::comparison_markdown(comparison));
  if (!flags.json.empty()) write_output(flags.json, result::to_json(comparison));
  const ExitCode code = report::outcome(comparison, flags.is_strict);
  if (code == ExitCode::nothing_comparable)
    print_message(report::advice_on_nothing(base, next, flags.base, flags.next));
  return code;
}

}  // namespace

void add_compare(Command& program, Action& action) {
  auto flags = std::make_shared<CompareFlags>();
  Command command = program.add_command(
      "compare",
      "Compare two results: exit code 1 where what is counted, or a time measured side by side, became worse");
  command.add_option("BASE", flags->base, "A result file of `clusterbench run`").required();
  command.add_option("NEW", flags->next, "The result that may have become worse").required();
  command.add_option("--threshold", flags->threshold_percent, "Smallest change of time that matters, in percent")
      .range(0.01, 1000.0)
      .shows_standard();
  command.add_option("--filter", flags->filter,
                     "Only cases whose name has this in it, or matches it as a regular expression");
  command.add_option("--markdown", flags->markdown,
                     "Write the comparison for a pull request to this file (-: in place of the text)");
  command.add_option("--json", flags->json, "Write the comparison as JSON to this file (-: in place of the text)");
  command.add_flag(
      "--gate-separate", flags->gates_separate,
      "Verdicts on times of separate runs, too: for a machine that does nothing else, false alarms elsewhere");
  command.add_flag(
      "--strict", flags->is_strict,
      "Exit with 4 where a verdict is inconclusive, a case or a part of one is missing, or instructions cannot be "
      "compared");
  command.add_flag("--force", flags->is_forced, "Compare times and instructions of different machines or flags, too");
  command.when_named([flags, &action] { action = [flags] { return compare(*flags); }; });
}

}  // namespace clusterbench::cli
