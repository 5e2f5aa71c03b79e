// Notes on calls are for a guard, and Windows has none (guarded_process.cpp): they stay in this process.

#include "core/error.h"
#include "os/call_notes.h"
#include "os/notes_page.h"

namespace clusterbench::os {

std::string path_of_notes() {
  return "";
}

void join_notes(const std::string& path) {
  throw Error(path, "", "holds no notes of this program's calls", ExitCode::internal);
}

NotesPage& share_notes() {
  return notes_page();
}

void watch_for_crashes() {}

// A process cannot be copied.
bool is_forked_copy() {
  return false;
}
void note_own_process() {}
NotesPage* page_for_copies() {
  return nullptr;
}

}  // namespace clusterbench::os
