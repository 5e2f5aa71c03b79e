#pragma once
// Another program, started by this one, which reads its output. It does not outlive this one.

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace clusterbench::os {

// The file of this program, as a command's first word; on Linux even if it has been replaced or removed since the
// start.
const std::string& this_program();
// The same as a path that another program can open.
std::string this_program_for_others();
// The command line of this process.
std::vector<std::string> own_command_line();

// A file without a name, in memory: nothing can remain of it.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text = "");  // to be read from its beginning
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  // A descriptor or handle of the system.
  std::intptr_t descriptor() const { return descriptor_; }
  // Its last 2,000 bytes.
  std::string tail() const;

 private:
  std::intptr_t descriptor_;
};

struct Ending {
  std::string how;         // "" if it ended well; else "exit code 3", "signal 11 (...)", "cannot be started: ..."
  int exit_code = -1;      // if it has one
  int wait_status = -1;    // as waitpid() tells it, on Windows the exit code; -1: it never ran
  std::string error_tail;  // the end of its standard error
};

// Runs `command` (searched in PATH) to its end, with `input` as its standard input, and passes each line of its
// standard output to `on_line`. It is terminated when `stop` becomes true or `on_line` throws.
Ending run_child(const std::vector<std::string>& command, const std::string& input,
                 const std::function<void(const std::string& line)>& on_line, const std::atomic<bool>& stop);

// Another program that answers line by line. It is ended, and waited for, with this object.
class Conversation {
 public:
  // Starts `command`. Throws Error if it cannot be started.
  explicit Conversation(const std::vector<std::string>& command);
  ~Conversation();
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;

  // To a program that has ended nothing is sent, without an error: receive_line() reports its end.
  void send_line(const std::string& line);

  enum class Received { line, end, timeout, stop };
  // Waits at most `seconds` for the next line.
  Received receive_line(std::string& line, double seconds, const std::atomic<bool>& stop);

  // Ends it if it still runs.
  Ending end();
  // The end of its standard error so far.
  std::string error_tail() const { return errors_.tail(); }

 private:
  MemoryFile errors_;
  std::intptr_t process_ = -1;
  std::intptr_t to_ = -1, from_ = -1;  // its standard input and output
  std::string received_;
  Ending ending_;
};

}  // namespace clusterbench::os
