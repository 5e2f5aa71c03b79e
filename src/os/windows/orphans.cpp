// Jobs end all processes that one of this program starts (process.cpp).

#include "os/orphans.h"

#include "os/windows/windows_api.h"

#include <tlhelp32.h>

namespace clusterbench::os {

std::vector<int> child_processes() {
  return {};
}

int thread_count() {
  const OwnedHandle all(::CreateToolhelp32Snapshot(TH32CS_SNAPTHREAD, 0));
  THREADENTRY32 one{};
  one.dwSize = sizeof one;
  int count = 0;
  for (BOOL is_there = ::Thread32First(all.get(), &one); is_there != 0; is_there = ::Thread32Next(all.get(), &one))
    if (one.th32OwnerProcessID == ::GetCurrentProcessId()) ++count;
  return count;
}

int runnable_threads() {
  return 0;
}

Orphans::Orphans() = default;

int Orphans::end_all() const {
  return 0;
}

}  // namespace clusterbench::os
