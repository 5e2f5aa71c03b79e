#pragma once
// A file for one writer at a time.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"

namespace clusterbench::os {

// Another process holds the file.
class FileHeld : public Error {
 public:
  using Error::Error;
};

// Locked with flock, on Windows with LockFileEx, so that any end of the process releases it; on disks that have no
// locks (some network disks), by a file PATH.lock, which a killed process leaves behind. A regular file: nothing is
// written through links. All functions throw Error.
class LockedFile {
 public:
  // The behaviour if another process holds it: throw FileHeld, or wait.
  enum class Held { refuse, wait };

  // Opens the file, or creates an empty one, which is removed with this object if nothing is written to it.
  explicit LockedFile(std::filesystem::path path, Held held = Held::refuse);
  ~LockedFile();
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string text() const;
  void append(std::string_view text);
  void cut_to(std::size_t bytes);
  // Restores the state of a new file.
  void empty();
  // Throws Error if the disk has no room for this many more bytes here and so many in another file of the folder, or if
  // no file may have so many.
  void check_room(std::uint64_t bytes, std::uint64_t beside) const;
  // Moves the text to a file with the first free name of PATH.1, PATH.2 ..., which it returns, and continues with an
  // empty file.
  std::filesystem::path move_text_beside();
  // Replaces the whole text at once (os/output_file.h). This ends the lock.
  void replace(std::string_view text);
  // Other names of the same file: hard links.
  std::uint64_t other_names() const;
  void remove();

 private:
  struct LockOwner;
  static LockOwner owner_of(const std::filesystem::path& beside);
  void lock_beside();
  [[noreturn]] void refuse_locked(const std::filesystem::path& beside, const LockOwner& owner);
  std::filesystem::path lock_path() const;
  void open();
  bool has_opened();
  void lock();
  void close();
  // Another process can have removed or moved it between opening and locking.
  bool is_still_at_path() const;
  [[noreturn]] void fail(const std::string& action) const;

  std::filesystem::path path_;
  Held held_;
  std::intptr_t file_ = -1;  // a descriptor or handle of the system
  bool is_made_ = false, has_lock_beside_ = false;
};

}  // namespace clusterbench::os
