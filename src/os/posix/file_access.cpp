#include "os/file_access.h"

#include <unistd.h>

namespace clusterbench::os {

bool is_writable_folder(const std::filesystem::path& folder) {
  return ::access(folder.c_str(), W_OK | X_OK) == 0;
}

bool is_executable(const std::filesystem::path& file) {
  return ::access(file.c_str(), X_OK) == 0;
}

}  // namespace clusterbench::os
