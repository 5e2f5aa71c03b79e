#include "os/locked_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "core/text.h"
#include "os/call_notes.h"
#include "os/host_name.h"
#include "os/kept_files.h"
#include "os/output_file.h"
#include "os/posix/system_calls.h"

namespace clusterbench::os {

namespace fs = std::filesystem;

namespace {

int descriptor_of(std::intptr_t file) {
  return static_cast<int>(file);
}

}  // namespace

// The process that made a file PATH.lock, as its text says: "HOST PID".
struct LockedFile::LockOwner {
  std::string host;
  long process = 0;

  // For certain: that of another host may still be there.
  bool has_ended() const {
    return process > 0 && host == host_name() && ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
  }
  std::string text() const {
    return process > 0 ? "process " + std::to_string(process) + " on " + printable(host) : "one that is unknown";
  }
};

LockedFile::LockOwner LockedFile::owner_of(const fs::path& beside) {
  LockOwner owner;
  std::ifstream(beside) >> owner.host >> owner.process;
  return owner;
}

LockedFile::LockedFile(fs::path path, Held held) : path_(std::move(path)), held_(held) {
  open();
}

LockedFile::~LockedFile() {
  struct stat opened {};
  if (is_made_ && file_ >= 0 && ::fstat(descriptor_of(file_), &opened) == 0 && opened.st_size == 0 &&
      is_still_at_path())
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
  keep_file_and_length(descriptor_of(file_));
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
  if (file_ < 0 && errno == EISDIR)
    throw Error(path_.string(), "", "is a folder, and a file is written here; remove it");
  struct stat opened {};
  if (file_ < 0 || ::fstat(descriptor_of(file_), &opened) != 0) fail("cannot be written");
  if (S_ISREG(opened.st_mode)) return true;
  close();
  throw Error(path_.string(), "", "is no regular file, and only such a one is written here");
}

void LockedFile::lock() {
  int failed = 0;
  do failed = ::flock(descriptor_of(file_), held_ == Held::wait ? LOCK_EX : LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  while (failed == EINTR);
  if (failed == 0) return;
  if (failed != EWOULDBLOCK) {
    lock_beside();
    return;
  }
  is_made_ = false;
  close();
  throw FileHeld(path_.string(), "", "another run is writing here; wait for its end, or name another file");
}

// On a file system without locks (ENOLCK, EOPNOTSUPP: some network disks), PATH.lock stands for the lock: of all
// processes that create it at once, one succeeds. One that was left by a dead process of this host is taken over.
void LockedFile::lock_beside() {
  const fs::path beside = lock_path();
  for (;;) {
    const int made = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (made >= 0) {
      const std::string owner = host_name() + " " + std::to_string(::getpid()) + "\n";
      const bool is_written = ::write(made, owner.data(), owner.size()) == static_cast<ssize_t>(owner.size());
      ::close(made);
      has_lock_beside_ = true;
      if (is_written) return;
      close();
      fail("has no room for a lock beside it");
    }
    if (errno != EEXIST) fail("has no locks on this disk, and no file can be made beside it");
    const LockOwner owner = owner_of(beside);
    if (owner.has_ended())
      ::unlink(beside.c_str());
    else if (held_ == Held::wait)
      ::usleep(100'000);
    else
      refuse_locked(beside, owner);
  }
}

void LockedFile::refuse_locked(const fs::path& beside, const LockOwner& owner) {
  is_made_ = false;
  close();
  throw FileHeld(path_.string(), "",
                 "another run is writing here: " + owner.text() + ". This disk has no locks, so the file " +
                     beside.string() + " stands for one; remove it if that run has ended, or name another file");
}

void LockedFile::close() {
  release_file(descriptor_of(file_));
  if (file_ >= 0) ::close(descriptor_of(file_));
  file_ = -1;
  if (has_lock_beside_) ::unlink(lock_path().c_str());
  has_lock_beside_ = false;
}

fs::path LockedFile::lock_path() const {
  return path_.string() + ".lock";
}

bool LockedFile::is_still_at_path() const {
  struct stat opened {};
  struct stat named {};
  return ::fstat(descriptor_of(file_), &opened) == 0 && ::lstat(path_.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

void LockedFile::fail(const std::string& action) const {
  const ExitCode code = code_of_failed_write(errno);
  throw Error(path_.string(), "", errno_text(action), code);
}

std::string LockedFile::text() const {
  std::string text;
  char block[1 << 16];
  for (off_t at = 0;;) {
    const ssize_t got = ::pread(descriptor_of(file_), block, sizeof block, at);
    if (got < 0) fail("cannot be read");
    if (got == 0) return text;
    text.append(block, static_cast<std::size_t>(got));
    at += got;
  }
}

void LockedFile::append(std::string_view text) {
  if (has_called()) end_if_files_are_lost();  // a plug-in's own writing is not to be taken for a line of this program
  const FileChange change(descriptor_of(file_));
  while (!text.empty()) {
    const ssize_t put = ::write(descriptor_of(file_), text.data(), text.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) fail("cannot be written");
    text.remove_prefix(static_cast<std::size_t>(put));
  }
}

void LockedFile::cut_to(std::size_t bytes) {
  const FileChange change(descriptor_of(file_));
  if (::ftruncate(descriptor_of(file_), static_cast<off_t>(bytes)) != 0) fail("cannot be cut");
}

void LockedFile::empty() {
  cut_to(0);
  is_made_ = true;
}

// Reserves the room and frees it again.
void LockedFile::check_room(std::uint64_t bytes, std::uint64_t beside) const {
  const FileChange change(descriptor_of(file_));
  const off_t size = ::lseek(descriptor_of(file_), 0, SEEK_END);
  const std::uint64_t most = static_cast<std::uint64_t>(std::numeric_limits<off_t>::max());
  const std::uint64_t both = std::min(bytes + beside, most), longer = std::min(std::max(bytes, beside), most);
  int failed = reserve_room(descriptor_of(file_), size, static_cast<off_t>(both));
  if (failed == EFBIG) failed = reserve_room(descriptor_of(file_), size, static_cast<off_t>(longer));
  const bool restored = ::ftruncate(descriptor_of(file_), size) == 0;
  if (failed == EFBIG)
    throw Error(path_.string(), "",
                "no file may have the " + std::to_string(longer >> 10) + " KiB that the result may take (ulimit -f)",
                ExitCode::internal);
  if (failed == ENOSPC || failed == EDQUOT || !restored)
    throw Error(path_.string(), "",
                "no room on the disk for the " + std::to_string(both >> 10) + " KiB that the result may take",
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
  return ::fstat(descriptor_of(file_), &opened) == 0 && opened.st_nlink > 1 ? opened.st_nlink - 1 : 0;
}

void LockedFile::remove() {
  ::unlink(path_.c_str());
  close();
}

}  // namespace clusterbench::os
