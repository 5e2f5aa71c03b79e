#include "core/file_text.h"

#include <fstream>
#include <map>
#include <mutex>

#include "core/error.h"
#include "core/memory.h"

namespace clusterbench {
namespace {

constexpr std::size_t k_block_bytes = std::size_t{1} << 20;

// The next bytes of a file are added to `text`. False at its end.
bool read_block(std::ifstream& in, std::string& text) {
  const std::size_t before = text.size();
  text.resize(before + k_block_bytes);
  in.read(text.data() + before, static_cast<std::streamsize>(k_block_bytes));
  text.resize(before + static_cast<std::size_t>(in.gcount()));
  return text.size() - before == k_block_bytes;
}

// What came through pipes, by name.
struct PipeTexts {
  std::mutex mutex;
  std::map<std::string, std::string> texts;
};

std::string read_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw Error(path.string(), "", "is a folder, not a file");
  const bool is_stream = !std::filesystem::is_regular_file(path, ignored);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path.string(), "", errno_text("cannot be read"));
  std::string text;
  for (bool has_more = true; has_more;) {
    has_more = read_block(in, text);
    if (in.bad()) throw Error(path.string(), "", errno_text("cannot be read"));
    // A device such as /dev/zero never ends.
    if (const std::size_t nul = is_stream ? text.find('\0') : std::string::npos; nul != std::string::npos)
      throw Error(path.string(), "byte " + std::to_string(nul), "is a NUL byte, and only text is read from a stream");
    if (text.size() > memory_limit())
      throw Error(
          path.string(), "",
          "is longer than " + std::to_string(memory_limit() >> 20) + " MiB, the limit on memory (limits.memory_mib)");
  }
  return text;
}

}  // namespace

std::string file_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_fifo(path, ignored)) return read_text(path);
  static PipeTexts pipes;
  const std::lock_guard lock(pipes.mutex);
  const auto known = pipes.texts.find(path.string());
  return known != pipes.texts.end() ? known->second : pipes.texts.emplace(path.string(), read_text(path)).first->second;
}

bool is_stream_name(const std::filesystem::path& path) {
  const std::string name = path.string();
  return name.starts_with("/dev/") || name.starts_with("/proc/");
}

}  // namespace clusterbench
