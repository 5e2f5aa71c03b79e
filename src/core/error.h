#pragma once
// The one exception type, thrown for errors of outside input (files, configuration, flags, disk).

#include <stdexcept>
#include <string>

namespace clusterbench {

// Exit codes of the process; the values are part of the tool's contract.
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

// An error in user input. `file` is the path or flag, `where` the location in it (line:column, JSON pointer, byte; may
// be empty), `message` the actual and the allowed value. what() is "file: where: message".
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

// The system's reason for an errno, with the way out of a limit that a user sets.
std::string reason_text(int error);

// The failed action with the system's reason from errno: "cannot be written: No space left on device".
std::string errno_text(const std::string& action);

}  // namespace clusterbench
