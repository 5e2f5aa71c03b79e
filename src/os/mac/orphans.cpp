// A process of macOS does not take over those that its children leave behind: only its own are found.

#include "os/orphans.h"

#include <libproc.h>
#include <mach/mach.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

namespace clusterbench::os {

std::vector<int> child_processes() {
  std::vector<int> children(1024);
  const int found = ::proc_listchildpids(::getpid(), children.data(), static_cast<int>(children.size() * sizeof(int)));
  children.resize(static_cast<std::size_t>(std::clamp(found, 0, 1024)));
  std::ranges::sort(children);
  return children;
}

int thread_count() {
  thread_act_array_t threads = nullptr;
  mach_msg_type_number_t count = 0;
  if (::task_threads(::mach_task_self(), &threads, &count) != KERN_SUCCESS) return 1;
  for (mach_msg_type_number_t i = 0; i < count; ++i) ::mach_port_deallocate(::mach_task_self(), threads[i]);
  ::vm_deallocate(::mach_task_self(), reinterpret_cast<vm_address_t>(threads), count * sizeof(thread_t));
  return static_cast<int>(count);
}

int runnable_threads() {
  return 0;
}

Orphans::Orphans() : others_(child_processes()) {}

int Orphans::end_all() const {
  int running = 0;
  for (const int child : child_processes()) {
    if (std::ranges::binary_search(others_, child) || ::waitpid(child, nullptr, WNOHANG) == child) continue;
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ++running;
  }
  return running;
}

}  // namespace clusterbench::os
