#pragma once
// A folder for another program's files; it is removed with its owner.

#include <filesystem>
#include <string>

namespace clusterbench::os {

class TemporaryFolder {
 public:
  TemporaryFolder();  // throws Error if none can be made
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
  int owner_ = 0;  // a process that the owner forks does not remove it
};

}  // namespace clusterbench::os
