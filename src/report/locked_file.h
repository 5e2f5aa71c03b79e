#pragma once
// A file for one writer at a time.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace clusterbench::report {

// Locked with flock, so that the end of the process, however it comes, gives it free. All functions throw Error.
class LockedFile {
 public:
  // Opens it, or makes an empty one. An Error if another process holds it.
  explicit LockedFile(std::filesystem::path path);
  ~LockedFile();
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string text() const;
  void append(std::string_view text);
  void cut_to(std::size_t bytes);
  // An Error if the disk has no room for so many bytes more.
  void check_room(std::uint64_t bytes) const;
  // Leaves the text in a file of that name, and goes on with an empty file.
  void move_text_to(const std::filesystem::path& other);
  void remove();

 private:
  void open(int more_flags);
  void close();
  // Another process can have removed or moved it between open() and lock.
  bool is_still_at_path() const;
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace clusterbench::report
