#pragma once
#include <filesystem>
#include <string>

namespace clusterbench {

// All that a file holds. Throws Error, which names it, if it is a folder or cannot be read.
std::string file_text(const std::filesystem::path& path);

// A name that means another file in another process: /dev/stdin, /dev/fd/63 (as a shell's `<(...)` has it),
// /proc/self/fd/3.
bool is_stream_name(const std::filesystem::path& path);

}  // namespace clusterbench
