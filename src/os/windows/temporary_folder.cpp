#include "os/temporary_folder.h"

#include "core/error.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {

namespace fs = std::filesystem;

namespace {

constexpr const char* k_temporary_advice = "; TMP names a folder for temporary files";

fs::path folder_for_temporaries() {
  std::error_code failed;
  fs::path folder = fs::temp_directory_path(failed);
  if (failed) throw Error("TMP", "", "is not a folder" + std::string(k_temporary_advice));
  return folder;
}

}  // namespace

TemporaryFolder::TemporaryFolder() : owner_(static_cast<int>(::GetCurrentProcessId())) {
  const fs::path parent = folder_for_temporaries();
  for (std::uint64_t salt = ::GetTickCount64();; ++salt) {
    path_ = parent / ("clusterbench." + std::to_string(owner_) + "." + std::to_string(salt));
    if (::CreateDirectoryW(long_path(path_).c_str(), nullptr) != 0) return;
    if (::GetLastError() == ERROR_ALREADY_EXISTS) continue;
    take_last_error();
    throw Error(path_.string(), "", errno_text("no folder can be made") + k_temporary_advice);
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace clusterbench::os
