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

namespace {

// The file that a name will be, also where it does not exist yet: absolute, and through links that lead to nothing.
fs::path file_of(const std::string& name) {
  std::error_code none;
  fs::path file = fs::absolute(name, none);
  constexpr int k_most_links = 40;
  for (int link = 0; link < k_most_links && fs::is_symlink(fs::symlink_status(file, none)) && !fs::exists(file, none);
       ++link)
    file = file.parent_path() / fs::read_symlink(file, none);
  return fs::weakly_canonical(file, none);
}

// "-" by the name that the system has for it.
std::string name_in_system(const std::string& output) {
  return output == "-" ? "/dev/stdout" : output;
}

bool are_one_file(const std::string& a, const std::string& b) {
  std::error_code none;
  return fs::equivalent(a, b, none) || file_of(a) == file_of(b);
}

// Two of them in one stream are neither. What throws away all takes any number.
bool are_mixed(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  const std::string first = name_in_system(a), second = name_in_system(b);
  return are_one_file(first, second) && !are_one_file(first, "/dev/null");
}

// A file in a folder that is not there cannot be made, and the system says so of the file.
void refuse_missing_folder(const std::string& output) {
  std::error_code none;
  const fs::path folder = file_of(output).parent_path();
  if (fs::is_directory(folder, none)) return;
  const std::string given = fs::path(output).parent_path().string();
  throw Error(output, "",
              "cannot be written: " + (fs::exists(folder, none)
                                           ? "'" + given + "' is no folder"
                                           : "there is no folder '" + given + "'; make it first (mkdir -p)"));
}

}  // namespace

void refuse_overwriting(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (are_mixed(outputs[i], outputs[k]))
        throw Error(outputs[i] == "-" ? "standard output" : outputs[i], "",
                    "is to hold two outputs of this command: name a file for each");
    if (is_stream(outputs[i])) continue;
    refuse_missing_folder(outputs[i]);
    for (const std::string& input : inputs)
      if (!input.empty() && are_one_file(outputs[i], input))
        throw Error(outputs[i], "", "is read by this command and would be lost: name another file for the output");
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
