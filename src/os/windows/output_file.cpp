#include "os/output_file.h"

#include <fcntl.h>
#include <io.h>

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <string>

#include "os/standard_streams.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {
namespace {

namespace fs = std::filesystem;

constexpr DWORD k_share_all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

// A console, NUL or another device.
bool is_device(const fs::path& path) {
  if (path.wstring().starts_with(L"\\\\.\\")) return true;
  const OwnedHandle opened(::CreateFileW(long_path(path).c_str(), 0, k_share_all, nullptr, OPEN_EXISTING,
                                         FILE_FLAG_BACKUP_SEMANTICS, nullptr));
  return opened.is_open() && ::GetFileType(opened.get()) != FILE_TYPE_DISK;
}

struct MadeFile {
  fs::path path;
  OwnedHandle handle;  // closed: errno has the reason
};

// The first free name from PATH.NUMBER on (0 is PATH itself), shortened so that no folder rejects its length.
MadeFile made_file(const fs::path& path, int number) {
  constexpr std::size_t k_longest_name = 220;
  const fs::path first = path.parent_path() / path.filename().wstring().substr(0, k_longest_name);
  for (;; ++number) {
    fs::path next = first;
    if (number > 0) next += L"." + std::to_wstring(number);
    OwnedHandle handle(::CreateFileW(long_path(next).c_str(), GENERIC_WRITE | DELETE, FILE_SHARE_DELETE, nullptr,
                                     CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr));
    if (handle.is_open()) return {next, std::move(handle)};
    take_last_error();
    const int reason = errno;
    const bool is_taken = ::GetFileAttributesW(long_path(next).c_str()) != INVALID_FILE_ATTRIBUTES;
    errno = reason;
    if (reason != EEXIST && !is_taken) return {next, OwnedHandle()};
  }
}

// A temporary file. Windows removes it when this process ends, however it ends, unless it gets the other file's name.
class NewFile {
 public:
  explicit NewFile(const fs::path& beside) : made_(made_file(fs::path(beside).concat(L".new"), 0)) { mark(true); }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  bool is_made() const { return made_.handle.is_open(); }

  bool fill(std::string_view text) const {
    if (!write_all_to(made_.handle.get(), text)) return false;
    if (::FlushFileBuffers(made_.handle.get()) != 0) return true;
    take_last_error();
    return false;
  }

  // ReplaceFileW() keeps the old file's rights; where it cannot be, the new file takes the name alone.
  bool rename_to(const fs::path& path) {
    mark(false);
    made_.handle.close();
    const std::wstring from = long_path(made_.path), to = long_path(path);
    constexpr DWORD k_way = REPLACEFILE_IGNORE_MERGE_ERRORS;
    if (::ReplaceFileW(to.c_str(), from.c_str(), nullptr, k_way, nullptr, nullptr) != 0) return true;
    if (::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0) return true;
    take_last_error();
    ::DeleteFileW(from.c_str());
    return false;
  }

 private:
  void mark(bool is_to_be_removed) const {
    FILE_DISPOSITION_INFO removed{static_cast<BOOLEAN>(is_to_be_removed)};
    ::SetFileInformationByHandle(made_.handle.get(), FileDispositionInfo, &removed, sizeof removed);
  }

  MadeFile made_;
};

constexpr const char* k_no_file_beside = "cannot be written, as no file can be made in its folder";

std::string shown(const fs::path& name) {
  return name.empty() || name == "-" ? "standard output" : name.string();
}

bool is_read_only(const fs::path& path) {
  const DWORD attributes = ::GetFileAttributesW(long_path(path).c_str());
  return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_READONLY) != 0;
}

}  // namespace

OutputTarget output_target(const fs::path& name) {
  if (name.empty() || name == "-") return {"CONOUT$", true, output_descriptor()};
  OutputTarget target{name};
  constexpr int k_most_links = 40;
  std::error_code failed;
  for (int count = 0; fs::is_symlink(fs::symlink_status(target.path, failed)); ++count) {
    if (count == k_most_links) throw Error(name.string(), "", "is a circle of links");
    const fs::path next = fs::read_symlink(target.path, failed);
    if (next.empty()) break;  // mingw's library reads no links; the file gets the link's name
    target.path = next.is_absolute() ? next : target.path.parent_path() / next;
  }
  target.is_stream = is_device(target.path);
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
  const bool is_refused = is_read_only(target_.path);
  errno = EACCES;
  if (is_refused) fail("cannot be written");
}

OutputFile::~OutputFile() {
  if (stream_ >= 0 && target_.descriptor < 0) ::_close(stream_);
}

void OutputFile::fail(const std::string& action) const {
  const ExitCode code = code_of_failed_write(errno);
  throw Error(shown(name_), "", errno_text(action), code);
}

void OutputFile::open_stream() {
  stream_ = target_.descriptor;
  if (stream_ >= 0) return;
  OwnedHandle opened(::CreateFileW(target_.path.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr,
                                   OPEN_EXISTING, 0, nullptr));
  if (!opened.is_open()) {
    take_last_error();
    fail("cannot be written");
  }
  stream_ = ::_open_osfhandle(number_of(opened.release()), _O_WRONLY | _O_BINARY);
}

void OutputFile::probe() {
  if (target_.is_stream) return;
  const NewFile fresh(target_.path);
  if (!fresh.is_made()) fail(k_no_file_beside);
  if (!fresh.fill(" ")) fail("cannot be written");
}

void OutputFile::write(std::string_view text) {
  if (!target_.is_stream) return replace(text);
  std::cout << std::flush;
  std::fflush(stdout);
  if (!write_all_to(handle_of(::_get_osfhandle(stream_)), text)) fail("could not be written whole");
}

void OutputFile::replace(std::string_view text) const {
  NewFile fresh(target_.path);
  if (!fresh.is_made()) fail(k_no_file_beside);
  if (!fresh.fill(text)) fail("could not be written whole");
  if (!fresh.rename_to(target_.path)) fail("cannot be replaced");
}

fs::path reserve_name(const fs::path& path) {
  const MadeFile made = made_file(path, 1);
  if (!made.handle.is_open()) throw Error(path.string(), "", errno_text("cannot be written"));
  return made.path;
}

}  // namespace clusterbench::os
