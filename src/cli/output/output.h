#pragma once
// Where results go: standard output, a device or pipe, or a file; and where messages go.

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "os/output_file.h"

namespace clusterbench::cli {

// A message on standard error, which begins with the program's name.
void tell(const std::string& message);

// "", "-", and what exists and is neither a file nor a folder.
bool is_stream(const std::string& output);

// Throws Error if standard output has not taken all that was printed.
void check_standard_output();

// Without a file on a terminal a person reads: a table, and not the JSON.
bool is_for_reading(const std::string& output);
// Then it is said how the result is kept.
void tell_of_keeping();

// Throws Error if an output is one of the inputs, which would be lost, or is another output, too. "" is none.
void refuse_overwriting(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

// os/output_file.h; "" and "-" are standard output. Throws Error if it could not be written whole.
void write_text(const std::string& output, const std::string& text);
void write_output(const std::string& output, const nlohmann::ordered_json& result);

// An output that is written after minutes of measuring: tried before them, and a pipe stays open between.
class LaterOutput {
 public:
  // Throws Error if nothing can be written there. `is_none`: nothing is written.
  explicit LaterOutput(const std::string& output, bool is_none = false);
  void write(const nlohmann::ordered_json& result);

 private:
  std::unique_ptr<os::OutputFile> file_;
};

}  // namespace clusterbench::cli
