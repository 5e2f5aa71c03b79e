// `clusterbench check DUMP...`: light lists of any program against the exact ones.

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>

#include "cli/command_line/commands.h"
#include "cli/output/output.h"
#include "core/error.h"
#include "core/text.h"
#include "core/work_in_order.h"
#include "dump/dump_template.h"
#include "dump/judge.h"
#include "report/page/page.h"

namespace clusterbench::cli {
namespace {

struct CheckFlags {
  std::vector<std::string> dumps;
  std::string json, page, engine, methods = "quick";
  int most_lost = 10, threads = 0;  // 0: as many as there are processors
  bool allow_rounding = false, quiet = false;
};

// The next step. `names_cells`: whether lost lights are named above.
std::string last_line(const std::string& verdict, bool allows_rounding, bool names_cells) {
  if (verdict == "right") return "No light is lost.";
  if (verdict == "rounding")
    return allows_rounding
               ? "No light is lost beyond rounding."
               : "Lights are lost within rounding: widen the engine's test by it, or pass --allow-rounding.";
  if (verdict == "empty")
    return "Nothing was checked: take a frame with lights in view, or correct camera and grid of the dump.";
  if (verdict == "twice") return "A light is shaded twice: the engine adds it twice, or two parts of a set overlap.";
  if (verdict == "misread")
    return "Correct the description of the dump as said first, and check again; if that is what the engine looks up "
           "by, the fault is the engine's.";
  if (verdict == "lost")
    return std::string("Lights are lost. ") +
           (names_cells ? "Compare the first cell above with the engine's own test; --json FILE has up to 1000 of them."
                        : "--json FILE has up to 1000 of them, with their cells.");
  return "The buffers are not laid out as the dump says: compare its description with the engine's shader "
         "(`clusterbench schema dump`).";
}

// "12 dumps: 3 lost, 9 right".
std::string frames_line(const std::vector<result::CheckedDump>& frames) {
  std::map<std::string, std::size_t> counts;
  for (const result::CheckedDump& frame : frames) ++counts[dump::worst_verdict({frame})];
  std::vector<std::string> words;
  for (const auto& [verdict, count] : counts) words.push_back(std::to_string(count) + " " + verdict);
  return number_of(frames.size(), "dump") + ": " + joined(words) + "\n";
}

ExitCode print_template(const CheckFlags& flags) {
  if (!flags.dumps.empty()) throw Error("", "--template", "prints a dump to fill in, and checks none");
  const CheckFlags none;
  const std::pair<bool, const char*> given[] = {{!flags.json.empty(), "--json"},
                                                {!flags.page.empty(), "--page"},
                                                {flags.methods != none.methods, "--methods"},
                                                {flags.most_lost != none.most_lost, "--most-lost"},
                                                {flags.threads != none.threads, "--threads"},
                                                {flags.allow_rounding, "--allow-rounding"},
                                                {flags.quiet, "--quiet"}};
  for (const auto& [is_given, flag] : given)
    if (is_given)
      throw Error("", flag, "has no meaning with --template, which checks nothing; allowed: --template alone");
  std::cout << std::ranges::find(dump::dump_templates(), flags.engine, &dump::DumpTemplate::name)->text;
  return ExitCode::ok;
}

std::string made_page(const CheckFlags& flags, const std::string& verdict, result::CheckPage page) {
  std::vector<std::string> words{"clusterbench", "check"};
  words.insert(words.end(), flags.dumps.begin(), flags.dumps.end());
  words.insert(words.end(), {"--page", flags.page});
  page.command = shell_command(words);
  page.verdict = verdict;
  return report::check_page(page);
}

struct CheckInputs {
  std::vector<std::filesystem::path> dumps;
  std::vector<std::string> files;  // all that are read
};

CheckInputs inputs_of(const CheckFlags& flags) {
  CheckInputs out;
  for (const std::string& given : flags.dumps)
    for (const std::filesystem::path& path : dump::dump_paths(given)) {
      out.dumps.push_back(path);
      std::ranges::move(dump::files_of(path), std::back_inserter(out.files));
    }
  return out;
}

// Fills the frames of `page` if one is asked for.
result::Check judge_all(const CheckFlags& flags, const CheckInputs& inputs, result::CheckPage& page,
                        std::ostream& out) {
  const dump::MethodChoice methods = dump::method_choice(flags.methods);
  const int threads = flags.threads > 0 ? flags.threads : processors();
  std::size_t page_room = dump::k_most_page_entries;
  result::Check checked;
  checked.check_version = 1;
  for (const std::filesystem::path& path : inputs.dumps) {
    result::CheckPageFrame* page_frame = flags.page.empty() ? nullptr : &page.frames.emplace_back();
    checked.frames.push_back(dump::judge(dump::read_dump(path), {methods, threads, page_frame, &page_room}));
    if (!flags.quiet)
      out << printable_lines(dump::check_text(checked.frames.back(), static_cast<std::size_t>(flags.most_lost)))
          << std::flush;
  }
  checked.verdict = dump::worst_verdict(checked.frames);
  return checked;
}

ExitCode check(const CheckFlags& flags) {
  if (!flags.engine.empty()) return print_template(flags);
  if (flags.dumps.empty()) throw Error("", "DUMP", "is required, or --template ENGINE for a dump to fill in");
  const CheckInputs inputs = inputs_of(flags);
  refuse_overwriting({flags.json, flags.page}, inputs.files);
  if (!flags.page.empty() && flags.page != "-" && !flags.page.ends_with(".html") && !flags.page.ends_with(".htm"))
    throw Error("", "--page",
                "is '" + flags.page + "'; allowed: the name of a page, FILE.html, or - for standard output");
  LaterOutput output(flags.json, flags.json.empty()), page_output(flags.page, flags.page.empty());
  std::ostream& out = flags.json == "-" || flags.page == "-" ? std::cerr : std::cout;
  result::CheckPage page;
  const result::Check checked = judge_all(flags, inputs, page, out);
  if (!flags.json.empty()) output.write(result::to_json(checked));
  if (!flags.page.empty()) page_output.write_text(made_page(flags, checked.verdict, std::move(page)));
  if (!flags.quiet && checked.frames.size() > 1) out << frames_line(checked.frames);
  if (!flags.quiet) out << last_line(checked.verdict, flags.allow_rounding, flags.most_lost > 0) << "\n";
  const bool is_right = checked.verdict == "right" || (flags.allow_rounding && checked.verdict == "rounding");
  return is_right ? ExitCode::ok : ExitCode::gate_failed;
}

}  // namespace

void add_check(Command& program, Action& action) {
  auto flags = std::make_shared<CheckFlags>();
  Command command = program.add_command("check", "Check the light lists of any program, from a dump of its buffers");
  command.add_option("DUMP", flags->dumps, "Dumps (.json, see `clusterbench schema dump`), or folders of them");
  std::vector<std::string> engines;
  for (const dump::DumpTemplate& row : dump::dump_templates()) engines.emplace_back(row.name);
  command
      .add_option("--template", flags->engine, "Print a dump of an engine to fill in: camera, files, numbers of lights")
      .one_of(engines);
  command.add_option("--json", flags->json, "Write the verdict as JSON to this file; -: standard output");
  command.add_option("--page", flags->page, "Write a page (.html) with the cells that lose lights in space");
  command.add_option("--most-lost", flags->most_lost, "Lost lights that are named").range(0, 1000).shows_standard();
  command.add_flag("--allow-rounding", flags->allow_rounding,
                   "Lights that are lost within rounding (0.1 m and 1 % of their range at the most) do not fail");
  command
      .add_option("--methods", flags->methods,
                  "Methods of clusterbench on the same frame: quick (if they take a few seconds), all, none, or names "
                  "with commas")
      .shows_standard();
  command.add_option("--threads", flags->threads, "Threads (default: all processors); results do not depend on them")
      .range(1, 1024);
  command.add_flag("-q,--quiet", flags->quiet, "No text; the exit code is the verdict");
  command.when_named([flags, &action] { action = [flags] { return check(*flags); }; });
}

}  // namespace clusterbench::cli
