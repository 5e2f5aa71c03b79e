#include "dump/dump_file.h"

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/memory.h"
#include "core/text.h"
#include "dump/list_keys.h"
#include "result/allowed_values.h"

namespace clusterbench::dump {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t k_most_json_bytes = std::uint64_t{64} << 20;

// Why it cannot be read; empty: it is a file, which has a size.
std::string problem_of(const fs::path& path) {
  std::error_code failed;
  if (fs::is_directory(path, failed)) return "is a folder, not a file";
  if (!fs::exists(path, failed))
    return fs::is_symlink(path, failed) ? "is a link that leads nowhere" : "does not exist";
  return fs::is_regular_file(path, failed) ? "" : "is no file of a known size";
}

// Throws Error unless it is a file, which has a size.
std::uint64_t checked_size(const fs::path& path) {
  if (const std::string problem = problem_of(path); !problem.empty()) throw Error(path.string(), "", problem);
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  if (failed) throw Error(path.string(), "", "cannot be read: " + failed.message());
  return size;
}

// A buffer's part of its file, known to be there.
struct FilePart {
  fs::path path;
  std::uint64_t at = 0, bytes = 0;
};

FilePart part_of(const DumpFile& dump, const std::string& name, const result::DumpBuffer& given) {
  const std::string pointer = "/buffers/" + name;
  if (given.file.empty() || given.file.find('\0') != std::string::npos)
    throw Error(dump.path.string(), pointer + "/file",
                std::string(given.file.empty() ? "is empty" : "has a character 0 in it") +
                    "; allowed: the name of a file, relative to the folder of the dump");
  const fs::path path = dump.beside(given.file);
  if (const std::string problem = problem_of(path); !problem.empty())
    throw Error(dump.path.string(), pointer + "/file", "names " + path.string() + ", which " + problem);
  const std::uint64_t size = checked_size(path), at = given.at.value_or(0);
  if (at > size)
    throw Error(dump.path.string(), pointer + "/at",
                "is " + std::to_string(at) + "; " + given.file + " has " + number_of(size, "byte"));
  const std::uint64_t bytes = given.bytes.value_or(size - at);
  if (bytes > size - at)
    throw Error(dump.path.string(), pointer + "/bytes",
                "is " + std::to_string(bytes) + " from byte " + std::to_string(at) + " on; " + given.file + " has " +
                    number_of(size, "byte"));
  return {path, at, bytes};
}

layout::Buffer read_part(const std::string& name, const FilePart& part) {
  layout::Buffer buffer{name, part.path.string(), part.at};
  buffer.bytes.resize(part.bytes);
  std::ifstream in(part.path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(part.at));
  in.read(reinterpret_cast<char*>(buffer.bytes.data()), static_cast<std::streamsize>(part.bytes));
  if (!in && part.bytes > 0) throw Error(part.path.string(), "", "cannot be read");
  return buffer;
}

// All of them are known to fit into the memory before the first is read.
std::vector<layout::Buffer> read_buffers(const DumpFile& dump) {
  std::vector<std::pair<std::string, FilePart>> parts;
  std::uint64_t sum = 0;
  for (const auto& [name, given] : *dump.record.buffers) {
    const FilePart part = part_of(dump, name, given);
    if (part.bytes > memory_limit() - std::min(sum, memory_limit()))
      throw Error(dump.path.string(), "/buffers/" + name,
                  "has " + std::to_string(part.bytes) + " bytes: with it the buffers take more than " +
                      std::to_string(memory_limit() >> 20) + " MiB; name the part that is needed (at, bytes)");
    sum += part.bytes;
    parts.emplace_back(name, part);
  }
  std::vector<layout::Buffer> out;
  for (const auto& [name, part] : parts) out.push_back(read_part(name, part));
  return out;
}

}  // namespace

result::Dump parse_dump(std::string_view text, const std::string& file) {
  const auto json = read_json<result::Json>(text, file, JsonComments::allowed);
  if (!json.is_object() || !json.contains("dump_version"))
    throw Error(file, "/dump_version", "is missing: this is no dump (see `clusterbench schema dump`)");
  try {
    if (json["dump_version"] != 1)
      throw Error("", "/dump_version", "is " + json["dump_version"].dump() + "; this version reads 1");
    auto dump = result::from_json<result::Dump>(json);
    result::check_values(dump);
    for (std::size_t i = 0; i < dump.lists.size(); ++i) check_list_keys(dump.lists[i], "/lists/" + std::to_string(i));
    return dump;
  } catch (const Error& error) {
    throw Error(file, error.where(), error.message(), error.code());
  }
}

namespace {

// A JSON file that is no dump. One that is none at all may be a dump whose writer died: it is refused when it is read.
bool is_other_json(const fs::path& file) {
  std::error_code none;
  if (fs::file_size(file, none) > k_most_json_bytes) return false;
  try {
    const auto json = read_json<result::Json>(file_text(file), file.string(), JsonComments::allowed);
    return !json.is_object() || !json.contains("dump_version");
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<std::string> files_of(const fs::path& path) {
  std::vector<std::string> files{path.string()};
  if (checked_size(path) > k_most_json_bytes) return files;
  const DumpFile dump{path, parse_dump(file_text(path), path.string()), {}};
  if (dump.record.buffers)
    for (const auto& [_, buffer] : *dump.record.buffers) files.push_back(dump.beside(buffer.file).string());
  if (dump.record.camera.scene) files.push_back(dump.beside(*dump.record.camera.scene).string());
  return files;
}

DumpFile read_dump(const fs::path& path) {
  if (const std::uint64_t size = checked_size(path); size > k_most_json_bytes)
    throw Error(path.string(), "",
                "has " + std::to_string(size) + " bytes; a dump's JSON has at most " +
                    std::to_string(k_most_json_bytes) + ": write lists and lights as buffers");
  DumpFile dump{path, parse_dump(file_text(path), path.string()), {}};
  if (dump.record.buffers) dump.buffers = read_buffers(dump);
  return dump;
}

std::vector<fs::path> dump_paths(const fs::path& path) {
  std::error_code failed;
  if (!fs::is_directory(path, failed)) return {path};
  std::vector<fs::path> found;
  std::error_code none;
  // Hidden ones are an editor's: its lock links to nothing. What else cannot be read is refused when it is read.
  for (const fs::directory_entry& entry : fs::directory_iterator(path, failed))
    if (entry.path().extension() == ".json" && !entry.is_directory(none) &&
        (entry.is_regular_file(none) || !entry.path().filename().string().starts_with('.')))
      found.push_back(entry.path());
  if (failed) throw Error(path.string(), "", "cannot be read: " + failed.message());
  std::erase_if(found, is_other_json);
  std::ranges::sort(found);
  if (found.empty())
    throw Error(path.string(), "",
                "has no dump in it: no .json file with a dump_version (folders within it are not read)");
  return found;
}

std::vector<ListSet> list_sets(const result::Dump& dump) {
  std::vector<ListSet> sets;
  for (std::size_t i = 0; i < dump.lists.size(); ++i) {
    const std::string name = dump.lists[i].set.value_or("lists");
    auto set = std::ranges::find(sets, name, &ListSet::name);
    if (set == sets.end()) set = sets.insert(sets.end(), {name, {}});
    set->parts.push_back({dump.lists[i], "/lists/" + std::to_string(i)});
  }
  return sets;
}

}  // namespace clusterbench::dump
