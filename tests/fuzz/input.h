#pragma once
// What the libFuzzer targets share: a file with the bytes at hand, and what counts as an answer.

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "core/error.h"

namespace clusterbench::fuzz {

// In memory where the system has such a place: thirty times as many inputs as on a disk.
class InputFolder {
 public:
  InputFolder() { std::filesystem::create_directories(path_); }
  ~InputFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  static std::filesystem::path base() {
    const std::filesystem::path memory = "/dev/shm";
    return std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
  }
  std::filesystem::path path_ = base() / ("clusterbench_fuzz_" + std::to_string(::getpid()));
};

// A file of this process, written anew for every input. The loaders read files, not memory.
inline std::filesystem::path input_file(const std::string& ending) {
  static const InputFolder folder;
  return folder.path() / ("input" + ending);
}

inline std::filesystem::path written(const std::uint8_t* data, std::size_t size, const std::string& ending) {
  const std::filesystem::path path = input_file(ending);
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

// Bad input is refused by an Error that is no internal one; everything else that is thrown is a fault.
template <class Read>
int answered(Read&& read) {
  try {
    read();
  } catch (const Error& error) {
    if (error.code() == ExitCode::usage) return 0;
    std::cerr << "exit code " << static_cast<int>(error.code()) << ": " << error.what() << "\n";
    std::abort();
  }
  return 0;
}

}  // namespace clusterbench::fuzz
