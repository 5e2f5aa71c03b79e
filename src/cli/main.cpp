// clusterbench: measures clustered light assignment. The only place that prints errors and decides the exit code.

#include <exception>
#include <iostream>

#include "cli/command.h"

int main(int argc, char** argv) {
  using clusterbench::ExitCode;
  CLI::App app{"Measures clustered light assignment: exact error, list sizes, time.", "clusterbench"};
  try {
    return static_cast<int>(clusterbench::cli::run_command_line(app, argc, argv));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  } catch (const clusterbench::Error& error) {
    std::cerr << "clusterbench: " << error.what() << "\n";
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::cerr << "clusterbench: internal error: " << error.what() << "\n";
    return static_cast<int>(ExitCode::internal);
  }
}
