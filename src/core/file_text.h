#pragma once
#include <filesystem>
#include <string>

namespace clusterbench {

// The whole content of a file. Throws Error, which names it, if it is a folder, cannot be read or is longer than
// memory_limit(), and for a NUL byte from a device or a pipe. A pipe is read once: the next
// calls with its name return the same text.
std::string file_text(const std::filesystem::path& path);

// A name that means another file in another process: /dev/stdin, /dev/fd/63 (from a shell's `<(...)`), /proc/self/fd/3.
bool is_stream_name(const std::filesystem::path& path);

}  // namespace clusterbench
