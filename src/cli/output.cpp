#include "cli/output.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>

#include "core/error.h"
#include "core/text.h"

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

bool is_for_reading(const std::string& output) {
  return output.empty() && isatty(STDOUT_FILENO) != 0;
}

void tell_of_keeping() {
  tell("the result is not kept; -o FILE keeps it, -o - prints it as JSON");
}

void probe_output(const std::string& output) {
  if (output.empty() || output == "-") return;
  std::ofstream file(output, std::ios::binary);
  file << ' ' << std::flush;
  if (!file) throw Error(output, "", "cannot be written");
}

void write_text(const std::string& output, const std::string& text) {
  std::ofstream file;
  const bool has_file = !output.empty() && output != "-";
  if (has_file) file.open(output, std::ios::binary);
  if (has_file && !file) throw Error(output, "", "cannot be written");
  std::ostream& out = has_file ? file : std::cout;
  out << text << std::flush;
  if (!out) throw Error(has_file ? output : "standard output", "", "could not be written whole", ExitCode::internal);
}

void write_output(const std::string& output, const nlohmann::ordered_json& result) {
  write_text(output, result.dump(1) + '\n');
}

}  // namespace clusterbench::cli
