#include "os/own_output.h"

#include <io.h>

#include <cstdio>

#include "core/error.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {

// Windows has no limit on the size of files.
OwnOutput::OwnOutput() : descriptor_(::_dup(1)) {
  if (descriptor_ < 0) throw Error("", "standard output", errno_text("cannot be kept"));
  std::fflush(stdout);
  ::_dup2(2, 1);
}

OwnOutput::~OwnOutput() {
  ::_close(descriptor_);
}

void OwnOutput::write_line(const std::string& line) const {
  write_all_to(handle_of(::_get_osfhandle(descriptor_)), line + "\n");
}

}  // namespace clusterbench::os
