#include <elf.h>

#include <cstring>

#include "os/shared_library.h"

namespace clusterbench::os {
namespace {

#if defined(__x86_64__)
constexpr Elf64_Half k_machine = EM_X86_64;
constexpr const char* k_machine_name = "64-bit x86";
#elif defined(__aarch64__)
constexpr Elf64_Half k_machine = EM_AARCH64;
constexpr const char* k_machine_name = "64-bit ARM";
#else
#error "a machine that shared_library.cpp does not know"
#endif

template <class Header>
bool read_at(std::string_view content, std::size_t at, Header& out) {
  if (at > content.size() || content.size() - at < sizeof out) return false;
  std::memcpy(&out, content.data() + at, sizeof out);
  return true;
}

// A part that the file promises and does not have: its pages would be mapped, and the first access would end this
// process.
bool is_cut_off(std::string_view content, const Elf64_Ehdr& header) {
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr part;
    if (header.e_phentsize != sizeof part || !read_at(content, header.e_phoff + i * sizeof part, part)) return true;
    const bool is_whole = part.p_offset <= content.size() && part.p_filesz <= content.size() - part.p_offset;
    if (part.p_type == PT_LOAD && !is_whole) return true;
  }
  return header.e_phnum == 0;
}

}  // namespace

std::string library_obstacle(std::string_view content) {
  if (!content.starts_with(ELFMAG)) return "is no shared library (ELF file)";
  Elf64_Ehdr header;
  if (!read_at(content, 0, header)) return "is a shared library that was cut off";
  if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_machine != k_machine)
    return std::string("is made for another machine than this one (") + k_machine_name + ")";
  if (header.e_type != ET_DYN) return "is an ELF file, but no shared library";
  return is_cut_off(content, header) ? "is a shared library that was cut off" : "";
}

}  // namespace clusterbench::os
