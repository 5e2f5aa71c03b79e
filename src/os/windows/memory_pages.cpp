#include "os/memory_pages.h"

#include <malloc.h>

#include "os/guarded_memory.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {
namespace {

// An exception handler can access only global state.
void (*g_describe_access)(std::uintptr_t) = nullptr;

LONG CALLBACK on_exception(EXCEPTION_POINTERS* exception) {
  const EXCEPTION_RECORD& record = *exception->ExceptionRecord;
  if (record.ExceptionCode == EXCEPTION_ACCESS_VIOLATION && record.NumberParameters >= 2)
    g_describe_access(record.ExceptionInformation[1]);
  return EXCEPTION_CONTINUE_SEARCH;  // which ends the process, as no other handler is here
}

bool has_protection(std::byte* pages, std::size_t bytes, DWORD protection) {
  DWORD before = 0;
  if (::VirtualProtect(pages, bytes, protection, &before) != 0) return true;
  take_last_error();
  return false;
}

}  // namespace

std::size_t page_bytes() {
  SYSTEM_INFO facts{};
  ::GetSystemInfo(&facts);
  return facts.dwPageSize;
}

std::byte* reserve_pages(std::size_t bytes) {
  void* pages = ::VirtualAlloc(nullptr, bytes, MEM_RESERVE | MEM_COMMIT, PAGE_NOACCESS);
  if (pages == nullptr) take_last_error();
  return static_cast<std::byte*>(pages);
}

bool allow_writing(std::byte* pages, std::size_t bytes) {
  return has_protection(pages, bytes, PAGE_READWRITE);
}

bool allow_reading_alone(std::byte* pages, std::size_t bytes) {
  return has_protection(pages, bytes, PAGE_READONLY);
}

void release_pages(std::byte* pages, std::size_t) {
  ::VirtualFree(pages, 0, MEM_RELEASE);
}

// No window asks what is to be done about the crash.
void watch_accesses(void (*describe)(std::uintptr_t address)) {
  g_describe_access = describe;
  ::SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);
  static void* const handler = ::AddVectoredExceptionHandler(1, on_exception);
  static_cast<void>(handler);
}

void print_on_error(const char* text, std::size_t bytes) {
  DWORD put = 0;
  ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), text, static_cast<DWORD>(bytes), &put, nullptr);
}

// Of the C library's heap.
std::size_t heap_in_use() {
  std::size_t bytes = 0;
  _HEAPINFO block{};
  while (::_heapwalk(&block) == _HEAPOK)
    if (block._useflag == _USEDENTRY) bytes += block._size;
  return bytes;
}

}  // namespace clusterbench::os
