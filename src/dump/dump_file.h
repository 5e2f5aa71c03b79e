#pragma once
// A dump from disk: its JSON, checked, and its buffers.

#include <filesystem>
#include <string>
#include <vector>

#include "layout/decode.h"
#include "result/documents/dump.h"

namespace clusterbench::dump {

struct DumpFile {
  std::filesystem::path path;
  result::Dump record;
  std::vector<layout::Buffer> buffers;

  std::string name() const { return record.name.value_or(path.stem().string()); }
  // A file that the dump names, relative to its folder.
  std::filesystem::path beside(const std::string& name) const { return path.parent_path() / name; }
};

// The JSON has at most 64 MiB, and all buffers together at most the limit on memory. Throws Error (file, JSON pointer
// or byte).
DumpFile read_dump(const std::filesystem::path& path);
// For text from anywhere: the dump without its buffers.
result::Dump parse_dump(std::string_view text, const std::string& file);

// The dump, and the files that it names.
std::vector<std::string> files_of(const std::filesystem::path& path);

// A file itself; of a folder all files *.json, by name, but those with other JSON. Throws Error for a folder without
// any.
std::vector<std::filesystem::path> dump_paths(const std::filesystem::path& path);

// Lists of a dump that are judged together.
struct ListSet {
  std::string name;
  std::vector<layout::ListPart> parts;
};
std::vector<ListSet> list_sets(const result::Dump& dump);

}  // namespace clusterbench::dump
