#pragma once
// A folder that a command writes files into.

#include <filesystem>
#include <vector>

namespace clusterbench::cli {

// Makes the folder, with those above it that are missing. Those that it made and that are still empty go with it, so
// that a command that is refused, or fails, leaves none behind.
class OutputFolder {
 public:
  // Throws Error if no folder can be made there, or nothing be written to it.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  // from the outermost
};

}  // namespace clusterbench::cli
