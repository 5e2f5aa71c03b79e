#include "os/process_memory.h"

#include "os/windows/windows_api.h"

#include <psapi.h>

namespace clusterbench::os {
namespace {

OwnedHandle opened_process(int process) {
  return OwnedHandle(
      ::OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION | SYNCHRONIZE, FALSE, static_cast<DWORD>(process)));
}

}  // namespace

int own_process() {
  return static_cast<int>(::GetCurrentProcessId());
}

bool is_running(int process) {
  const OwnedHandle opened = opened_process(process);
  return opened.is_open() && ::WaitForSingleObject(opened.get(), 0) == WAIT_TIMEOUT;
}

std::uint64_t resident_bytes(int process) {
  const OwnedHandle opened = opened_process(process);
  PROCESS_MEMORY_COUNTERS facts{};
  facts.cb = sizeof facts;
  if (!opened.is_open() || ::K32GetProcessMemoryInfo(opened.get(), &facts, sizeof facts) == 0) return 0;
  return facts.WorkingSetSize;
}

}  // namespace clusterbench::os
