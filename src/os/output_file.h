#pragma once
// The only way in which a file is written. Whoever reads it sees the old bytes or all of the new ones: they are written
// to a new file beside it, made exclusively, which takes its name once all is on the disk. A failure or a signal leaves
// the old file as it was and nothing beside it. Where the name is a symbolic link, the file that it leads to is
// replaced, and the link stays. Mode, and as far as may be the owner, stay those of the old file.
//
// A pipe, a device or an open descriptor of this process (/dev/stdout, /dev/fd/3) cannot be replaced and takes the
// bytes directly.

#include <filesystem>
#include <string_view>

#include "core/error.h"

namespace clusterbench::os {

// What a name leads to when it is written.
struct OutputTarget {
  std::filesystem::path path;  // no link, except below /proc
  bool is_stream = false;      // a pipe, a device or a descriptor
  int descriptor = -1;         // of this process
};

// Follows links, also to what is not there. Throws Error for a circle of links.
OutputTarget output_target(const std::filesystem::path& name);

// Throws Error if the folder that is to hold the file is not there.
void require_folder_of(const std::filesystem::path& name);

// By errno: no room, or a failing disk, is `internal`; what a person can change by another name is `usage`.
ExitCode code_of_failed_write(int error);

// All functions throw Error.
class OutputFile {
 public:
  // Refuses a folder, a missing folder and a file that must not be written. A pipe is opened, which waits some seconds
  // for a program that reads it, and stays open.
  explicit OutputFile(const std::filesystem::path& name);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Whether write() can succeed, before minutes go into measuring: makes the new file and removes it. A device gets a
  // space, which JSON ignores.
  void probe();
  void write(std::string_view text);

 private:
  void open_stream();
  void replace(std::string_view text) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path name_;
  OutputTarget target_;
  int stream_ = -1;
};

void write_file(const std::filesystem::path& name, std::string_view text);

// Makes an empty file of the first of the names PATH.1, PATH.2 ... that is free, also of links and folders. Returns it.
std::filesystem::path reserve_name(const std::filesystem::path& path);

}  // namespace clusterbench::os
