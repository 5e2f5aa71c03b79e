#pragma once
// Standard output for this program's own lines, while code of others runs in the same process.

#include <string>

namespace clusterbench::os {

// From now on what is printed to standard output goes to standard error, and no file of this process (standard error in
// memory, too) grows beyond a megabyte.
class OwnOutput {
 public:
  OwnOutput();
  ~OwnOutput();
  OwnOutput(const OwnOutput&) = delete;
  OwnOutput& operator=(const OwnOutput&) = delete;

  // A line to where standard output was.
  void write_line(const std::string& line) const;

 private:
  int descriptor_;
};

}  // namespace clusterbench::os
