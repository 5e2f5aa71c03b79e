#include "os/process_memory.h"

#include <unistd.h>

#include <fstream>
#include <string>

namespace clusterbench::os {

std::uint64_t resident_bytes(int process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/statm");
  std::uint64_t mapped = 0, resident = 0;
  if (!(in >> mapped >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace clusterbench::os
