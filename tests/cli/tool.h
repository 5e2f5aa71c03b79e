#pragma once
// Runs the real program as a user would.

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/text.h"
#include "places.h"

namespace clusterbench::test {

struct Outcome {
  int code = -1;
  std::string out, err;
};

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A folder that goes when the test ends.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "clusterbench.XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

// `arguments` as a shell in that folder would take them.
inline Outcome tool_in(const std::filesystem::path& working_folder, const std::string& arguments) {
  const Folder folder;
  const std::string command = "cd " + working_folder.string() + " && " + test::program() + " " + arguments + " >" +
                              (folder / "out").string() + " 2>" + (folder / "err").string() + " </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, file_text(folder / "out"), file_text(folder / "err")};
}

inline Outcome tool(const std::string& arguments) {
  return tool_in(".", arguments);
}

// The same with all of its output on one terminal.
inline Outcome tool_on_terminal(const std::string& arguments) {
  const Folder folder;
  const std::string command =
      "script -qec '" + test::program() + " " + arguments + "' /dev/null >" + (folder / "out").string() + " </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, file_text(folder / "out"), ""};
}

// What a run keeps of a finished case.
inline std::string journal_line(const nlohmann::ordered_json& finished) {
  const std::string text = R"({"case":)" + finished.dump();
  return text + R"(,"sha256":")" + sha256_hex(text) + "\"}";
}

inline std::string source_file(const std::string& name) {
  return test::source_dir() + "/" + name;
}

}  // namespace clusterbench::test
