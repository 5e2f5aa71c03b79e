#include "os/windows/windows_api.h"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <utility>

namespace clusterbench::os {
namespace {

namespace fs = std::filesystem;

// Of the reasons that files and processes have.
constexpr std::pair<DWORD, int> k_reasons[] = {
    {ERROR_FILE_NOT_FOUND, ENOENT},      {ERROR_PATH_NOT_FOUND, ENOENT},
    {ERROR_INVALID_DRIVE, ENOENT},       {ERROR_BAD_NETPATH, ENOENT},
    {ERROR_ACCESS_DENIED, EACCES},       {ERROR_SHARING_VIOLATION, EACCES},
    {ERROR_LOCK_VIOLATION, EACCES},      {ERROR_WRITE_PROTECT, EROFS},
    {ERROR_FILE_EXISTS, EEXIST},         {ERROR_ALREADY_EXISTS, EEXIST},
    {ERROR_DISK_FULL, ENOSPC},           {ERROR_HANDLE_DISK_FULL, ENOSPC},
    {ERROR_NOT_ENOUGH_MEMORY, ENOMEM},   {ERROR_OUTOFMEMORY, ENOMEM},
    {ERROR_COMMITMENT_LIMIT, ENOMEM},    {ERROR_INVALID_HANDLE, EBADF},
    {ERROR_BROKEN_PIPE, EPIPE},          {ERROR_NO_DATA, EPIPE},
    {ERROR_DIRECTORY, ENOTDIR},          {ERROR_INVALID_NAME, EINVAL},
    {ERROR_BAD_PATHNAME, EINVAL},        {ERROR_FILENAME_EXCED_RANGE, ENAMETOOLONG},
    {ERROR_TOO_MANY_OPEN_FILES, EMFILE}, {ERROR_BAD_EXE_FORMAT, ENOEXEC},
    {ERROR_DIR_NOT_EMPTY, ENOTEMPTY},    {ERROR_FILE_TOO_LARGE, EFBIG},
    {ERROR_CANT_RESOLVE_FILENAME, ELOOP}};

}  // namespace

std::wstring wide(std::string_view utf8) {
  const int bytes = static_cast<int>(utf8.size());
  std::wstring out(static_cast<std::size_t>(::MultiByteToWideChar(CP_UTF8, 0, utf8.data(), bytes, nullptr, 0)), L'\0');
  ::MultiByteToWideChar(CP_UTF8, 0, utf8.data(), bytes, out.data(), static_cast<int>(out.size()));
  return out;
}

std::string narrow(std::wstring_view utf16) {
  const int count = static_cast<int>(utf16.size());
  const int bytes = ::WideCharToMultiByte(CP_UTF8, 0, utf16.data(), count, nullptr, 0, nullptr, nullptr);
  std::string out(static_cast<std::size_t>(bytes), '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, utf16.data(), count, out.data(), bytes, nullptr, nullptr);
  return out;
}

std::wstring long_path(const fs::path& path) {
  constexpr std::size_t k_short = 240;  // 259 less what is added to names of files beside it
  std::wstring given = path.wstring();
  if (given.starts_with(L"\\\\?\\") || given.starts_with(L"\\\\.\\")) return given;
  std::wstring whole(::GetFullPathNameW(given.c_str(), 0, nullptr, nullptr), L'\0');
  whole.resize(::GetFullPathNameW(given.c_str(), static_cast<DWORD>(whole.size()), whole.data(), nullptr));
  if (whole.size() < k_short) return given;
  return whole.starts_with(L"\\\\") ? L"\\\\?\\UNC" + whole.substr(1) : L"\\\\?\\" + whole;
}

void take_last_error() {
  const DWORD last = ::GetLastError();
  const auto* const known = std::ranges::find(k_reasons, last, &std::pair<DWORD, int>::first);
  errno = known == std::end(k_reasons) ? EIO : known->second;
  ::SetLastError(last);
}

std::string windows_error_text(const std::string& action, DWORD error) {
  wchar_t text[512];
  const DWORD count = ::FormatMessageW(FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS, nullptr, error, 0,
                                       text, static_cast<DWORD>(std::size(text)), nullptr);
  std::string reason = narrow({text, count});
  while (!reason.empty() && (reason.back() == '\n' || reason.back() == '\r' || reason.back() == '.')) reason.pop_back();
  return action + ": " + (reason.empty() ? "error " + std::to_string(error) + " of Windows" : reason);
}

bool write_all_to(HANDLE file, std::string_view bytes) {
  constexpr std::size_t k_most_bytes = std::size_t{1} << 20;  // consoles and pipes refuse very long ones
  while (!bytes.empty()) {
    DWORD put = 0;
    if (::WriteFile(file, bytes.data(), static_cast<DWORD>(std::min(bytes.size(), k_most_bytes)), &put, nullptr) == 0) {
      take_last_error();
      return false;
    }
    bytes.remove_prefix(put);
  }
  return true;
}

}  // namespace clusterbench::os
