#pragma once
#include <filesystem>
#include <string>

namespace clusterbench {

// All that a file holds. Throws Error, which names it, if it is a folder or cannot be read.
std::string file_text(const std::filesystem::path& path);

}  // namespace clusterbench
