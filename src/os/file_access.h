#pragma once
// Permissions of this process for a file or folder.

#include <filesystem>

namespace clusterbench::os {

// If false, errno has the reason.
bool is_writable_folder(const std::filesystem::path& folder);

bool is_executable(const std::filesystem::path& file);

}  // namespace clusterbench::os
