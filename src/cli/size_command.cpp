// `clusterbench size RESULT`: what to allocate, and the code that watches it.

#include <iostream>

#include "cli/commands.h"
#include "core/text.h"
#include "report/result_file.h"
#include "report/size.h"

namespace clusterbench::cli {

void add_size(Command& program, Action& action) {
  Command command = program.add_command(
      "size", "Size the light-list allocation from a result: high-water marks, margins, constants for C++ or a shader");
  auto file = std::make_shared<std::string>();
  command.add_option("RESULT", *file, "A result file of `clusterbench run`").required();
  auto request = std::make_shared<report::SizeRequest>();
  command.add_option("--filter", request->filter, "Only cases whose name matches this regular expression");
  command.add_option("--format", request->format, "Language of the constants")
      .one_of(report::size_formats())
      .shows_standard();
  command.add_flag("--all", request->all, "Every case, not the best one of each scene, camera and grid");
  command.when_named([file, request, &action] {
    action = [file, request] {
      const std::string text = report::size_report(report::read_result(*file), *request);
      std::cout << (request->format == "json" ? text : printable_lines(text));
      return ExitCode::ok;
    };
  });
}

}  // namespace clusterbench::cli
