#pragma once
// The one exception type, thrown where the outside world comes in (files, configuration, flags, disk).

#include <stdexcept>
#include <string>

namespace clusterbench {

// What a process exits with; the values are part of the tool's contract.
enum class ExitCode : int {
  ok = 0,
  gate_failed = 1,  // a conservative assigner lost a light, a regression was found
  usage = 2,        // bad flag, configuration or input file
  nothing_comparable = 3,
  inconclusive = 4,
  internal = 70,
  interrupted = 75,  // stopped before the end; `--resume` goes on
  sigint = 130,
};

// An error in something that a person gave us. `file` is the path or flag, `where` the location in it (line:column,
// JSON pointer, byte; may be empty), `message` what was found and what is allowed. what() is "file: where: message".
class Error : public std::runtime_error {
 public:
  Error(std::string file, std::string where, std::string message, ExitCode code = ExitCode::usage);

  const std::string& file() const { return file_; }
  const std::string& where() const { return where_; }
  const std::string& message() const { return message_; }
  ExitCode code() const { return code_; }

 private:
  std::string file_, where_, message_;
  ExitCode code_;
};

// What was tried and why the system refused it, by errno: "cannot be written: No space left on device".
std::string errno_says(const std::string& what);

}  // namespace clusterbench
