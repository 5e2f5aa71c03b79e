#include "os/own_output.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "core/error.h"
#include "os/kept_files.h"

namespace clusterbench::os {

OwnOutput::OwnOutput() : descriptor_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3)) {
  if (descriptor_ < 0) throw Error("", "standard output", errno_text("cannot be kept"));
  std::fflush(stdout);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  keep_standard_files();
  keep_file(descriptor_);
  constexpr rlim_t k_most_bytes = 1 << 20;
  const rlimit limit{k_most_bytes, k_most_bytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

OwnOutput::~OwnOutput() {
  release_file(descriptor_);
  ::close(descriptor_);
}

void OwnOutput::write_line(const std::string& line) const {
  const std::string text = line + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t bytes = ::write(descriptor_, text.data() + done, text.size() - done);
    if (bytes < 0 && errno != EINTR) return;  // whoever asked has gone
    done += static_cast<std::size_t>(std::max<ssize_t>(bytes, 0));
  }
}

}  // namespace clusterbench::os
