// `clusterbench export RESULT`: a result in the format of another tool.

#include <memory>

#include "cli/command_line/commands.h"
#include "cli/options/export_files.h"
#include "cli/output/output.h"
#include "report/cases/case_filter.h"
#include "report/documents/result_file.h"

namespace clusterbench::cli {
namespace {

struct ExportFlags {
  std::string result, format, output, filter;
  bool all = false;
};

ExitCode export_result(const ExportFlags& flags) {
  refuse_overwriting({flags.output}, {flags.result});
  const report::ExportFormat& format = report::export_format(flags.format);
  result::Result result = report::read_result(flags.result);
  report::keep_cases(result, flags.filter, flags.result);
  write_text(flags.output, report::exported(result, format, flags.all));
  return ExitCode::ok;
}

}  // namespace

void add_export(Command& program, Action& action) {
  auto flags = std::make_shared<ExportFlags>();
  Command command = program.add_command("export", "Write a result in the format of another tool");
  command.add_option("RESULT", flags->result, "A result file of `clusterbench run`").required();
  command.add_option("--format", flags->format, "One of those below").required();
  command.add_option("-o,--output", flags->output, "File to write; without it standard output");
  command.add_option("--filter", flags->filter,
                     "Only cases whose name has this in it, or matches it as a regular expression");
  command.add_flag("--all", flags->all, "All exported figures, not only the headline");
  command.footer("Formats:\n" + export_formats_text());
  command.when_named([flags, &action] { action = [flags] { return export_result(*flags); }; });
}

}  // namespace clusterbench::cli
