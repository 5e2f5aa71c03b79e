#include <mach-o/fat.h>
#include <mach-o/loader.h>

#include <cstring>

#include "os/shared_library.h"

namespace clusterbench::os {
namespace {

#if defined(__x86_64__)
constexpr cpu_type_t k_cpu = CPU_TYPE_X86_64;
constexpr const char* k_cpu_name = "64-bit x86";
#elif defined(__aarch64__)
constexpr cpu_type_t k_cpu = CPU_TYPE_ARM64;
constexpr const char* k_cpu_name = "64-bit ARM";
#else
#error "a machine that library_file.cpp does not know"
#endif

template <class Header>
bool read_header(std::string_view content, std::size_t at, Header& out) {
  if (at > content.size() || content.size() - at < sizeof out) return false;
  std::memcpy(&out, content.data() + at, sizeof out);
  return true;
}

// A segment that the file promises and does not have.
bool lacks_segments(std::string_view content, const mach_header_64& header) {
  std::size_t at = sizeof header;
  for (std::uint32_t i = 0; i < header.ncmds; ++i) {
    load_command command{};
    if (!read_header(content, at, command) || command.cmdsize < sizeof command) return true;
    segment_command_64 segment{};
    if (command.cmd == LC_SEGMENT_64) {
      if (!read_header(content, at, segment)) return true;
      const bool is_whole = segment.fileoff <= content.size() && segment.filesize <= content.size() - segment.fileoff;
      if (!is_whole) return true;
    }
    at += command.cmdsize;
  }
  return header.ncmds == 0;
}

}  // namespace

// A file for several machines ("fat") is left to dlopen(), which finds the part for this one.
std::string library_obstacle(std::string_view content) {
  std::uint32_t magic = 0;
  if (!read_header(content, 0, magic)) return "is no shared library (Mach-O file)";
  if (magic == FAT_CIGAM || magic == FAT_CIGAM_64) return "";
  if (magic != MH_MAGIC_64) return "is no shared library (Mach-O file)";
  mach_header_64 header{};
  if (!read_header(content, 0, header)) return "is a shared library that was cut off";
  if (header.cputype != k_cpu) return std::string("is made for another machine than this one (") + k_cpu_name + ")";
  if (header.filetype != MH_DYLIB && header.filetype != MH_BUNDLE) return "is a Mach-O file, but no shared library";
  return lacks_segments(content, header) ? "is a shared library that was cut off" : "";
}

}  // namespace clusterbench::os
