#pragma once
// Dumps of engines with all but camera, file names and numbers of lights filled in: files of configs/dumps, embedded.

#include <span>
#include <string_view>

namespace clusterbench::dump {

struct DumpTemplate {
  std::string_view name;
  std::string_view text;  // with comments
};
// By name.
std::span<const DumpTemplate> dump_templates();

}  // namespace clusterbench::dump
