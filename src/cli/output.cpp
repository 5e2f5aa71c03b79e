#include "cli/output.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>

#include "core/error.h"
#include "core/text.h"
#include "report/compact_json.h"

namespace clusterbench::cli {

namespace fs = std::filesystem;

void tell(const std::string& message) {
  std::cerr << "clusterbench: " << printable_lines(message) << "\n";
}

bool is_stream(const std::string& output) {
  std::error_code none;
  const fs::file_status status = fs::status(output, none);
  return output.empty() || output == "-" ||
         (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status));
}

void keep_standard_streams() {
  for (const auto& [stream, way] :
       {std::pair{STDIN_FILENO, O_WRONLY}, {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_WRONLY}})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", way);  // takes the smallest number that is free
}

void check_standard_output() {
  std::cout << std::flush;
  if (!std::cout) throw Error("standard output", "", "could not be written whole", ExitCode::internal);
}

bool is_for_reading(const std::string& output) {
  return output.empty() && isatty(STDOUT_FILENO) != 0;
}

void tell_of_keeping() {
  tell("the result is not kept; -o FILE keeps it, -o - prints it as JSON");
}

void probe_output(const std::string& output) {
  if (output.empty() || output == "-") return;
  std::error_code unknown;
  const bool is_new = !fs::exists(output, unknown);
  std::ofstream file(output, std::ios::binary | std::ios::app);  // what is there stays until there is better
  if (is_new || is_stream(output)) file << ' ' << std::flush;
  if (!file) throw Error(output, "", errno_says("cannot be written"));
  file.close();
  if (is_new) fs::remove(output, unknown);
}

void refuse_overwriting(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  const auto are_one = [](const std::string& a, const std::string& b) {
    std::error_code none;
    return fs::equivalent(a, b, none) || fs::weakly_canonical(a, none) == fs::weakly_canonical(b, none);
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (is_stream(outputs[i])) continue;
    for (const std::string& input : inputs)
      if (!input.empty() && are_one(outputs[i], input))
        throw Error(outputs[i], "", "is read by this command and would be lost: name another file for the output");
    for (std::size_t k = 0; k < i; ++k)
      if (!is_stream(outputs[k]) && are_one(outputs[i], outputs[k]))
        throw Error(outputs[i], "", "is to hold two outputs of this command: name a file for each");
  }
}

void write_text(const std::string& output, const std::string& text) {
  std::ofstream file;
  const bool has_file = !output.empty() && output != "-";
  if (has_file) file.open(output, std::ios::binary);
  if (has_file && !file) throw Error(output, "", errno_says("cannot be written"));
  std::ostream& out = has_file ? file : std::cout;
  out << text << std::flush;
  if (!out) throw Error(has_file ? output : "standard output", "", "could not be written whole", ExitCode::internal);
}

void write_output(const std::string& output, const nlohmann::ordered_json& result) {
  write_text(output, report::compact_json(result));
}

}  // namespace clusterbench::cli
