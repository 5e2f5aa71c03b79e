// Notes on calls in memory that processes share.

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "core/error.h"
#include "os/call_notes.h"
#include "os/notes_page.h"
#include "os/posix/system_calls.h"
#include "os/standard_streams.h"

namespace clusterbench::os {
namespace {

// As the notes, they belong to the process.
int g_notes_file = -1;
bool g_are_notes_shared = false;
std::string g_joined_notes;  // NOLINT(cert-err58-cpp): an empty string throws nothing

NotesPage& mapped_page(int file) {
  void* memory = ::mmap(nullptr, sizeof(NotesPage), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) throw Error("memory", "", errno_text("no notes could be shared"), ExitCode::internal);
  return *static_cast<NotesPage*>(memory);
}

void on_crash(int number) {
  note_crash();
  std::signal(number, SIG_DFL);
  std::raise(number);
}

}  // namespace

std::string path_of_notes() {
  if (!g_joined_notes.empty()) return g_joined_notes;
  return g_notes_file < 0 ? "" : path_for_children(g_notes_file);
}

void join_notes(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  struct stat facts {};
  const bool is_page = file >= 0 && ::fstat(file, &facts) == 0 && facts.st_size == sizeof(NotesPage);
  if (is_page) use_notes(mapped_page(file));
  if (file >= 0) ::close(file);
  if (!is_page || notes_page().magic != NotesPage::k_magic)
    throw Error(path, "", "holds no notes of this program's calls", ExitCode::internal);
  g_joined_notes = path;
  keep_output_apart();
  watch_for_crashes();
}

NotesPage& share_notes() {
  if (g_are_notes_shared) return notes_page();
  g_notes_file = memory_file();
  if (g_notes_file < 0 || ::ftruncate(g_notes_file, sizeof(NotesPage)) != 0)
    throw Error("memory", "", errno_text("no notes could be shared"), ExitCode::internal);
  use_notes(mapped_page(g_notes_file));
  begin_notes(notes_page());
  g_are_notes_shared = true;
  return notes_page();
}

void close_notes_file(const std::string& path) {
  g_joined_notes = path;
  if (g_notes_file >= 0) ::close(g_notes_file);
  g_notes_file = -1;
}

void watch_for_crashes() {
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP})
    if (const auto before = std::signal(number, on_crash); before != SIG_DFL) std::signal(number, before);
}

}  // namespace clusterbench::os
