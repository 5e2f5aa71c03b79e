// `clusterbench report RESULT...`: results as one page for a browser.

#include <iostream>

#include "cli/command_line/commands.h"
#include "cli/output/output.h"
#include "core/text.h"
#include "report/cases/case_filter.h"
#include "report/documents/result_file.h"
#include "report/page/page.h"
#include "report/page/page_pictures.h"
#include "report/results/kept_cases.h"

namespace clusterbench::cli {
namespace {

struct ReportOptions {
  std::vector<std::string> files;
  std::string output, images, filter;
};

std::string command_of(const ReportOptions& options) {
  std::vector<std::string> words{"clusterbench", "report"};
  words.insert(words.end(), options.files.begin(), options.files.end());
  if (!options.images.empty()) words.insert(words.end(), {"--images", options.images});
  if (!options.filter.empty()) words.insert(words.end(), {"--filter", options.filter});
  if (!options.output.empty()) words.insert(words.end(), {"-o", options.output});
  return printable(shell_command(words));
}

ExitCode write_report(const ReportOptions& options) {
  refuse_overwriting({options.output}, options.files);
  std::vector<report::NamedResult> results;
  for (const std::string& file : options.files) {
    results.push_back({file, report::read_result(file)});
    report::keep_cases_and_conclude(results.back().result, options.filter, file);
  }
  const std::vector<report::PagePicture> pictures =
      options.images.empty() ? std::vector<report::PagePicture>{} : report::page_pictures(options.images, results);
  const std::string page = report::page(results, command_of(options), pictures);
  write_text(options.output, page);
  if (!is_stream(options.output))
    std::cerr << options.output << ": a page of " << page.size() / 1024 << " KiB; open it in a browser\n";
  return ExitCode::ok;
}

}  // namespace

void add_report(Command& program, Action& action) {
  Command command =
      program.add_command("report", "Show results as one page for a browser: ranking, charts, tables; works from disk");
  auto options = std::make_shared<ReportOptions>();
  command.add_option("RESULT", options->files, "Result files of `clusterbench run`; several are shown side by side")
      .required();
  command.add_option("--images", options->images,
                     "DIR: also show the pictures that `clusterbench run --images DIR` has made of these cases");
  command.add_option("--filter", options->filter,
                     "Only cases whose names have this in them, or match it as a regular expression");
  command.add_option("-o,--output", options->output, "Where the page goes; standard output by default");
  command.when_named([options, &action] { action = [options] { return write_report(*options); }; });
}

}  // namespace clusterbench::cli
