// `clusterbench history add` and `clusterbench history show`: results over commits.

#include <algorithm>
#include <iterator>
#include <memory>

#include "cli/command_line/commands.h"
#include "cli/output/output.h"
#include "core/error.h"
#include "core/text.h"
#include "report/documents/result_file.h"
#include "report/history/history.h"
#include "report/history/history_page.h"

namespace clusterbench::cli {
namespace {

struct AddFlags {
  std::string result, file, commit;
  bool allows_changed_lights = false;
};

struct ShowFlags {
  std::string file, page;
  double max_p = measure::ChangeRule{}.max_p, min_change_percent = 100.0 * measure::ChangeRule{}.min_change;
  bool all = false;
};

ExitCode add(const AddFlags& flags) {
  refuse_overwriting({flags.file}, {flags.result});
  const result::Result result = report::read_result(flags.result);
  if (result.machines)
    throw Error(flags.result, "/machines",
                "has times of several machines, and a line of a history is of one; add the results that were merged");
  if (result.cases.empty())
    throw Error(flags.result, "/cases",
                "is empty: a history keeps the figures of cases, and of this result there are none");
  const std::string commit = flags.commit.empty() ? result.tool.git_sha : flags.commit;
  const report::Addition addition = report::add_to_history(
      flags.file, result, commit,
      {.on_long = [&] { print_message(flags.file + " is held by another process; waiting a minute for its end"); }});
  const std::string before = number_of(addition.earlier, "result") + " of " + commit;
  if (!addition.is_added)
    print_message(flags.file + " has this result of " + commit + " already; nothing was added");
  else if (addition.earlier > 0)
    print_message(flags.file + " had " + before + " already; added behind it as one more");
  if (addition.is_added && addition.other_names > 0)
    print_message("warning: " + flags.file + " has " + number_of(addition.other_names, "other name") +
                  " (hard links), which keep the history without this line");
  for (const std::string& change : addition.light_changes)
    print_message((flags.allows_changed_lights ? "warning: " : "FAILED ") + change +
                  (flags.allows_changed_lights ? ""
                   : addition.is_added
                       ? " (the result was added all the same; --allow-changed-lights if the change is meant)"
                       : " (--allow-changed-lights if that is meant)"));
  for (const std::string& change : addition.path_changes) print_message("warning: " + change);
  for (const std::string& scene : addition.new_scenes)
    print_message("warning: " + flags.file + " has no earlier lights of " + scene + " to hold these against");
  return addition.light_changes.empty() || flags.allows_changed_lights ? ExitCode::ok : ExitCode::gate_failed;
}

ExitCode show(const ShowFlags& flags) {
  refuse_overwriting({flags.page}, {flags.file});
  const std::vector<report::HistoryEntry> history = report::read_history(flags.file);
  const measure::ChangeRule rule{flags.max_p, flags.min_change_percent / 100.0};
  const std::vector<report::Series> series = report::series_of(history, rule);
  std::vector<std::string> changes = report::light_changes_in(history);
  std::ranges::copy(report::path_changes_in(history), std::back_inserter(changes));
  if (!flags.page.empty()) write_text(flags.page, report::history_page(series, history.size(), changes));
  if (flags.page != "-") write_text("-", report::history_text(series, history.size(), flags.all, rule, changes));
  return ExitCode::ok;
}

void add_add(Command& parent, Action& action) {
  auto flags = std::make_shared<AddFlags>();
  Command command = parent.add_command("add", "Add a result to a history");
  command.add_option("RESULT", flags->result, "A result file of `clusterbench run`").required();
  command.add_option("FILE", flags->file, "The history, JSON lines; made if there is none").required();
  command.add_option("--commit", flags->commit, "What was measured; without it the commit of clusterbench").utf8();
  command.add_flag("--allow-changed-lights", flags->allows_changed_lights,
                   "Lights may be others than those of the result before, and levels missing; else exit code 1");
  command.when_named([flags, &action] { action = [flags] { return add(*flags); }; });
}

void add_show(Command& parent, Action& action) {
  auto flags = std::make_shared<ShowFlags>();
  Command command = parent.add_command("show", "Where the figures of a history have changed");
  command.add_option("FILE", flags->file, "The history").required();
  command.add_option("-o,--output", flags->page, "Also a page (HTML) with a chart for each series that varies");
  command.add_option("--max-p", flags->max_p, "Of series without a change, the share that may be said to have one")
      .shows_standard()
      .range(1e-5, 1.0);
  command.add_option("--min-change", flags->min_change_percent, "Smallest change that matters, in percent")
      .shows_standard()
      .non_negative();
  command.add_flag("--all", flags->all, "Also series without changes");
  command.when_named([flags, &action] { action = [flags] { return show(*flags); }; });
}

}  // namespace

void add_history(Command& program, Action& action) {
  Command command = program.add_command("history", "Results over commits, and where they changed");
  command.needs_command();
  add_add(command, action);
  add_show(command, action);
}

}  // namespace clusterbench::cli
