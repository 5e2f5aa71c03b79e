// Without a guard there is nobody to tell (guarded_process.cpp).

#include "os/kept_files.h"

namespace clusterbench::os {

void keep_file(int) {}
void keep_standard_files() {}
void release_file(int) {}
void keep_file_and_length(int) {}
FileChange::FileChange(int descriptor) : descriptor_(descriptor) {}
FileChange::~FileChange() {
  static_cast<void>(descriptor_);
}
LostFile lost_file() {
  return {};
}

}  // namespace clusterbench::os
