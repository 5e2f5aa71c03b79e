// clusterbench: measures clustered light assignment. The only place that prints errors and decides the exit code.

#include <exception>
#include <iostream>

#include "cli/commands.h"
#include "core/text.h"

int main(int argc, char** argv) {
  using clusterbench::ExitCode;
  try {
    return clusterbench::cli::run_command_line(argc, argv);
  } catch (const clusterbench::Error& error) {
    std::cerr << "clusterbench: " << clusterbench::printable_lines(error.what()) << "\n";
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::cerr << "clusterbench: internal error: " << clusterbench::printable_lines(error.what()) << "\n";
    return static_cast<int>(ExitCode::internal);
  }
}
