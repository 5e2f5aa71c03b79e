// What holds for files of every system.

#include <cerrno>

#include "os/output_file.h"

namespace clusterbench::os {

namespace fs = std::filesystem;

void require_folder_of(const fs::path& name) {
  const OutputTarget target = output_target(name);
  if (target.is_stream) return;
  std::error_code none;
  const fs::path folder = target.path.parent_path();
  if (folder.empty() || fs::is_directory(folder, none)) return;
  throw Error(name.string(), "",
              "cannot be written: " + (fs::exists(folder, none)
                                           ? "'" + folder.string() + "' is no folder"
                                           : "there is no folder '" + folder.string() + "'; make it first (mkdir -p)"));
}

ExitCode code_of_failed_write(int error) {
#ifdef EDQUOT
  if (error == EDQUOT) return ExitCode::internal;
#endif
  for (const int known : {ENOSPC, EFBIG, EIO, EBADF, EPIPE, EMFILE, ENFILE})
    if (error == known) return ExitCode::internal;
  return ExitCode::usage;
}

void write_file(const fs::path& name, std::string_view text) {
  OutputFile(name).write(text);
}

}  // namespace clusterbench::os
