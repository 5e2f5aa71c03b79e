#pragma once
// A file for one writer at a time.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace clusterbench::os {

// Locked with flock, so that the end of the process, however it comes, gives it free. A regular file: through links
// nothing is written. All functions throw Error.
class LockedFile {
 public:
  // What is done while another process holds it: an Error, or it is waited for.
  enum class Held { refuse, wait };

  // Opens it, or makes an empty one, which goes with this object if nothing is put into it.
  explicit LockedFile(std::filesystem::path path, Held held = Held::refuse);
  ~LockedFile();
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string text() const;
  void append(std::string_view text);
  void cut_to(std::size_t bytes);
  // As if it had just been made.
  void empty();
  // An Error if the disk has no room for so many bytes more.
  void check_room(std::uint64_t bytes) const;
  // Leaves the text in a file of the first free name of PATH.1, PATH.2 ..., which it returns, and goes on with an empty
  // file.
  std::filesystem::path move_text_beside();
  // The whole text at once (os/output_file.h). The lock is at an end then.
  void replace(std::string_view text);
  // Other names of the same file: hard links.
  std::uint64_t other_names() const;
  void remove();

 private:
  void open();
  bool has_opened();
  void lock();
  void close();
  // Another process can have removed or moved it between opening and locking.
  bool is_still_at_path() const;
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  Held held_;
  int file_ = -1;
  bool is_made_ = false;
};

}  // namespace clusterbench::os
