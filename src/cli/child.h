#pragma once
// Another program, run from here and listened to.

#include <sys/types.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace clusterbench::cli {

// Runs `command` (looked for in PATH, without standard input) to its end and hands on each line of its standard output;
// its standard error goes to the file `errors`. When `stop` becomes true it is terminated, as it is when `on_line`
// throws.
// "" if it ended well; else how it ended: "exit code 3", "signal 9", "cannot be started: ...".
std::string run_child(const std::vector<std::string>& command, const std::filesystem::path& errors,
                      const std::function<void(const std::string& line)>& on_line, const std::atomic<bool>& stop);

// Another program that answers line by line. It is ended, and waited for, with this object.
class Conversation {
 public:
  // Starts `command`; its standard error goes to the file `errors`. Throws Error if it cannot be started.
  Conversation(const std::vector<std::string>& command, const std::filesystem::path& errors);
  ~Conversation();
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;

  // False if the program has closed its ears.
  bool say(const std::string& line);

  enum class Heard { line, end, nothing, stop };
  // Waits at most `seconds` for the next line.
  Heard hear(std::string& line, double seconds, const std::atomic<bool>& stop);

  // Ends it if it still runs. How it ended, as run_child() says it.
  std::string end();

 private:
  pid_t pid_ = -1;
  int socket_ = -1;
  std::string heard_, ending_;
};

}  // namespace clusterbench::cli
