#include "os/temporary_folder.h"

#include <stdlib.h>
#include <unistd.h>

#include "core/error.h"

namespace clusterbench::os {

namespace fs = std::filesystem;

namespace {

constexpr const char* k_advice = "; TMPDIR names a folder for temporary files";

std::string parent_folder() {
  std::error_code failed;
  const fs::path folder = fs::temp_directory_path(failed);
  if (!failed) return folder.string();
  const char* named = std::getenv("TMPDIR");
  throw Error(named == nullptr ? "/tmp" : named, "TMPDIR", "is not a folder" + std::string(k_advice));
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::path(parent_folder()) / "clusterbench.XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw Error(name, "", errno_text("no folder can be made") + k_advice);
  path_ = name;
  owner_ = ::getpid();
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (::getpid() == owner_) fs::remove_all(path_, ignored);
}

}  // namespace clusterbench::os
