#include "cli/child.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstring>

#include "core/error.h"

namespace clusterbench::cli {
namespace {

// Starts `command` with these file descriptors; 0 or what went wrong.
int spawn(const std::vector<std::string>& command, posix_spawn_file_actions_t& actions,
          const std::filesystem::path& errors, pid_t& pid) {
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int error = posix_spawnp(&pid, arguments.front(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

std::string start_error_text(int error) {
  return std::string("cannot be started: ") + std::strerror(error);
}

// Waits for its end, and says how that was.
std::string wait_for(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : "exit code " + std::to_string(WEXITSTATUS(status));
}

// Without waiting for it; it can still be waited for.
bool has_exited(pid_t pid) {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid;
}

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
    start_error_ = spawn(command, actions, errors, pid_);
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
    if (start_error_ != 0) return start_error_text(start_error_);
    has_ended_ = true;
    return wait_for(pid_);
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

Conversation::Conversation(const std::vector<std::string>& command, const std::filesystem::path& errors) {
  std::array<int, 2> ends{};  // one socket is both its standard input and its standard output
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw Error(command.front(), "", std::string("no socket to talk to it: ") + std::strerror(errno),
                ExitCode::internal);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  const int error = spawn(command, actions, errors, pid_);
  ::close(ends[1]);
  socket_ = ends[0];
  if (error == 0) return;
  ::close(socket_);
  throw Error(command.front(), "", start_error_text(error));
}

Conversation::~Conversation() {
  end();
  ::close(socket_);
}

bool Conversation::say(const std::string& line) {
  const std::string text = line + "\n";  // shorter than what a socket takes at once
  return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
}

Conversation::Heard Conversation::hear(std::string& line, double seconds, const std::atomic<bool>& stop) {
  constexpr int k_wait_ms = 100;
  const auto start = std::chrono::steady_clock::now();
  std::array<char, 1 << 16> some{};
  for (std::size_t searched = 0;;) {
    if (const std::size_t end = heard_.find('\n', searched); end != std::string::npos) {
      line = heard_.substr(0, end);
      heard_.erase(0, end + 1);
      return Heard::line;
    }
    pollfd waiting{socket_, POLLIN, 0};
    const bool is_ready = ::poll(&waiting, 1, k_wait_ms) > 0;
    if (stop) return Heard::stop;
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds)
      return Heard::nothing;
    if (!is_ready) continue;
    const ssize_t bytes = ::recv(socket_, some.data(), some.size(), 0);
    if (bytes == 0 || (bytes < 0 && errno != EINTR)) return Heard::end;
    searched = heard_.size();
    if (bytes > 0) heard_.append(some.data(), static_cast<std::size_t>(bytes));
  }
}

std::string Conversation::end() {
  if (pid_ < 0) return ending_;
  ::shutdown(socket_, SHUT_RDWR);  // a program that listens ends by itself
  constexpr int k_tries = 20, k_wait_ms = 10;
  for (int i = 0; i < k_tries && !has_exited(pid_); ++i) ::poll(nullptr, 0, k_wait_ms);
  ::kill(pid_, SIGKILL);  // nothing of it is worth keeping; without effect on one that has ended
  ending_ = wait_for(pid_);
  pid_ = -1;
  return ending_;
}

}  // namespace clusterbench::cli
