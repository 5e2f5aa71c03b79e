#include <cstring>

#include "os/shared_library.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {
namespace {

#if defined(__x86_64__) || defined(_M_X64)
constexpr WORD k_machine = IMAGE_FILE_MACHINE_AMD64;
constexpr const char* k_machine_name = "64-bit x86";
#elif defined(__aarch64__) || defined(_M_ARM64)
constexpr WORD k_machine = IMAGE_FILE_MACHINE_ARM64;
constexpr const char* k_machine_name = "64-bit ARM";
#else
#error "a machine that library_file.cpp does not know"
#endif

template <class Header>
bool read_at(std::string_view content, std::size_t at, Header& out) {
  if (at > content.size() || content.size() - at < sizeof out) return false;
  std::memcpy(&out, content.data() + at, sizeof out);
  return true;
}

struct PeHeaders {
  DWORD signature;
  IMAGE_FILE_HEADER file;
};

// A section that the file promises and does not have.
bool is_cut_off(std::string_view content, const PeHeaders& headers, std::size_t headers_at) {
  const std::size_t first = headers_at + sizeof headers + headers.file.SizeOfOptionalHeader;
  for (std::size_t i = 0; i < headers.file.NumberOfSections; ++i) {
    IMAGE_SECTION_HEADER section{};
    if (!read_at(content, first + i * sizeof section, section)) return true;
    const bool is_whole = section.PointerToRawData <= content.size() &&
                          section.SizeOfRawData <= content.size() - section.PointerToRawData;
    if (section.SizeOfRawData > 0 && !is_whole) return true;
  }
  return headers.file.NumberOfSections == 0;
}

}  // namespace

std::string library_obstacle(std::string_view content) {
  if (!content.starts_with("MZ")) return "is no shared library (DLL)";
  IMAGE_DOS_HEADER dos{};
  PeHeaders headers{};
  if (!read_at(content, 0, dos) || dos.e_lfanew < 0) return "is a shared library that was cut off";
  const auto at = static_cast<std::size_t>(dos.e_lfanew);
  if (!read_at(content, at, headers)) return "is a shared library that was cut off";
  if (headers.signature != IMAGE_NT_SIGNATURE) return "is no shared library (DLL)";
  if (headers.file.Machine != k_machine)
    return std::string("is made for another machine than this one (") + k_machine_name + ")";
  if ((headers.file.Characteristics & IMAGE_FILE_DLL) == 0) return "is a program, but no shared library";
  return is_cut_off(content, headers, at) ? "is a shared library that was cut off" : "";
}

}  // namespace clusterbench::os
