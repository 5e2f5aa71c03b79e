#include "os/kept_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <mutex>

namespace clusterbench::os {
namespace {

struct KeptFile {
  int descriptor = -1;
  dev_t device = 0;
  ino_t number = 0;
  off_t length = -1;  // -1: any

  bool is_there() const;
  bool operator==(const KeptFile&) const = default;
};

// Of the process, as its descriptors are.
std::mutex g_kept_lock;
std::array<KeptFile, 16> g_kept;

KeptFile kept_now(int descriptor) {
  struct stat facts {};
  if (::fstat(descriptor, &facts) != 0) return {};
  return {descriptor, facts.st_dev, facts.st_ino, facts.st_size};
}

bool KeptFile::is_there() const {
  const KeptFile now = kept_now(descriptor);
  return now.descriptor == descriptor && now.device == device && now.number == number;
}

void note_file(int descriptor, bool keeps_length = false) {
  auto* place = std::ranges::find(g_kept, descriptor, &KeptFile::descriptor);
  if (place == g_kept.end()) place = std::ranges::find(g_kept, -1, &KeptFile::descriptor);
  if (place == g_kept.end()) return;
  *place = kept_now(descriptor);
  if (!keeps_length) place->length = -1;
}

// A journal to which something was added can be read again without it.
void cut_back(const KeptFile& kept, const KeptFile& now) {
  if (now.length > kept.length && ::ftruncate(kept.descriptor, kept.length) != 0) return;  // its reader refuses it
}

bool g_has_standard_files = false;

void note_standard_files() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) note_file(stream);
  g_has_standard_files = true;
}

}  // namespace

void keep_file(int descriptor) {
  const std::lock_guard lock(g_kept_lock);
  note_file(descriptor);
}

void keep_file_and_length(int descriptor) {
  const std::lock_guard lock(g_kept_lock);
  note_file(descriptor, true);
}

// So long nobody looks at its length.
FileChange::FileChange(int descriptor) : descriptor_(descriptor) {
  g_kept_lock.lock();
}

FileChange::~FileChange() {
  const auto* kept = std::ranges::find(g_kept, descriptor_, &KeptFile::descriptor);
  if (kept != g_kept.end() && kept->length >= 0 && kept->is_there()) note_file(descriptor_, true);
  g_kept_lock.unlock();
}

void keep_standard_files() {
  const std::lock_guard lock(g_kept_lock);
  note_standard_files();
}

void release_file(int descriptor) {
  const std::lock_guard lock(g_kept_lock);
  for (KeptFile& one : g_kept)
    if (one.descriptor == descriptor) one = {};
}

LostFile lost_file() {
  const std::lock_guard lock(g_kept_lock);
  if (!g_has_standard_files) note_standard_files();
  for (const KeptFile& one : g_kept) {
    if (one.descriptor < 0) continue;
    const KeptFile now = kept_now(one.descriptor);
    if (now.descriptor != one.descriptor || now.device != one.device || now.number != one.number)
      return {one.descriptor, false};
    if (one.length < 0 || now.length == one.length) continue;
    cut_back(one, now);
    return {one.descriptor, true};
  }
  return {};
}

}  // namespace clusterbench::os
