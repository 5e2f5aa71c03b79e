#include "os/locked_file.h"

#include <cerrno>

#include "core/error.h"
#include "os/output_file.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {

namespace fs = std::filesystem;

namespace {

// A lock keeps others from reading what it covers. So it covers a byte that no file reaches.
constexpr DWORD k_lock_high = 0x7fff'0000;

BY_HANDLE_FILE_INFORMATION facts_of(HANDLE file) {
  BY_HANDLE_FILE_INFORMATION facts{};
  ::GetFileInformationByHandle(file, &facts);
  return facts;
}

std::uint64_t size_of(HANDLE file) {
  const BY_HANDLE_FILE_INFORMATION facts = facts_of(file);
  return std::uint64_t{facts.nFileSizeHigh} << 32 | facts.nFileSizeLow;
}

bool are_same(const BY_HANDLE_FILE_INFORMATION& a, const BY_HANDLE_FILE_INFORMATION& b) {
  return a.dwVolumeSerialNumber == b.dwVolumeSerialNumber && a.nFileIndexHigh == b.nFileIndexHigh &&
         a.nFileIndexLow == b.nFileIndexLow;
}

HANDLE opened_file(const fs::path& path, DWORD access, DWORD way) {
  return ::CreateFileW(long_path(path).c_str(), access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                       way, FILE_ATTRIBUTE_NORMAL | FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
}

bool is_at(HANDLE file, std::int64_t position) {
  LARGE_INTEGER to{};
  to.QuadPart = position;
  return ::SetFilePointerEx(file, to, nullptr, FILE_BEGIN) != 0;
}

}  // namespace

LockedFile::LockedFile(fs::path path, Held held) : path_(std::move(path)), held_(held) {
  open();
}

LockedFile::~LockedFile() {
  const HANDLE file = handle_of(file_);
  if (is_made_ && file_ != -1 && size_of(file) == 0 && is_still_at_path()) ::DeleteFileW(long_path(path_).c_str());
  close();
}

void LockedFile::open() {
  do {
    close();
    while (!has_opened()) {
    }
    lock();
  } while (!is_still_at_path());
}

// False if another process has created or removed it meanwhile.
bool LockedFile::has_opened() {
  constexpr DWORD k_access = GENERIC_READ | GENERIC_WRITE;  // with DELETE, C libraries could not read it beside us
  file_ = number_of(opened_file(path_, k_access, OPEN_EXISTING));
  is_made_ = false;
  if (file_ == -1 && ::GetLastError() == ERROR_FILE_NOT_FOUND) {
    file_ = number_of(opened_file(path_, k_access, CREATE_NEW));
    is_made_ = file_ != -1;
    if (file_ == -1 && ::GetLastError() == ERROR_FILE_EXISTS) return false;
  }
  if (file_ == -1) {
    take_last_error();
    fail("cannot be written");
  }
  const DWORD attributes = facts_of(handle_of(file_)).dwFileAttributes;
  const bool is_disk_file = ::GetFileType(handle_of(file_)) == FILE_TYPE_DISK;
  if ((attributes & (FILE_ATTRIBUTE_REPARSE_POINT | FILE_ATTRIBUTE_DIRECTORY)) == 0 && is_disk_file) return true;
  close();
  throw Error(path_.string(), "",
              (attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0
                  ? "is a symbolic link, through which nothing is written; remove it"
                  : "is no regular file, and only such a one is written here");
}

// A file system without locks does not prevent measuring.
void LockedFile::lock() {
  OVERLAPPED place{};
  place.OffsetHigh = k_lock_high;
  const DWORD way = held_ == Held::wait ? LOCKFILE_EXCLUSIVE_LOCK : LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY;
  if (::LockFileEx(handle_of(file_), way, 0, 1, 0, &place) != 0) return;
  const DWORD reason = ::GetLastError();
  if (reason != ERROR_LOCK_VIOLATION && reason != ERROR_IO_PENDING) return;
  is_made_ = false;
  close();
  throw FileHeld(path_.string(), "", "another run is writing here; wait for its end, or name another file");
}

void LockedFile::close() {
  if (file_ != -1) ::CloseHandle(handle_of(file_));
  file_ = -1;
}

bool LockedFile::is_still_at_path() const {
  const OwnedHandle named(opened_file(path_, 0, OPEN_EXISTING));
  return named.is_open() && are_same(facts_of(named.get()), facts_of(handle_of(file_)));
}

void LockedFile::fail(const std::string& action) const {
  const ExitCode code = code_of_failed_write(errno);
  throw Error(path_.string(), "", errno_text(action), code);
}

std::string LockedFile::text() const {
  std::string text;
  char block[1 << 16];
  if (!is_at(handle_of(file_), 0)) fail("cannot be read");
  for (;;) {
    DWORD got = 0;
    if (::ReadFile(handle_of(file_), block, sizeof block, &got, nullptr) == 0) {
      take_last_error();
      fail("cannot be read");
    }
    if (got == 0) return text;
    text.append(block, got);
  }
}

void LockedFile::append(std::string_view text) {
  const auto end = static_cast<std::int64_t>(size_of(handle_of(file_)));
  if (!is_at(handle_of(file_), end) || !write_all_to(handle_of(file_), text)) fail("cannot be written");
}

void LockedFile::cut_to(std::size_t bytes) {
  if (is_at(handle_of(file_), static_cast<std::int64_t>(bytes)) && ::SetEndOfFile(handle_of(file_)) != 0) return;
  take_last_error();
  fail("cannot be cut");
}

void LockedFile::empty() {
  cut_to(0);
  is_made_ = true;
}

void LockedFile::check_room(std::uint64_t bytes, std::uint64_t beside) const {
  std::error_code failed;
  const fs::path folder = fs::absolute(path_, failed).parent_path();
  ULARGE_INTEGER room{};
  if (::GetDiskFreeSpaceExW(folder.c_str(), &room, nullptr, nullptr) == 0 || room.QuadPart >= bytes + beside) return;
  throw Error(path_.string(), "",
              "no room on the disk for the " + std::to_string((bytes + beside) >> 10) + " KiB that the result may take",
              ExitCode::internal);
}

fs::path LockedFile::move_text_beside() {
  fs::path name = reserve_name(path_);
  if (::MoveFileExW(long_path(path_).c_str(), long_path(name).c_str(), MOVEFILE_REPLACE_EXISTING) == 0) {
    take_last_error();
    fail("cannot be renamed to " + name.string());
  }
  open();
  return name;
}

void LockedFile::replace(std::string_view text) {
  write_file(path_, text);
  close();
}

std::uint64_t LockedFile::other_names() const {
  const DWORD links = facts_of(handle_of(file_)).nNumberOfLinks;
  return links > 1 ? links - 1 : 0;
}

void LockedFile::remove() {
  ::DeleteFileW(long_path(path_).c_str());
  close();
}

}  // namespace clusterbench::os
