// `clusterbench size RESULT`: what to allocate, and the code that watches it.

#include <iostream>

#include "cli/commands.h"
#include "core/text.h"
#include "report/result_file.h"
#include "report/size.h"

namespace clusterbench::cli {

void add_size(Command& program, Action& action) {
  Command command = program.add_command(
      "size", "Size the light-list allocation from a result: high-water marks, margins, C++ constants");
  auto file = std::make_shared<std::string>();
  command.add_option("RESULT", *file, "A result file of `clusterbench run`").required();
  command.when_named([file, &action] {
    action = [file] {
      std::cout << printable_lines(report::size_report(report::read_result(*file)));
      return ExitCode::ok;
    };
  });
}

}  // namespace clusterbench::cli
