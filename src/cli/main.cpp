// clusterbench: measures clustered light assignment. The only file that catches errors and decides the exit code.

#include <exception>
#include <new>

#include "cli/command_line/commands.h"
#include "cli/output/output.h"
#include "core/text.h"
#include "os/environment.h"
#include "os/standard_streams.h"
#include "os/stop_signals.h"

int main(int argc, char** argv) {
  using clusterbench::ExitCode;
  clusterbench::os::take_arguments(argc, argv);
  clusterbench::os::keep_standard_streams();
  clusterbench::os::report_size_limits_as_errors();
  clusterbench::os::end_on_signals();
  try {
    const int code = clusterbench::cli::run_command_line(argc, argv);
    clusterbench::cli::check_standard_output();
    return code;
  } catch (const clusterbench::Error& error) {
    // one line, even if names contain line breaks
    clusterbench::cli::print_message(clusterbench::printable(error.what()));
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    clusterbench::cli::print_message(
        "out of memory; measure fewer lights, cells or cases at once, or count with --threads 1, which takes least");
    return static_cast<int>(ExitCode::internal);
  } catch (const std::exception& error) {
    clusterbench::cli::print_message(std::string("internal error: ") + error.what());
    return static_cast<int>(ExitCode::internal);
  }
}
