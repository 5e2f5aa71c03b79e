#include "os/standard_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <streambuf>
#include <utility>

#include "core/error.h"
#include "os/kept_files.h"

namespace clusterbench::os {
namespace {

// Descriptors belong to the process.
int g_output = STDOUT_FILENO;

// Text that goes to a descriptor.
class DescriptorText final : public std::streambuf {
 public:
  explicit DescriptorText(int descriptor) : descriptor_(descriptor) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
  }

 protected:
  int_type overflow(int_type one) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(one, traits_type::eof())) sputc(traits_type::to_char_type(one));
    return traits_type::not_eof(one);
  }
  // After a failure, errno has the reason, and the text stays.
  int sync() override {
    if (!is_written_to(descriptor_, {pbase(), static_cast<std::size_t>(pptr() - pbase())})) return -1;
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return 0;
  }

 private:
  int descriptor_;
  std::array<char, 1 << 14> buffer_{};
};

// The C library takes it for a failure that a pipe is full which another program has set to O_NONBLOCK.
void write_directly(std::ostream& stream, int descriptor) {
  static std::array<DescriptorText*, 3> texts{};  // never destroyed: std::cout is flushed after all else has ended
  DescriptorText*& text = texts.at(static_cast<std::size_t>(descriptor));
  if (text == nullptr) text = new DescriptorText(descriptor);
  stream.rdbuf(text);
}

}  // namespace

bool is_written_to(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t put = ::write(descriptor, text.data(), text.size());
    if (put >= 0) {
      text.remove_prefix(static_cast<std::size_t>(put));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      pollfd full{descriptor, POLLOUT, 0};
      ::poll(&full, 1, -1);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

void keep_output_apart() {
  if (g_output != STDOUT_FILENO) return;
  std::cout << std::flush;
  std::fflush(stdout);
  const int kept = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  if (kept < 0) throw Error("", "standard output", errno_text("cannot be kept"), ExitCode::internal);
  static DescriptorText& text = *new DescriptorText(kept);  // std::cout is flushed after all else has ended
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  std::cout.rdbuf(&text);
  g_output = kept;
  keep_file(kept);
  keep_standard_files();
}

int output_descriptor() {
  return g_output;
}

void keep_standard_streams() {
  for (const auto& [stream, way] :
       {std::pair{STDIN_FILENO, O_WRONLY}, {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_WRONLY}})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", way);  // uses the smallest free number
  write_directly(std::cout, STDOUT_FILENO);
  write_directly(std::cerr, STDERR_FILENO);
}

void report_size_limits_as_errors() {
  std::signal(SIGXFSZ, SIG_IGN);
}

bool is_open_file(int descriptor, const std::string& name) {
  struct stat open {};
  struct stat named {};
  return ::fstat(descriptor, &open) == 0 && S_ISREG(open.st_mode) && ::stat(name.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

}  // namespace clusterbench::os
