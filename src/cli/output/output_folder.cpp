#include "cli/output/output_folder.h"

#include "core/error.h"
#include "os/file_access.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;

// The folder and those above it that are not there, from the outermost.
std::vector<fs::path> missing_folders(const fs::path& path) {
  std::vector<fs::path> missing;
  std::error_code none;
  for (fs::path at = fs::absolute(path, none).lexically_normal(); !fs::exists(at, none) && at != at.parent_path();
       at = at.parent_path())
    if (at.has_filename()) missing.insert(missing.begin(), at);  // none behind a slash at the end
  return missing;
}

void remove_empty(const std::vector<fs::path>& made) {
  std::error_code none;
  for (auto folder = made.rbegin(); folder != made.rend(); ++folder)
    if (fs::is_directory(*folder, none)) fs::remove(*folder, none);
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& path) : made_(missing_folders(path)) {
  std::error_code failed;
  fs::create_directories(path, failed);
  if (!failed && fs::is_directory(path, failed) && os::is_writable_folder(path)) return;
  const std::string problem = failed                           ? "no folder can be made there: " + failed.message()
                              : fs::is_directory(path, failed) ? errno_text("cannot be written to")
                                                               : "is no folder";
  remove_empty(made_);
  throw Error(path.string(), "", problem);
}

OutputFolder::~OutputFolder() {
  remove_empty(made_);
}

}  // namespace clusterbench::cli
