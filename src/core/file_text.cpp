#include "core/file_text.h"

#include <fstream>
#include <iterator>

#include "core/error.h"

namespace clusterbench {

std::string file_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw Error(path.string(), "", "is a folder, not a file");
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in || in.bad()) throw Error(path.string(), "", errno_text("cannot be read"));
  return text;
}

bool is_stream_name(const std::filesystem::path& path) {
  const std::string name = path.string();
  return name.starts_with("/dev/") || name.starts_with("/proc/");
}

}  // namespace clusterbench
