#include "cli/output/output.h"

#include <cerrno>
#include <filesystem>
#include <iostream>

#include "core/error.h"
#include "core/text.h"
#include "os/standard_streams.h"
#include "os/terminal.h"
#include "report/documents/compact_json.h"

namespace clusterbench::cli {

namespace fs = std::filesystem;

void print_message(const std::string& message) {
  std::cerr << "clusterbench: " << printable_lines(message) << "\n";
}

bool is_stream(const std::string& output) {
  return os::output_target(output).is_stream;
}

std::string files_text(const std::vector<std::string>& outputs, const std::string& what) {
  std::vector<std::string> files;
  for (const std::string& output : outputs)
    if (!is_stream(output)) files.push_back(output);
  return files.empty() ? "" : "; " + joined(files) + " " + what;
}

void check_standard_output() {
  errno = 0;
  if (std::cout.rdbuf()->pubsync() == 0 && std::cout) return;
  const std::string problem = "could not be written whole";
  throw Error("standard output", "",
              errno == 0       ? problem
              : errno == EBADF ? problem + ": it is closed"
                               : errno_text(problem),
              ExitCode::internal);
}

bool is_for_reading(const std::string& output) {
  return output.empty() && os::is_terminal(os::StandardStream::output);
}

void warn_result_not_saved() {
  print_message("the result is not kept; -o FILE keeps it, -o - prints it as JSON");
}

namespace {

// The absolute path that a name refers to, even if the file does not exist yet; dangling links are followed.
fs::path file_of(const std::string& name) {
  std::error_code none;
  return fs::weakly_canonical(fs::absolute(os::output_target(name).path, none), none);
}

bool are_one_file(const std::string& a, const std::string& b) {
  std::error_code none;
  return fs::equivalent(os::output_target(a).path, os::output_target(b).path, none) || file_of(a) == file_of(b);
}

// Two documents in one stream are both unreadable. The null device accepts any number.
bool are_mixed(const std::string& a, const std::string& b) {
  return !a.empty() && !b.empty() && are_one_file(a, b) && !are_one_file(a, "/dev/null");
}

}  // namespace

void refuse_overwriting(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (are_mixed(outputs[i], outputs[k]))
        throw Error(
            outputs[i] == "-" ? "standard output" : outputs[i], "",
            std::string("is to hold two outputs of this command") +
                (outputs[i] == "-" ? ", and a result without -o FILE is one" : " (--path X.gltf writes X.json, too)") +
                ": name a file for each");
    const os::OutputTarget target = os::output_target(outputs[i]);
    os::require_folder_of(outputs[i]);
    for (const std::string& input : inputs) {
      if (input.empty()) continue;
      const bool is_lost =
          target.is_stream ? os::is_open_file(target.descriptor, input) : are_one_file(outputs[i], input);
      if (is_lost)
        throw Error(outputs[i].empty() || outputs[i] == "-" ? "standard output" : outputs[i], "",
                    "is read by this command and would be lost: name another file for the output");
    }
  }
}

void write_text(const std::string& output, const std::string& text) {
  os::write_file(output, text);
}

void write_output(const std::string& output, const nlohmann::ordered_json& result) {
  write_text(output, report::compact_json(result));
}

LaterOutput::LaterOutput(const std::string& output, bool is_none) {
  if (is_none) return;
  file_ = std::make_unique<os::OutputFile>(output);
  file_->probe();
}

void LaterOutput::write(const nlohmann::ordered_json& result, int threads) {
  if (file_) file_->write(report::compact_json(result, threads));
}

void LaterOutput::write_text(const std::string& text) {
  if (file_) file_->write(text);
}

}  // namespace clusterbench::cli
