#include "os/file_access.h"

#include <cerrno>

#include "os/windows/windows_api.h"

namespace clusterbench::os {

// Only a try tells: rights are lists, of users and groups.
bool is_writable_folder(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / (L"clusterbench." + std::to_wstring(::GetCurrentProcessId()) + L".try");
  const OwnedHandle made(::CreateFileW(long_path(file).c_str(), GENERIC_WRITE | DELETE, 0, nullptr, CREATE_NEW,
                                       FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr));
  if (made.is_open() || ::GetLastError() == ERROR_FILE_EXISTS) return true;
  take_last_error();
  return false;
}

// A program may be named without its ending.
bool is_executable(const std::filesystem::path& file) {
  for (const wchar_t* ending : {L"", L".exe"}) {
    DWORD kind = 0;
    std::filesystem::path program = file;
    program += ending;
    if (::GetBinaryTypeW(long_path(program).c_str(), &kind) != 0) return true;
  }
  errno = EACCES;
  return false;
}

}  // namespace clusterbench::os
