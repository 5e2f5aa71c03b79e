#include "cli/child.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "core/error.h"

namespace clusterbench::cli {
namespace {

class Child {
 public:
  Child(const std::vector<std::string>& command, const std::filesystem::path& errors) {
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0)
      throw Error("", command.front(), std::string("no pipe for its output: ") + std::strerror(errno),
                  ExitCode::internal);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    start_error_ = posix_spawnp(&pid_, arguments.front(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(pipe[1]);
    out_ = pipe[0];
  }
  ~Child() {
    terminate();
    if (is_running()) ::waitpid(pid_, nullptr, 0);
    ::close(out_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // Waits at most 100 ms for output and adds it to `text`; false at its end.
  bool read(std::string& text) const {
    constexpr int k_wait_ms = 100;
    pollfd waiting{out_, POLLIN, 0};
    if (::poll(&waiting, 1, k_wait_ms) <= 0) return true;
    std::array<char, 4096> some{};
    const ssize_t bytes = ::read(out_, some.data(), some.size());
    if (bytes > 0) text.append(some.data(), static_cast<std::size_t>(bytes));
    return bytes > 0 || (bytes < 0 && errno == EINTR);
  }

  void terminate() const {
    if (is_running()) ::kill(pid_, SIGTERM);
  }

  std::string end() {
    if (start_error_ != 0) return std::string("cannot be started: ") + std::strerror(start_error_);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    has_ended_ = true;
    if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
    return WEXITSTATUS(status) == 0 ? "" : "exit code " + std::to_string(WEXITSTATUS(status));
  }

 private:
  bool is_running() const { return start_error_ == 0 && !has_ended_; }

  pid_t pid_ = -1;
  int out_ = -1, start_error_ = 0;
  bool has_ended_ = false;
};

}  // namespace

std::string run_child(const std::vector<std::string>& command, const std::filesystem::path& errors,
                      const std::function<void(const std::string& line)>& on_line, const std::atomic<bool>& stop) {
  Child child(command, errors);
  std::string text;
  while (!stop && child.read(text))
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
      on_line(text.substr(0, end));
      text.erase(0, end + 1);
    }
  if (stop) child.terminate();
  return child.end();
}

}  // namespace clusterbench::cli
