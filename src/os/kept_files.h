#pragma once
// Open files that this process needs. Foreign code in it can close them, or put others in their place.

namespace clusterbench::os {

// After the 16th nothing is noted.
void keep_file(int descriptor);
// Standard input, output and error as they are now. The first lost_file() does that, too.
void keep_standard_files();
// The same, and its length, which only a FileChange may change.
void keep_file_and_length(int descriptor);
// Before it is closed on purpose.
void release_file(int descriptor);

// A change of a kept file's length by this process, as long as this object lives.
class FileChange {
 public:
  explicit FileChange(int descriptor);
  ~FileChange();
  FileChange(const FileChange&) = delete;
  FileChange& operator=(const FileChange&) = delete;

 private:
  int descriptor_;
};

struct LostFile {
  int descriptor = -1;      // -1: all are as they were
  bool is_changed = false;  // still there, with another length
};
// One that is not what it was. Takes a system call for each. What was written behind a kept length is cut off again.
LostFile lost_file();

}  // namespace clusterbench::os
