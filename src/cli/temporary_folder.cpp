#include "cli/temporary_folder.h"

#include <stdlib.h>

#include <fstream>
#include <iterator>

#include "core/error.h"

namespace clusterbench::cli {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "clusterbench.XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw Error(name, "", "no temporary folder could be made here");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string last_words(const fs::path& file) {
  constexpr std::size_t k_most = 2000;
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.size() > k_most ? "..." + text.substr(text.size() - k_most) : text;
}

}  // namespace clusterbench::cli
