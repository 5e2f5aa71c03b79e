#include "os/call_notes.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.h"
#include "os/kept_files.h"
#include "os/notes_page.h"
#include "os/process_memory.h"

namespace clusterbench::os {
namespace {

// Notes belong to the process, as its signals do. Those without a guard are shared with copies of this process alone.
NotesPage g_first_page{};
NotesPage* g_page = &g_first_page;
bool g_is_guarded = false;

constexpr auto k_relaxed = std::memory_order_relaxed;

thread_local ThreadNotes* t_notes = nullptr;
thread_local std::uint64_t t_label = 0;

// A free place, or that of a process that has ended. If there are more threads than places, some share the last one.
ThreadNotes& claimed_notes() {
  for (ThreadNotes& notes : g_page->threads) {
    int owner = notes.process.load();
    if (owner != 0 && is_running(owner)) continue;
    if (!notes.process.compare_exchange_strong(owner, own_process())) continue;
    notes.begun = notes.ended = 0;
    notes.resident_before = 0;
    notes.setting.set("");
    return notes;
  }
  return g_page->threads.back();
}

ThreadNotes& thread_notes() {
  if (t_notes == nullptr) t_notes = &claimed_notes();
  return *t_notes;
}

// Before the first call, which loads a plug-in, there is one thread.
void prepare_for_copies() {
  static const bool is_prepared = [] {
    is_forked_copy();
    NotesPage* page = g_is_guarded ? nullptr : page_for_copies();
    if (page == nullptr) return true;
    std::memcpy(static_cast<void*>(page), static_cast<const void*>(g_page), sizeof(NotesPage));
    g_page = page;
    g_page->lost_descriptor = -1;
    g_page->is_file_changed = false;
    return true;
  }();
  static_cast<void>(is_prepared);
}

}  // namespace

const char* name_of(CallStep step) {
  constexpr const char* k_names[] = {"load", "create", "build", "assign", "query", "destroy", "unload"};
  const auto index = static_cast<std::size_t>(step);
  return index < std::size(k_names) ? k_names[index] : "?";
}

ForeignCall::ForeignCall(const Caller& caller, CallStep step, int frame) : caller_(caller), step_(step), frame_(frame) {
  prepare_for_copies();
  ThreadNotes& notes = thread_notes();
  if (step == CallStep::destroy) {
    label_before_ = notes.label;
    code_before_ = notes.code;
    step_before_ = notes.step;
    frame_before_ = notes.frame;
  }
  if (step == CallStep::create)
    g_page->has_made[std::min<std::size_t>(caller.code, NotesPage::k_codes - 1)].store(true, k_relaxed);
  notes.code.store(caller.code, k_relaxed);
  notes.label.store(caller.label, k_relaxed);
  notes.step.store(static_cast<std::uint32_t>(step), k_relaxed);
  notes.frame.store(frame, k_relaxed);
  if (notes.resident_before.load(k_relaxed) == 0) notes.resident_before = resident_bytes(own_process());
  g_page->last_thread.store(static_cast<int>(&notes - g_page->threads.data()), k_relaxed);
  g_page->has_called.store(true, k_relaxed);
  notes.begun.store(notes.begun.load(k_relaxed) + 1, std::memory_order_release);
}

// The notes of this thread are those of the other process, which goes on with them.
void ForeignCall::note_fork() const {
  g_page->forked_code = caller_.code;
  g_page->forked_label = caller_.label;
  g_page->forked_step = static_cast<std::uint32_t>(step_);
  g_page->forked_frame = frame_;
  g_page->has_forked = true;
}

ForeignCall::~ForeignCall() {
  if (is_forked_copy()) {
    note_fork();
    std::_Exit(static_cast<int>(ExitCode::internal));
  }
  ThreadNotes& notes = thread_notes();
  notes.ended.store(notes.ended.load(k_relaxed) + 1, std::memory_order_release);
  if (notes.step.load(k_relaxed) != static_cast<std::uint32_t>(CallStep::destroy)) return;
  notes.label = label_before_;
  notes.code = code_before_;
  notes.step = step_before_;
  notes.frame = frame_before_;
}

void note_frame(int frame) {
  if (t_notes != nullptr) t_notes->frame = frame;
}

std::uint32_t note_code(std::string_view name) {
  const std::uint32_t known = std::min<std::uint32_t>(g_page->codes, NotesPage::k_codes - 1);
  for (std::uint32_t index = 0; index < known; ++index)
    if (g_page->names[index].text() == name) return index;
  const std::uint32_t index = std::min<std::uint32_t>(g_page->codes.fetch_add(1), NotesPage::k_codes - 1);
  g_page->names[index].set(index + 1 < NotesPage::k_codes ? name : "one of more than 32 plug-ins");
  return index;
}

std::vector<std::string> codes_that_made() {
  std::vector<std::string> names;
  for (std::size_t code = 0; code < NotesPage::k_codes; ++code)
    if (g_page->has_made[code]) names.push_back(g_page->names[code].text());
  return names;
}

void note_group(std::string_view case_id) {
  g_page->group.set(case_id);
}

void note_pass(std::string_view name) {
  g_page->pass.set(name);
}

void note_label(std::uint64_t label) {
  t_label = label;
}

std::uint64_t noted_label() {
  return t_label;
}

void note_setting(std::string_view text) {
  thread_notes().setting.set(text);
}

LastCall last_call() {
  const auto index = static_cast<std::size_t>(g_page->last_thread.load());
  if (!g_page->has_called || index >= g_page->threads.size()) return {};
  const ThreadNotes& notes = g_page->threads[index];
  return {static_cast<CallStep>(notes.step.load()), notes.label, notes.frame, g_page->pass.text()};
}

bool is_guarded() {
  return g_is_guarded;
}

void end_with_call(int wait_status) {
  if (!is_guarded()) return;
  if (!std::ranges::any_of(g_page->threads, &ThreadNotes::is_running)) return;
  g_page->child_status = wait_status;
  g_page->has_child_status = true;
  std::_Exit(static_cast<int>(ExitCode::internal));
}

void end_as_ended_thread() {
  g_page->has_ended_thread = true;
  note_crash();
  if (!is_guarded()) std::fputs("clusterbench: a plug-in ended the thread that called it (pthread_exit)\n", stderr);
  std::_Exit(static_cast<int>(ExitCode::internal));
}

std::optional<CallStep> forked_step() {
  if (!g_page->has_forked) return {};
  return static_cast<CallStep>(g_page->forked_step.load());
}

std::optional<CallStep> forked_step_of(std::uint32_t code) {
  return g_page->forked_code == code ? forked_step() : std::nullopt;
}

bool has_called() {
  return g_page->has_called;
}

std::string lost_file_text(int descriptor, bool is_changed) {
  return std::string(is_changed ? "wrote to a file of the program, or cut it"
                                : "closed a file of the program, or put another in its place") +
         " (descriptor " + std::to_string(descriptor) + ")";
}

void end_if_files_are_lost() {
  if (is_forked_copy()) return;  // it ends soon
  const LostFile lost = lost_file();
  if (lost.descriptor < 0) return;
  g_page->is_file_changed = lost.is_changed;
  g_page->lost_descriptor = lost.descriptor;
  note_crash();
  if (!is_guarded())
    std::fprintf(stderr, "clusterbench: a plug-in %s\n", lost_file_text(lost.descriptor, lost.is_changed).c_str());
  std::_Exit(static_cast<int>(is_guarded() ? ExitCode::internal : ExitCode::gate_failed));
}

NotesPage& notes_page() {
  return *g_page;
}

void use_notes(NotesPage& page) {
  g_page = &page;
  g_is_guarded = true;
  t_notes = nullptr;
}

void begin_notes(NotesPage& page) {
  page.magic = NotesPage::k_magic;
  clear_notes(page);
}

void note_crash() {
  if (t_notes != nullptr && t_notes->is_running())
    g_page->crashed_thread = static_cast<int>(t_notes - g_page->threads.data());
}

void clear_notes(NotesPage& page) {
  page.state = GuardState::working;
  page.exit_code = 0;
  page.crashed_thread = -1;
  page.has_called = false;
  page.has_ended_thread = false;
  page.lost_descriptor = -1;
  page.is_file_changed = false;
  page.has_forked = false;
  page.has_child_status = false;
  page.codes = 0;
  for (std::atomic<bool>& made : page.has_made) made = false;
  page.group.set("");
  page.pass.set("");
  for (ThreadNotes& notes : page.threads) notes.process = 0;
  for (ThreadNotes& notes : page.threads) notes.begun = notes.ended = 0;
}

}  // namespace clusterbench::os
