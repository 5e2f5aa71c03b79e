#pragma once
// The headers of Windows, without the macros that would replace names of this program.

#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>
#undef near
#undef far
#undef interface

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace clusterbench::os {

// UTF-16 of Windows from UTF-8 of this program, and back. A path keeps its separators.
std::wstring wide(std::string_view utf8);
std::string narrow(std::wstring_view utf16);

// A path for calls that take at most 259 characters otherwise: absolute, and with the prefix \\?\ where it is long.
std::wstring long_path(const std::filesystem::path& path);

// Sets errno to what comes next to the reason of the last call of Windows, so that messages have the same words on
// every system. Keeps the last reason of Windows as it is.
void take_last_error();

// "cannot be loaded: The specified module could not be found": the reason in the words of Windows.
std::string windows_error_text(const std::string& action, DWORD error);

inline HANDLE handle_of(std::intptr_t number) {
  return reinterpret_cast<HANDLE>(number);
}
inline std::intptr_t number_of(HANDLE handle) {
  return reinterpret_cast<std::intptr_t>(handle);
}

// A handle that is closed with its owner.
class OwnedHandle {
 public:
  explicit OwnedHandle(HANDLE handle = INVALID_HANDLE_VALUE) : handle_(handle) {}
  ~OwnedHandle() { close(); }
  OwnedHandle(OwnedHandle&& other) noexcept : handle_(other.release()) {}
  OwnedHandle& operator=(OwnedHandle&& other) noexcept {
    if (this != &other) close();
    if (this != &other) handle_ = other.release();
    return *this;
  }
  OwnedHandle(const OwnedHandle&) = delete;
  OwnedHandle& operator=(const OwnedHandle&) = delete;

  HANDLE get() const { return handle_; }
  bool is_open() const { return handle_ != INVALID_HANDLE_VALUE && handle_ != nullptr; }
  HANDLE release() {
    const HANDLE given = handle_;
    handle_ = INVALID_HANDLE_VALUE;
    return given;
  }
  void close() {
    if (is_open()) ::CloseHandle(release());
  }

 private:
  HANDLE handle_;
};

// Writes all bytes where the file's position is. False with errno.
bool write_all_to(HANDLE file, std::string_view bytes);

}  // namespace clusterbench::os
