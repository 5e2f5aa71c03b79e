#include "os/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

#include "os/posix/system_calls.h"
#include "os/standard_streams.h"
#include "os/stop_signals.h"

namespace clusterbench::os {
namespace {

namespace fs = std::filesystem;

// A number below /dev/fd or /proc/self/fd; -1 if it is none.
int number_in(std::string_view name) {
  int number = -1;
  const auto [end, failed] = std::from_chars(name.data(), name.data() + name.size(), number);
  return failed == std::errc() && end == name.data() + name.size() ? number : -1;
}

int named_descriptor(const fs::path& path) {
  const std::string name = path.lexically_normal().string();
  constexpr std::pair<const char*, int> k_names[] = {
      {"/dev/stdin", STDIN_FILENO}, {"/dev/stdout", STDOUT_FILENO}, {"/dev/stderr", STDERR_FILENO}};
  for (const auto& [known, descriptor] : k_names)
    if (name == known) return descriptor;
  for (const std::string& folder :
       {std::string("/dev/fd/"), std::string("/proc/self/fd/"), "/proc/" + std::to_string(::getpid()) + "/fd/"})
    if (name.starts_with(folder)) return number_in(std::string_view(name).substr(folder.size()));
  return -1;
}

int own_descriptor(const fs::path& path) {
  const int named = named_descriptor(path);
  return named == STDOUT_FILENO ? output_descriptor() : named;
}

// Links there name open descriptors, and not always files.
bool is_descriptor_of_a_process(const fs::path& path) {
  const std::string folder = path.lexically_normal().parent_path().string();
  return folder.starts_with("/proc/") && folder.ends_with("/fd");
}

constexpr std::array k_ending_signals{SIGINT, SIGTERM, SIGHUP, SIGQUIT};

// A signal handler can access only global state.
std::atomic<int> g_pending_signal{0};

void hold_signal(int number) {
  g_pending_signal = number;
}

// Replaces the handlers of terminating signals for a while. In one thread at a time. Ignored signals stay ignored.
class SignalsHandled {
 public:
  explicit SignalsHandled(void (*handler)(int)) {
    for (std::size_t i = 0; i < k_ending_signals.size(); ++i) {
      struct sigaction action {};
      action.sa_handler = handler;
      ::sigaction(k_ending_signals[i], nullptr, &before_[i]);
      const bool ends_already = handler == end_at_signal && before_[i].sa_handler == SIG_DFL;
      if (before_[i].sa_handler != SIG_IGN && !ends_already) ::sigaction(k_ending_signals[i], &action, nullptr);
    }
  }
  ~SignalsHandled() {
    for (std::size_t i = 0; i < k_ending_signals.size(); ++i) ::sigaction(k_ending_signals[i], &before_[i], nullptr);
    if (const int number = g_pending_signal.exchange(0); number != 0) ::raise(number);
  }
  SignalsHandled(const SignalsHandled&) = delete;
  SignalsHandled& operator=(const SignalsHandled&) = delete;

 private:
  std::array<struct sigaction, k_ending_signals.size()> before_{};
};

// Flushes to disk. True also for file systems and devices that do not support it.
bool is_on_disk(int file) {
  return flush_to_disk(file) == 0 || errno == EINVAL || errno == ENOTSUP;
}

struct MadeFile {
  fs::path path;
  int descriptor = -1;  // -1: errno has the reason
};

// Calls make(path), which returns a descriptor or -1 with errno, with the first free name from PATH.NUMBER on (0 is
// PATH itself), shortened so that no folder rejects its length.
template <class Make>
MadeFile at_free_name(const fs::path& path, int number, Make&& make) {
  constexpr std::size_t k_longest_name = 220;
  const std::string name = path.filename().string();
  const fs::path first = path.parent_path() / (name.size() > k_longest_name ? name.substr(0, k_longest_name) : name);
  for (;; ++number) {
    MadeFile made{number == 0 ? first : fs::path(first.string() + "." + std::to_string(number))};
    made.descriptor = make(made.path);
    if (made.descriptor >= 0 || errno != EEXIST) return made;
  }
}

MadeFile made_file(const fs::path& path, int number) {
  return at_free_name(path, number, [](const fs::path& free) {
    return ::open(free.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  });
}

// A file without a name in that folder, which ends with its process; -1 on file systems and systems that have none.
int unnamed_file([[maybe_unused]] const fs::path& folder) {
#ifdef O_TMPFILE
  return ::open(folder.empty() ? "." : folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
#else
  return -1;
#endif
}

// A temporary file: it removes itself unless it gets the other file's name. It has no name before it is complete, where
// the file system can do that, so that a killed process leaves none behind.
class NewFile {
 public:
  explicit NewFile(const fs::path& beside) : name_(beside.string() + ".new") {
    made_.descriptor = unnamed_file(beside.parent_path());
    if (made_.descriptor < 0) made_ = made_file(name_, 0);
  }
  ~NewFile() {
    if (made_.descriptor < 0) return;
    ::close(made_.descriptor);
    if (!is_renamed_ && !made_.path.empty()) ::unlink(made_.path.c_str());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  bool is_made() const { return made_.descriptor >= 0; }

  void copy_owner_and_mode(const fs::path& old) const {
    struct stat status {};
    if (::stat(old.c_str(), &status) != 0) return;
    if (::fchown(made_.descriptor, status.st_uid, status.st_gid) != 0) errno = 0;  // only root may
    if (::fchmod(made_.descriptor, status.st_mode & 07777) != 0) errno = 0;
  }
  bool fill(std::string_view text) const {
    return is_written_to(made_.descriptor, text) && is_on_disk(made_.descriptor);
  }
  bool rename_to(const fs::path& path) {
    if (made_.path.empty() && !give_name()) return false;
    is_renamed_ = ::rename(made_.path.c_str(), path.c_str()) == 0;
    return is_renamed_;
  }

 private:
  bool give_name() {
    const std::string opened = "/proc/self/fd/" + std::to_string(made_.descriptor);
    const MadeFile named = at_free_name(name_, 0, [&](const fs::path& free) {
      return ::linkat(AT_FDCWD, opened.c_str(), AT_FDCWD, free.c_str(), AT_SYMLINK_FOLLOW);
    });
    if (named.descriptor == 0) made_.path = named.path;
    return named.descriptor == 0;
  }

  fs::path name_;
  MadeFile made_;
  bool is_renamed_ = false;
};

constexpr const char* k_no_file_beside = "cannot be written, as no file can be made in its folder";

std::string shown(const fs::path& name) {
  return name.empty() || name == "-" ? "standard output" : name.string();
}

}  // namespace

OutputTarget output_target(const fs::path& name) {
  if (name.empty() || name == "-") return {"/dev/stdout", true, output_descriptor()};
  OutputTarget target{name};
  constexpr int k_most_links = 40;  // the system's own limit
  std::error_code failed;
  for (int count = 0;; ++count) {
    target.descriptor = own_descriptor(target.path);
    target.is_stream = target.descriptor >= 0 || is_descriptor_of_a_process(target.path);
    if (target.is_stream || !fs::is_symlink(fs::symlink_status(target.path, failed))) break;
    if (count == k_most_links) throw Error(name.string(), "", "is a circle of links");
    const fs::path next = fs::read_symlink(target.path, failed);
    target.path = next.is_absolute() ? next : target.path.parent_path() / next;
  }
  const fs::file_status status = fs::status(target.path, failed);
  if (status.type() == fs::file_type::block) throw Error(name.string(), "", "is a disk or a part of one; name a file");
  target.is_stream |= fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
  return target;
}

OutputFile::OutputFile(const fs::path& name) : name_(name), target_(output_target(name)) {
  if (target_.is_stream) {
    open_stream();
    return;
  }
  require_folder_of(name_);
  std::error_code none;
  if (fs::is_directory(target_.path, none))
    throw Error(shown(name_), "", "cannot be written: is a folder; name a file in it");
  if (::access(target_.path.c_str(), W_OK) != 0 && errno != ENOENT) fail("cannot be written");
}

OutputFile::~OutputFile() {
  if (stream_ >= 0 && target_.descriptor < 0) ::close(stream_);
}

void OutputFile::fail(const std::string& action) const {
  const ExitCode code = code_of_failed_write(errno);
  throw Error(shown(name_), "", errno_text(action), code);
}

void OutputFile::open_stream() {
  using namespace std::chrono_literals;
  constexpr std::chrono::milliseconds k_longest_wait = 10s, k_pause = 20ms;
  stream_ = target_.descriptor;
  if (stream_ >= 0) return;
  std::error_code none;
  const bool is_pipe = fs::is_fifo(target_.path, none);
  for (std::chrono::milliseconds waited = 0ms;; waited += k_pause) {
    stream_ = ::open(target_.path.c_str(), O_WRONLY | O_APPEND | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (stream_ >= 0) break;
    if (!is_pipe || errno != ENXIO) fail("cannot be written");
    if (waited >= k_longest_wait)
      throw Error(shown(name_), "", "cannot be written: is a pipe that no program reads; start its reader first");
    std::this_thread::sleep_for(k_pause);
  }
  ::fcntl(stream_, F_SETFL, ::fcntl(stream_, F_GETFL) & ~O_NONBLOCK);
}

void OutputFile::probe() {
  if (target_.is_stream) {
    struct stat status {};
    // a person reads this stream, and other text may come before
    const bool is_printed = name_.empty() || name_ == "-";
    const bool accepts_space = !is_printed && ::fstat(stream_, &status) == 0 && S_ISCHR(status.st_mode);
    const int way = ::fcntl(stream_, F_GETFL);
    if (way >= 0 && (way & O_ACCMODE) == O_RDONLY) errno = EBADF;  // that of a stream that was closed
    if (way < 0 || (way & O_ACCMODE) == O_RDONLY || (accepts_space && !is_written_to(stream_, " ")))
      fail("cannot be written");
    return;
  }
  const SignalsHandled held(hold_signal);
  const NewFile fresh(target_.path);
  if (!fresh.is_made()) fail(k_no_file_beside);
  if (!fresh.fill(" ")) fail("cannot be written");
}

void OutputFile::write(std::string_view text) {
  if (!target_.is_stream) return replace(text);
  std::cout << std::flush;
  std::fflush(stdout);
  const SignalsHandled ending(end_at_signal);  // a reader that reads nothing must not block the exit
  if (!is_written_to(stream_, text)) fail("could not be written whole");
}

void OutputFile::replace(std::string_view text) const {
  const SignalsHandled held(hold_signal);
  NewFile fresh(target_.path);
  if (!fresh.is_made()) fail(k_no_file_beside);
  fresh.copy_owner_and_mode(target_.path);
  if (!fresh.fill(text)) fail("could not be written whole");
  if (!fresh.rename_to(target_.path)) fail("cannot be replaced");
}

fs::path reserve_name(const fs::path& path) {
  const MadeFile made = made_file(path, 1);
  if (made.descriptor < 0) throw Error(path.string(), "", errno_text("cannot be written"));
  ::close(made.descriptor);
  return made.path;
}

}  // namespace clusterbench::os
