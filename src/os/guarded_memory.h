#pragma once
// Memory for checks of foreign code: an access beside it, or a forbidden write, ends the process at once, with a line
// that says where.

#include <cstddef>
#include <string>

namespace clusterbench::os {

// Begins at a page's begin or ends at a page's end, with a page beside it that nobody may touch. At most 128 at a time.
class GuardedMemory {
 public:
  enum class Guard { before, behind };

  // `name`: of the array, for the line. A multiple of 8 bytes is aligned to 8, of 4 to 4.
  GuardedMemory(const std::string& name, std::size_t bytes, Guard guard);
  ~GuardedMemory();
  GuardedMemory(const GuardedMemory&) = delete;
  GuardedMemory& operator=(const GuardedMemory&) = delete;

  std::byte* data() const { return data_; }
  std::size_t size() const { return bytes_; }
  void forbid_writing() const;

 private:
  std::byte *pages_ = nullptr, *data_ = nullptr;
  std::size_t page_bytes_ = 0, bytes_ = 0;
  std::size_t place_ = 0;  // among all that there are
};

// From now on such an access prints on standard error what it touched ("wrote to `lights.x`, which is to be read only",
// "touched memory 4 bytes behind the end of `lists.lights`"), before it ends the process.
void report_guards();

// Bytes that this process has allocated and not freed; 0 where that is not known.
std::size_t heap_in_use();

}  // namespace clusterbench::os
