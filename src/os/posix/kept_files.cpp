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

  bool operator==(const KeptFile&) const = default;
};

// Of the process, as its descriptors are.
std::mutex g_kept_lock;
std::array<KeptFile, 16> g_kept;

KeptFile kept_now(int descriptor) {
  struct stat facts {};
  if (::fstat(descriptor, &facts) != 0) return {};
  return {descriptor, facts.st_dev, facts.st_ino};
}

void note_file(int descriptor) {
  const auto is_same = [&](const KeptFile& one) { return one.descriptor == descriptor; };
  auto place = std::ranges::find_if(g_kept, is_same);
  if (place == g_kept.end()) place = std::ranges::find(g_kept, -1, &KeptFile::descriptor);
  if (place != g_kept.end()) *place = kept_now(descriptor);
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

void keep_standard_files() {
  const std::lock_guard lock(g_kept_lock);
  note_standard_files();
}

void release_file(int descriptor) {
  const std::lock_guard lock(g_kept_lock);
  for (KeptFile& one : g_kept)
    if (one.descriptor == descriptor) one = {};
}

int lost_file() {
  const std::lock_guard lock(g_kept_lock);
  if (!g_has_standard_files) note_standard_files();
  for (const KeptFile& one : g_kept)
    if (one.descriptor >= 0 && kept_now(one.descriptor) != one) return one.descriptor;
  return -1;
}

}  // namespace clusterbench::os
