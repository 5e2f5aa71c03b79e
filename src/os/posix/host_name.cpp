#include "os/host_name.h"

#include <sys/utsname.h>

namespace clusterbench::os {

std::string host_name() {
  utsname name{};
  return ::uname(&name) == 0 ? name.nodename : "";
}

}  // namespace clusterbench::os
