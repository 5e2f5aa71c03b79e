#pragma once
// Destinations of results: standard output, a device or pipe, or a file; and of messages.

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "os/output_file.h"

namespace clusterbench::cli {

// A message on standard error, prefixed with the program's name.
void print_message(const std::string& message);

// "", "-", and existing paths that are neither files nor folders.
bool is_stream(const std::string& output);

// Throws Error if not all of standard output could be written.
void check_standard_output();

// Without an output file on a terminal, a person reads: print a table, not JSON.
bool is_for_reading(const std::string& output);
// Then this hint says how to save the result.
void warn_result_not_saved();

// For the end of a message: "; a.json, b.gltf written" for ("written"); "" without a file among them.
std::string files_text(const std::vector<std::string>& outputs, const std::string& what);

// Throws Error if an output is one of the inputs, which would be lost, or the same as another output. "" is none.
void refuse_overwriting(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

// See os/output_file.h; "" and "-" are standard output. Throws Error if the text could not be written completely.
void write_text(const std::string& output, const std::string& text);
void write_output(const std::string& output, const nlohmann::ordered_json& result);

// An output that is written after minutes of measuring: checked before them; a pipe stays open meanwhile.
class LaterOutput {
 public:
  // Throws Error if nothing can be written there. `is_none`: nothing is written.
  explicit LaterOutput(const std::string& output, bool is_none = false);
  void write(const nlohmann::ordered_json& result, int threads = 1);
  void write_text(const std::string& text);

 private:
  std::unique_ptr<os::OutputFile> file_;
};

}  // namespace clusterbench::cli
