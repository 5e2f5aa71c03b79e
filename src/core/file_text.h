#pragma once
#include <filesystem>
#include <string>

namespace clusterbench {

// The whole content of a file. Throws Error, which names it, if it is a folder or cannot be read.
std::string file_text(const std::filesystem::path& path);

// A name that means another file in another process: /dev/stdin, /dev/fd/63 (from a shell's `<(...)`), /proc/self/fd/3.
bool is_stream_name(const std::filesystem::path& path);

}  // namespace clusterbench
