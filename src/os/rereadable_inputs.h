#pragma once
// Inputs through pipes that several processes read one after the other, each from the beginning.

#include <string>
#include <vector>

namespace clusterbench::os {

// Keeps what comes through the pipes among these paths (/dev/stdin, /dev/fd/63) in memory, under the same descriptors.
// Other paths are left alone. Throws Error for a pipe with a name of its own, which can be read only once, and for one
// that cannot be read.
class RereadableInputs {
 public:
  explicit RereadableInputs(const std::vector<std::string>& paths);

  // Before each process that reads them.
  void rewind() const;

 private:
  std::vector<int> descriptors_;
};

}  // namespace clusterbench::os
