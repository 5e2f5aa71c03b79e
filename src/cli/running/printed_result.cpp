#include "cli/running/printed_result.h"

#include <algorithm>
#include <iostream>

#include "cli/output/output.h"
#include "core/text.h"
#include "os/terminal.h"
#include "report/cases/timing_warnings.h"
#include "report/choosing/conclusion.h"
#include "report/presets/preset_ranking.h"
#include "report/tables/table.h"
#include "report/tables/warnings.h"

namespace clusterbench::cli {
namespace {

// "next: clusterbench size level.glb --filter '...'": the command that sizes the buffers of the recommended cases, from
// the same scenes with more frames, or from the result if the scenes came through a pipe. "" if no case is recommended.
std::string next_text(const RunFlags& flags, const result::Result& result) {
  const std::vector<std::string> recommended = report::taken_names(result);
  if (recommended.empty()) return "";
  std::vector<std::string> words{"clusterbench", "size"};
  const auto add = [&](const std::vector<std::string>& more) { words.insert(words.end(), more.begin(), more.end()); };
  const bool is_of_result = !is_stream(flags.output) && std::ranges::any_of(flags.inputs.paths, is_stream);
  if (is_of_result) {
    add({flags.output});
  } else {
    add(flags.inputs.paths);
    add(setting_arguments(flags.inputs, {"--fail-if", "--launches", "--rounds"}));
  }
  if (!is_of_result || recommended.size() == 1) add({"--filter", report::filter_of(recommended.front(), result)});
  return "next: " + shell_command(words) + "   sizes its buffers\n";
}

}  // namespace

void print_table(const RunFlags& flags, const result::Result& result) {
  if (flags.quiet) {
    std::cerr << report::warnings_text(result) << report::unable_text(result.skipped)
              << report::timing_warnings(result);
    return;
  }
  const bool for_reading = is_for_reading(flags.output);
  std::ostream& out = for_reading ? std::cout : std::cerr;
  out << report::render_table(result,
                              os::terminal(for_reading ? os::StandardStream::output : os::StandardStream::error).colour)
      << std::flush;
  if (for_reading) warn_result_not_saved();
}

void print_conclusion(const RunFlags& flags, const result::Result& result) {
  std::ostream& out = is_for_reading(flags.output) ? std::cout : std::cerr;
  if (!report::run_failures(result).empty())
    out << "conclusion: " << report::failed_conclusion(result) << ".\n" << std::flush;
  else
    out << printable_lines(next_text(flags, result)) << report::conclusions_text(result)
        << report::preset_conclusions(result) << std::flush;
}

}  // namespace clusterbench::cli
