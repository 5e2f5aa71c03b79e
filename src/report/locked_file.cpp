#include "report/locked_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "core/error.h"

namespace clusterbench::report {

namespace fs = std::filesystem;

LockedFile::LockedFile(fs::path path) : path_(std::move(path)) {
  open(0);
}

LockedFile::~LockedFile() {
  close();
}

void LockedFile::open(int more_flags) {
  do {
    close();
    file_ = ::open(path_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | more_flags, 0644);
    if (file_ < 0 && errno != EEXIST) fail("cannot be written");
    // A file system without locks (EOPNOTSUPP, ENOLCK) is no reason not to measure.
    const bool is_held = file_ < 0 || (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK);
    if (is_held) {
      close();
      throw Error(path_.string(), "", "another run is writing here; wait for its end, or name another file");
    }
  } while (!is_still_at_path());
}

void LockedFile::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

bool LockedFile::is_still_at_path() const {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file_, &opened) == 0 && ::stat(path_.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

void LockedFile::fail(const std::string& what) const {
  throw Error(path_.string(), "", errno_says(what));
}

std::string LockedFile::text() const {
  std::string text;
  char block[1 << 16];
  for (off_t at = 0;;) {
    const ssize_t got = ::pread(file_, block, sizeof block, at);
    if (got < 0) fail("cannot be read");
    if (got == 0) return text;
    text.append(block, static_cast<std::size_t>(got));
    at += got;
  }
}

void LockedFile::append(std::string_view text) {
  while (!text.empty()) {
    const ssize_t put = ::write(file_, text.data(), text.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) throw Error(path_.string(), "", errno_says("cannot be written"), ExitCode::interrupted);
    text.remove_prefix(static_cast<std::size_t>(put));
  }
}

void LockedFile::cut_to(std::size_t bytes) {
  if (::ftruncate(file_, static_cast<off_t>(bytes)) != 0) fail("cannot be cut");
}

// Reserves the room and gives it back.
void LockedFile::check_room(std::uint64_t bytes) const {
  const off_t size = ::lseek(file_, 0, SEEK_END);
  const int failed = ::posix_fallocate(file_, size, static_cast<off_t>(bytes));
  const bool restored = ::ftruncate(file_, size) == 0;
  if (failed == ENOSPC || failed == EDQUOT || failed == EFBIG || !restored)
    throw Error(path_.string(), "",
                "no room on the disk for a result of about " + std::to_string(bytes >> 10) + " KiB");
}

// Who opens the path between the two steps has the new file: then this is an Error, and the text is kept all the same.
void LockedFile::move_text_to(const fs::path& other) {
  if (::rename(path_.c_str(), other.c_str()) != 0) fail("cannot be renamed to " + other.string());
  open(O_EXCL);
}

void LockedFile::remove() {
  ::unlink(path_.c_str());
  close();
}

}  // namespace clusterbench::report
