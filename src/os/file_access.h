#pragma once
// What this process may do with a file or folder.

#include <filesystem>

namespace clusterbench::os {

// errno says why not.
bool is_writable_folder(const std::filesystem::path& folder);

bool is_executable(const std::filesystem::path& file);

}  // namespace clusterbench::os
