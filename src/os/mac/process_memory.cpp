#include "os/process_memory.h"

#include <libproc.h>

namespace clusterbench::os {

std::uint64_t resident_bytes(int process) {
  proc_taskinfo facts{};
  return ::proc_pidinfo(process, PROC_PIDTASKINFO, 0, &facts, sizeof facts) == sizeof facts ? facts.pti_resident_size
                                                                                            : 0;
}

}  // namespace clusterbench::os
