#include "cli/output.h"

#include <filesystem>
#include <fstream>
#include <iostream>

#include "core/error.h"

namespace clusterbench::cli {

namespace fs = std::filesystem;

bool is_stream(const std::string& output) {
  return output.empty() || output == "-" ||
         (fs::exists(output) && !fs::is_regular_file(output) && !fs::is_directory(output));
}

void probe_output(const std::string& output) {
  if (output.empty() || output == "-") return;
  std::ofstream file(output, std::ios::binary);
  file << ' ' << std::flush;
  if (!file) throw Error(output, "", "cannot be written");
}

void write_output(const std::string& output, const nlohmann::ordered_json& result) {
  std::ofstream file;
  if (!output.empty() && output != "-") file.open(output, std::ios::binary);
  std::ostream& out = file.is_open() ? file : std::cout;
  out << result.dump(1) << '\n' << std::flush;
  if (!out)
    throw Error(output.empty() ? "standard output" : output, "", "the result could not be written", ExitCode::internal);
}

}  // namespace clusterbench::cli
