#include "os/rereadable_inputs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>

#include "core/error.h"
#include "os/output_file.h"
#include "os/posix/system_calls.h"

namespace clusterbench::os {
namespace {

void write_whole(int file, const char* bytes, std::size_t count, const std::string& path) {
  while (count > 0) {
    const ssize_t written = ::write(file, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw Error(path, "", errno_text("cannot be kept in memory"), ExitCode::internal);
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

// The same bytes in memory.
int copy_in_memory(int from, const std::string& path) {
  const int file = memory_file();
  if (file < 0) throw Error(path, "", errno_text("cannot be kept in memory"), ExitCode::internal);
  std::array<char, 1 << 16> some{};
  for (;;) {
    const ssize_t bytes = ::read(from, some.data(), some.size());
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes < 0) throw Error(path, "", errno_text("cannot be read"));
    if (bytes == 0) return file;
    write_whole(file, some.data(), static_cast<std::size_t>(bytes), path);
  }
}

bool is_pipe(const std::string& path) {
  struct stat facts {};
  return ::stat(path.c_str(), &facts) == 0 && (S_ISFIFO(facts.st_mode) || S_ISSOCK(facts.st_mode));
}

}  // namespace

RereadableInputs::RereadableInputs(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    const int descriptor = path == "-" ? STDIN_FILENO : output_target(path).descriptor;
    if (descriptor >= 0) {
      if (::lseek(descriptor, 0, SEEK_CUR) < 0) {
        const int copy = copy_in_memory(descriptor, path);
        ::dup2(copy, descriptor);
        ::close(copy);
      }
      descriptors_.push_back(descriptor);
    } else if (is_pipe(path)) {
      throw Error(path, "",
                  "is a pipe, which can be read only once; with plug-ins a run may read it again: save it to a file");
    }
  }
}

void RereadableInputs::rewind() const {
  for (const int descriptor : descriptors_) ::lseek(descriptor, 0, SEEK_SET);
}

}  // namespace clusterbench::os
