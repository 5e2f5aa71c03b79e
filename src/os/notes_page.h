#pragma once
// The memory behind call_notes.h, which processes share: plain bytes and lock-free numbers. A reader trusts none of
// them: foreign code can have written there.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

#include "os/call_notes.h"

namespace clusterbench::os {

// Text in shared memory, cut to its room.
template <std::size_t size>
class NotedText {
 public:
  void set(std::string_view text) {
    const std::size_t length = std::min(text.size(), size - 1);
    std::copy_n(text.data(), length, bytes_.data());
    bytes_[length] = '\0';
  }
  std::string text() const {
    const auto end = std::find(bytes_.begin(), bytes_.end(), '\0');
    return {bytes_.begin(), end};
  }

 private:
  std::array<char, size> bytes_;
};

// Of one thread.
struct alignas(64) ThreadNotes {
  std::atomic<int> process;                 // its id; 0: the place is free
  std::atomic<std::uint64_t> begun, ended;  // calls; equal where none is running
  std::atomic<std::uint64_t> label;         // of the last call, as the three below
  std::atomic<std::uint32_t> code, step;
  std::atomic<int> frame;
  std::atomic<std::uint64_t>
      resident_before;  // bytes of the process when the thread first created something; 0: not yet
  NotedText<160> setting;

  bool is_running() const { return begun.load() != ended.load(); }
};

// How far a guarded process has come.
enum class GuardState : std::uint32_t { working, measured, done };

struct NotesPage {
  static constexpr std::size_t k_threads = 128, k_codes = 33;
  static constexpr std::uint64_t k_magic = 0x63626e6f74657331;

  std::uint64_t magic;
  std::atomic<GuardState> state;
  std::atomic<int> exit_code;       // once it is done
  std::atomic<int> crashed_thread;  // its index; -1: unknown
  std::atomic<bool> has_child_status;
  std::atomic<int> child_status;
  std::atomic<int> last_thread;  // that began a call
  std::atomic<bool> has_called;
  std::atomic<bool> has_ended_thread;  // foreign code ended the thread that called it
  std::atomic<int> lost_descriptor;    // that foreign code closed, replaced or changed; -1: none
  std::atomic<bool> is_file_changed;   // ... its length
  std::atomic<bool> has_forked;        // a copy of the process has come back from the call below
  std::atomic<std::uint64_t> forked_label;
  std::atomic<std::uint32_t> forked_code, forked_step;
  std::atomic<int> forked_frame;
  std::atomic<std::uint32_t> codes;
  std::array<NotedText<101>, k_codes> names;
  std::array<std::atomic<bool>, k_codes> has_made;  // an object
  NotedText<101> group, pass;
  NotedText<1000> message;  // for the next process of the same guard
  std::array<ThreadNotes, k_threads> threads;
};

// Those that this process writes.
NotesPage& notes_page();
// From here on this process writes these.
void use_notes(NotesPage& page);
// Makes empty ones of fresh memory.
void begin_notes(NotesPage& page);
// For a signal handler: this thread crashes.
void note_crash();
// Fresh memory that copies of this process share with it; null where there are no copies.
NotesPage* page_for_copies();
// Whether this process is a copy that was forked since the first such question, or since note_own_process().
bool is_forked_copy();
// Makes new ones, which processes share that this one forks, and uses them. Throws Error.
NotesPage& share_notes();
// In a copy, which has the memory: foreign code there could cut the file, and whoever reads the memory would die.
// `path`: path_of_notes() of the process that keeps it open.
void close_notes_file(const std::string& path);
// Forgets all but the names of codes and the message.
void clear_notes(NotesPage& page);
// Notes the thread that crashes. Signals that others handle stay theirs.
void watch_for_crashes();

}  // namespace clusterbench::os
