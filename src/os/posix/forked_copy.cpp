// Copies of this process that foreign code has forked.

#include <sys/mman.h>
#include <unistd.h>

#include "os/call_notes.h"
#include "os/notes_page.h"

namespace clusterbench::os {
namespace {

// A byte that the kernel clears in each copy of this process. Where it does not, the process's id tells.
class OwnMark {
 public:
  OwnMark() : byte_(cleared_in_copies()) { set(); }
  void set() {
    if (byte_ != nullptr) *byte_ = 1;
    process_ = ::getpid();
  }
  bool is_copy() const { return byte_ != nullptr ? *byte_ == 0 : process_ != ::getpid(); }

 private:
  static volatile char* cleared_in_copies() {
#ifdef MADV_WIPEONFORK
    constexpr std::size_t k_bytes = 4096;
    void* memory = ::mmap(nullptr, k_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory != MAP_FAILED && ::madvise(memory, k_bytes, MADV_WIPEONFORK) == 0) return static_cast<char*>(memory);
#endif
    return nullptr;
  }

  volatile char* byte_;
  int process_ = 0;
};

OwnMark& own_mark() {
  static OwnMark mark;
  return mark;
}

}  // namespace

bool is_forked_copy() {
  return own_mark().is_copy();
}

void note_own_process() {
  own_mark().set();
}

NotesPage* page_for_copies() {
  void* memory = ::mmap(nullptr, sizeof(NotesPage), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return memory == MAP_FAILED ? nullptr : static_cast<NotesPage*>(memory);
}

}  // namespace clusterbench::os
