#include "os/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "os/standard_streams.h"

namespace clusterbench::os {
namespace {

int descriptor_of(StandardStream stream) {
  const int descriptors[] = {STDIN_FILENO, output_descriptor(), STDERR_FILENO};
  return descriptors[static_cast<int>(stream)];
}

}  // namespace

bool is_terminal(StandardStream stream) {
  return isatty(descriptor_of(stream)) != 0;
}

Terminal terminal(StandardStream stream) {
  Terminal found;
  const char* term = std::getenv("TERM");
  const bool dumb = term == nullptr || std::string_view(term) == "dumb";
  const char* no_color = std::getenv("NO_COLOR");
  found.interactive = is_terminal(stream) && !dumb;
  found.colour = found.interactive && (no_color == nullptr || *no_color == '\0');
  winsize size{};
  if (ioctl(descriptor_of(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) found.columns = size.ws_col;
  return found;
}

}  // namespace clusterbench::os
