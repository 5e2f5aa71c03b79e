#include "os/standard_streams.h"

#include <fcntl.h>
#include <io.h>

#include <array>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <streambuf>
#include <utility>

#include "core/error.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {
namespace {

// Descriptors belong to the process.
int g_output = 1;

// Text that goes to a descriptor.
class DescriptorText final : public std::streambuf {
 public:
  explicit DescriptorText(int descriptor) : descriptor_(descriptor) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
  }

 protected:
  int_type overflow(int_type one) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(one, traits_type::eof())) sputc(traits_type::to_char_type(one));
    return traits_type::not_eof(one);
  }
  int sync() override {
    if (!is_written_to(descriptor_, {pbase(), static_cast<std::size_t>(pptr() - pbase())})) return -1;
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return 0;
  }

 private:
  int descriptor_;
  std::array<char, 1 << 14> buffer_{};
};

// A console belongs to all programs in it: at the end it is as it was.
struct ConsoleState {
  UINT code_page = 0;
  DWORD modes[2]{};
};
ConsoleState g_console_before;
constexpr DWORD k_printed[] = {STD_OUTPUT_HANDLE, STD_ERROR_HANDLE};

void restore_console() {
  for (std::size_t i = 0; i < std::size(k_printed); ++i)
    if (g_console_before.modes[i] != 0) ::SetConsoleMode(::GetStdHandle(k_printed[i]), g_console_before.modes[i]);
  if (g_console_before.code_page != 0) ::SetConsoleOutputCP(g_console_before.code_page);
}

// From here on a console shows UTF-8 and obeys escape sequences.
void set_up_console() {
  bool is_console = false;
  for (std::size_t i = 0; i < std::size(k_printed); ++i) {
    const HANDLE handle = ::GetStdHandle(k_printed[i]);
    if (::GetConsoleMode(handle, &g_console_before.modes[i]) == 0) continue;
    is_console = true;
    ::SetConsoleMode(handle, g_console_before.modes[i] | ENABLE_PROCESSED_OUTPUT | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
  }
  if (!is_console) return;
  g_console_before.code_page = ::GetConsoleOutputCP();
  ::SetConsoleOutputCP(CP_UTF8);
  std::atexit(restore_console);
}

}  // namespace

void keep_output_apart() {
  if (g_output != 1) return;
  std::cout << std::flush;
  std::fflush(stdout);
  const int kept = ::_dup(1);
  if (kept < 0) throw Error("", "standard output", errno_text("cannot be kept"), ExitCode::internal);
  static DescriptorText& text = *new DescriptorText(kept);  // std::cout is flushed after all else has ended
  ::_dup2(2, 1);
  std::cout.rdbuf(&text);
  g_output = kept;
}

int output_descriptor() {
  return g_output;
}

// Lines end as on every system: text is written as it is.
void keep_standard_streams() {
  std::setlocale(LC_CTYPE, ".UTF8");  // of narrow names of files, where the C library has it
  for (const auto& [stream, way] : {std::pair{0, _O_WRONLY}, {1, _O_RDONLY}, {2, _O_WRONLY}}) {
    if (::_get_osfhandle(stream) < 0) ::_dup2(::_open("NUL", way), stream);
    ::_setmode(stream, _O_BINARY);
  }
  set_up_console();
}

bool is_written_to(int descriptor, std::string_view text) {
  return write_all_to(handle_of(::_get_osfhandle(descriptor)), text);
}

// Windows has no such limit.
void report_size_limits_as_errors() {}

bool is_open_file(int descriptor, const std::string& name) {
  const HANDLE open = handle_of(::_get_osfhandle(descriptor));
  const OwnedHandle named(::CreateFileW(long_path(name).c_str(), 0,
                                        FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, OPEN_EXISTING,
                                        FILE_FLAG_BACKUP_SEMANTICS, nullptr));
  BY_HANDLE_FILE_INFORMATION a{}, b{};
  return ::GetFileType(open) == FILE_TYPE_DISK && named.is_open() && ::GetFileInformationByHandle(open, &a) != 0 &&
         ::GetFileInformationByHandle(named.get(), &b) != 0 && a.dwVolumeSerialNumber == b.dwVolumeSerialNumber &&
         a.nFileIndexHigh == b.nFileIndexHigh && a.nFileIndexLow == b.nFileIndexLow;
}

}  // namespace clusterbench::os
