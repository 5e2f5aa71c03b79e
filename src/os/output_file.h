#pragma once
// The only way in which a file is written. Readers see either the old bytes or all of the new ones: the new ones are
// written to a new file beside it, which gets the name when all is on the disk. Where the file system can do that, it
// has no name before; else it is created exclusively. A failure or a signal leaves the old file as it was and no other
// file. If the name is a symbolic link, its target is replaced, and
// the link stays. Mode and, if possible, owner of the old file are kept.
//
// A pipe, a device or an open descriptor of this process (/dev/stdout, /dev/fd/3) cannot be replaced and is written
// directly.

#include <filesystem>
#include <string_view>

#include "core/error.h"

namespace clusterbench::os {

// The target of a name for writing.
struct OutputTarget {
  std::filesystem::path path;  // no link, except below /proc
  bool is_stream = false;      // a pipe, a device or a descriptor
  int descriptor = -1;         // of this process
};

// Follows links, also dangling ones. Throws Error for a circle of links.
OutputTarget output_target(const std::filesystem::path& name);

// Throws Error if the folder for the file does not exist.
void require_folder_of(const std::filesystem::path& name);

// By errno: no room, too many open files, or a failing disk, is `internal`; an error that another name avoids is
// `usage`.
ExitCode code_of_failed_write(int error);

// All functions throw Error.
class OutputFile {
 public:
  // Rejects a folder, a missing folder and a file without write permission. A pipe is opened, which waits some seconds
  // for its reader, and stays open.
  explicit OutputFile(const std::filesystem::path& name);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Checks that write() can succeed, before minutes of measuring: creates the new file and removes it. A device gets a
  // space, which JSON ignores.
  void probe();
  void write(std::string_view text);

 private:
  void open_stream();
  void replace(std::string_view text) const;
  [[noreturn]] void fail(const std::string& action) const;

  std::filesystem::path name_;
  OutputTarget target_;
  int stream_ = -1;
};

void write_file(const std::filesystem::path& name, std::string_view text);

// Creates an empty file with the first of the names PATH.1, PATH.2 ... that no file, link or folder has. Returns it.
std::filesystem::path reserve_name(const std::filesystem::path& path);

}  // namespace clusterbench::os
