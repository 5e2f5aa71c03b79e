#include "os/locked_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "core/error.h"
#include "os/kept_files.h"
#include "os/output_file.h"

namespace clusterbench::os {

namespace fs = std::filesystem;

LockedFile::LockedFile(fs::path path, Held held) : path_(std::move(path)), held_(held) {
  open();
}

LockedFile::~LockedFile() {
  struct stat opened {};
  if (is_made_ && file_ >= 0 && ::fstat(file_, &opened) == 0 && opened.st_size == 0 && is_still_at_path())
    ::unlink(path_.c_str());
  close();
}

void LockedFile::open() {
  do {
    close();
    while (!has_opened()) {
    }
    lock();
  } while (!is_still_at_path());
  keep_file(file_);
}

// False if another process has created or removed it meanwhile.
bool LockedFile::has_opened() {
  constexpr int k_way = O_RDWR | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  file_ = ::open(path_.c_str(), k_way);
  is_made_ = false;
  if (file_ < 0 && errno == ENOENT) {
    file_ = ::open(path_.c_str(), k_way | O_CREAT | O_EXCL, 0666);
    is_made_ = file_ >= 0;
    if (file_ < 0 && errno == EEXIST) return false;
  }
  if (file_ < 0 && errno == ELOOP)
    throw Error(path_.string(), "", "is a symbolic link, through which nothing is written; remove it");
  struct stat opened {};
  if (file_ < 0 || ::fstat(file_, &opened) != 0) fail("cannot be written");
  if (S_ISREG(opened.st_mode)) return true;
  close();
  throw Error(path_.string(), "", "is no regular file, and only such a one is written here");
}

// A file system without locks (EOPNOTSUPP, ENOLCK) does not prevent measuring.
void LockedFile::lock() {
  int failed = 0;
  do failed = ::flock(file_, held_ == Held::wait ? LOCK_EX : LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  while (failed == EINTR);
  if (failed != EWOULDBLOCK) return;
  is_made_ = false;
  close();
  throw Error(path_.string(), "", "another run is writing here; wait for its end, or name another file");
}

void LockedFile::close() {
  release_file(file_);
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

bool LockedFile::is_still_at_path() const {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file_, &opened) == 0 && ::lstat(path_.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

void LockedFile::fail(const std::string& action) const {
  const ExitCode code = code_of_failed_write(errno);
  throw Error(path_.string(), "", errno_text(action), code);
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
    if (put < 0) fail("cannot be written");
    text.remove_prefix(static_cast<std::size_t>(put));
  }
}

void LockedFile::cut_to(std::size_t bytes) {
  if (::ftruncate(file_, static_cast<off_t>(bytes)) != 0) fail("cannot be cut");
}

void LockedFile::empty() {
  cut_to(0);
  is_made_ = true;
}

// Reserves the room and frees it again.
void LockedFile::check_room(std::uint64_t bytes) const {
  const off_t size = ::lseek(file_, 0, SEEK_END);
  const int failed = ::posix_fallocate(file_, size, static_cast<off_t>(bytes));
  const bool restored = ::ftruncate(file_, size) == 0;
  if (failed == EFBIG)
    throw Error(path_.string(), "",
                "no file may have the " + std::to_string(bytes >> 10) + " KiB that the result takes (ulimit -f)",
                ExitCode::internal);
  if (failed == ENOSPC || failed == EDQUOT || !restored)
    throw Error(path_.string(), "", "no room on the disk for a result of about " + std::to_string(bytes >> 10) + " KiB",
                ExitCode::internal);
}

// A process that opens the path between the last two steps has the new file: then this is an Error, and the text is
// kept all the same.
fs::path LockedFile::move_text_beside() {
  fs::path name = reserve_name(path_);
  if (::rename(path_.c_str(), name.c_str()) != 0) fail("cannot be renamed to " + name.string());
  open();
  return name;
}

void LockedFile::replace(std::string_view text) {
  write_file(path_, text);
  close();
}

std::uint64_t LockedFile::other_names() const {
  struct stat opened {};
  return ::fstat(file_, &opened) == 0 && opened.st_nlink > 1 ? opened.st_nlink - 1 : 0;
}

void LockedFile::remove() {
  ::unlink(path_.c_str());
  close();
}

}  // namespace clusterbench::os
