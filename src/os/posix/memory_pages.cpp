#include "os/memory_pages.h"

#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <initializer_list>

namespace clusterbench::os {
namespace {

// A signal handler can access only global state.
void (*g_describe_access)(std::uintptr_t) = nullptr;

void on_access(int, siginfo_t* info, void*) {
  g_describe_access(reinterpret_cast<std::uintptr_t>(info->si_addr));
}  // the access is tried again, without this handler

}  // namespace

std::size_t page_bytes() {
  return static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::byte* reserve_pages(std::size_t bytes) {
  void* pages = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return pages == MAP_FAILED ? nullptr : static_cast<std::byte*>(pages);
}

bool allow_writing(std::byte* pages, std::size_t bytes) {
  return ::mprotect(pages, bytes, PROT_READ | PROT_WRITE) == 0;
}

bool allow_reading_alone(std::byte* pages, std::size_t bytes) {
  return ::mprotect(pages, bytes, PROT_READ) == 0;
}

void release_pages(std::byte* pages, std::size_t bytes) {
  ::munmap(pages, bytes);
}

void watch_accesses(void (*describe)(std::uintptr_t address)) {
  g_describe_access = describe;
  struct sigaction action {};
  action.sa_sigaction = on_access;
  action.sa_flags = SA_SIGINFO | SA_RESETHAND;
  for (const int number : {SIGSEGV, SIGBUS}) ::sigaction(number, &action, nullptr);
}

void print_on_error(const char* text, std::size_t bytes) {
  if (::write(STDERR_FILENO, text, bytes) < 0) return;
}

}  // namespace clusterbench::os
