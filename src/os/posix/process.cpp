#include "os/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "core/error.h"
#include "os/posix/system_calls.h"
#include "os/process_memory.h"

namespace clusterbench::os {
namespace {

// Descriptors and processes of this system are small.
int number(std::intptr_t known) {
  return static_cast<int>(known);
}

[[noreturn]] void refuse_start(const std::string& program, const std::string& action, int error) {
  throw Error(program == this_program() ? "clusterbench" : program, "", action + ": " + reason_text(error),
              ExitCode::internal);
}

// The standard streams of the new process; all above 2.
struct Streams {
  int in, out, errors;
};

// In the new process: becomes the other program. Returns only on failure.
void become(const char* program, char* const* arguments, const Streams& streams, pid_t parent) {
  // From here on it ends with the process that started it; that one may have ended just before.
  if (!end_with_parent(parent)) return;
  if (::dup2(streams.in, STDIN_FILENO) >= 0 && ::dup2(streams.out, STDOUT_FILENO) >= 0 &&
      ::dup2(streams.errors, STDERR_FILENO) >= 0)
    ::execvp(program, arguments);
}

struct Started {
  pid_t pid = -1;
  int error = 0;  // why there is none
};

Started start(const std::vector<std::string>& command, const Streams& streams) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::string own_name = "clusterbench";  // in lists of processes
  if (command.front() == this_program()) arguments.front() = own_name.data();
  std::array<int, 2> failure{};  // carries the reason of a failed start; closed without data by a good one
  if (closing_pipe(failure.data()) != 0) return {-1, errno};
  const pid_t self = ::getpid();
  Started started{::fork(), errno};
  if (started.pid == 0) {
    become(command.front().c_str(), arguments.data(), streams, self);
    const int error = errno;
    const ssize_t written = ::write(failure[1], &error, sizeof error);
    ::_exit(written == sizeof error ? 127 : 126);
  }
  ::close(failure[1]);
  if (started.pid > 0) started.error = 0;
  ssize_t bytes = 0;
  while (started.pid > 0 && (bytes = ::read(failure[0], &started.error, sizeof started.error)) < 0 && errno == EINTR) {
  }
  ::close(failure[0]);
  if (bytes > 0) ::waitpid(started.pid, nullptr, 0);
  return started;
}

std::string start_error_text(int error) {
  return "cannot be started: " + reason_text(error);
}

// Waits for its end, and describes it.
Ending wait_for(pid_t pid, const MemoryFile& errors) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    const std::string name = number == SIGKILL ? "killed, as where memory runs out" : ::strsignal(number);
    return {"signal " + std::to_string(number) + " (" + name + ")", -1, status, errors.tail()};
  }
  const int code = WEXITSTATUS(status);
  return {code == 0 ? "" : "exit code " + std::to_string(code), code, status, errors.tail()};
}

// Does not wait for it; it can still be waited for.
bool has_exited(pid_t pid) {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid;
}

class Child {
 public:
  Child(const std::vector<std::string>& command, const std::string& input) : input_(input) {
    std::array<int, 2> pipe{};
    if (closing_pipe(pipe.data()) != 0) refuse_start(command.front(), "no pipe for its output", errno);
    started_ = start(command, {number(input_.descriptor()), pipe[1], number(errors_.descriptor())});
    ::close(pipe[1]);
    out_ = pipe[0];
  }
  ~Child() {
    terminate();
    if (is_running()) ::waitpid(started_.pid, nullptr, 0);
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
    if (is_running()) ::kill(started_.pid, SIGTERM);
  }

  Ending end() {
    if (started_.error != 0) return {start_error_text(started_.error), -1, -1, ""};
    has_ended_ = true;
    return wait_for(started_.pid, errors_);
  }

 private:
  bool is_running() const { return started_.error == 0 && !has_ended_; }

  MemoryFile input_, errors_;
  Started started_;
  int out_ = -1;
  bool has_ended_ = false;
};

}  // namespace

int own_process() {
  return ::getpid();
}

bool is_running(int process) {
  return ::kill(process, 0) == 0 || errno != ESRCH;
}

MemoryFile::MemoryFile(const std::string& text) : descriptor_(memory_file()) {
  if (descriptor_ < 0) refuse_start("memory", "no file could be made in it", errno);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t bytes =
        ::pwrite(number(descriptor_), text.data() + done, text.size() - done, static_cast<off_t>(done));
    if (bytes < 0 && errno != EINTR) {
      ::close(number(descriptor_));
      refuse_start("memory", "a file in it could not be written", errno);
    }
    done += static_cast<std::size_t>(std::max<ssize_t>(bytes, 0));
  }
}

MemoryFile::~MemoryFile() {
  ::close(number(descriptor_));
}

std::string MemoryFile::tail() const {
  constexpr off_t k_most = 2000;
  struct stat facts {};
  if (::fstat(number(descriptor_), &facts) != 0) return "";
  const off_t begin = std::max<off_t>(0, facts.st_size - k_most);
  std::string text(static_cast<std::size_t>(facts.st_size - begin), '\0');
  const ssize_t bytes = ::pread(number(descriptor_), text.data(), text.size(), begin);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(bytes, 0)));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return (begin > 0 ? "..." : "") + text;
}

Ending run_child(const std::vector<std::string>& command, const std::string& input,
                 const std::function<void(const std::string& line)>& on_line, const std::atomic<bool>& stop) {
  Child child(command, input);
  std::string text;
  while (!stop && child.read(text))
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
      on_line(text.substr(0, end));
      text.erase(0, end + 1);
    }
  if (stop) child.terminate();
  return child.end();
}

Conversation::Conversation(const std::vector<std::string>& command) {
  std::array<int, 2> ends{};  // one socket is both its standard input and its standard output
  if (closing_socket_pair(ends.data()) != 0) refuse_start(command.front(), "no socket to talk to it", errno);
  const Started started = start(command, {ends[1], ends[1], number(errors_.descriptor())});
  ::close(ends[1]);
  to_ = from_ = ends[0];
  process_ = started.pid;
  if (started.error == 0) return;
  ::close(number(to_));
  if (started.error == EMFILE || started.error == ENFILE)
    refuse_start(command.front(), "cannot be started", started.error);
  throw Error(command.front(), "", start_error_text(started.error));
}

Conversation::~Conversation() {
  end();
  ::close(number(to_));
}

void Conversation::send_line(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t bytes = send_quietly(number(to_), text.data() + sent, text.size() - sent);
    if (bytes < 0 && errno != EINTR) return;
    sent += static_cast<std::size_t>(std::max<ssize_t>(bytes, 0));
  }
}

Conversation::Received Conversation::receive_line(std::string& line, double seconds, const std::atomic<bool>& stop) {
  constexpr int k_wait_ms = 100;
  const auto start = std::chrono::steady_clock::now();
  std::array<char, 1 << 16> some{};
  for (std::size_t searched = 0;;) {
    if (const std::size_t end = received_.find('\n', searched); end != std::string::npos) {
      line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return Received::line;
    }
    pollfd waiting{number(from_), POLLIN, 0};
    const bool has_ended =
        has_exited(number(process_));  // before the last look at its output, which a child of it can hold open
    const bool is_ready = ::poll(&waiting, 1, k_wait_ms) > 0;
    if (stop) return Received::stop;
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds)
      return Received::timeout;
    if (!is_ready && has_ended) return Received::end;
    if (!is_ready) continue;
    const ssize_t bytes = ::recv(number(from_), some.data(), some.size(), 0);
    if (bytes == 0 || (bytes < 0 && errno != EINTR)) return Received::end;
    searched = received_.size();
    if (bytes > 0) received_.append(some.data(), static_cast<std::size_t>(bytes));
  }
}

Ending Conversation::end() {
  if (process_ < 0) return ending_;
  ::shutdown(number(to_), SHUT_RDWR);  // a program that reads it ends by itself
  constexpr int k_tries = 20, k_wait_ms = 10;
  for (int i = 0; i < k_tries && !has_exited(number(process_)); ++i) ::poll(nullptr, 0, k_wait_ms);
  ::kill(number(process_), SIGKILL);  // it has no data to save; no effect if it has ended
  ending_ = wait_for(number(process_), errors_);
  process_ = -1;
  return ending_;
}

}  // namespace clusterbench::os
