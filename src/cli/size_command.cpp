// `clusterbench size RESULT`: what to allocate, and the code that watches it.

#include <iostream>

#include "cli/command.h"
#include "report/result_file.h"
#include "report/size.h"

namespace clusterbench::cli {

void add_size(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "size", "Size the light-list allocation from a result: high-water marks, margins, C++ constants");
  auto file = std::make_shared<std::string>();
  command->add_option("RESULT", *file, "A result file of `clusterbench run`")->required();
  command->callback([file, &action] {
    action = [file] {
      std::cout << report::size_report(report::read_result(*file));
      return ExitCode::ok;
    };
  });
}

}  // namespace clusterbench::cli
