#include "os/terminal.h"

#include <io.h>

#include <cstdlib>
#include <string_view>

#include "os/standard_streams.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {
namespace {

HANDLE console_of(StandardStream stream) {
  const int descriptors[] = {0, output_descriptor(), 2};
  return handle_of(::_get_osfhandle(descriptors[static_cast<int>(stream)]));
}

// Whether the console obeys escape sequences: keep_standard_streams() has asked it to.
bool obeys_sequences(HANDLE console) {
  DWORD mode = 0;
  return ::GetConsoleMode(console, &mode) != 0 && (mode & ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

bool is_dumb() {
  const char* term = std::getenv("TERM");
  return term != nullptr && std::string_view(term) == "dumb";
}

}  // namespace

bool is_terminal(StandardStream stream) {
  DWORD mode = 0;
  return ::GetConsoleMode(console_of(stream), &mode) != 0;
}

Terminal terminal(StandardStream stream) {
  Terminal found;
  const HANDLE console = console_of(stream);
  const char* no_color = std::getenv("NO_COLOR");
  found.interactive = obeys_sequences(console) && !is_dumb();
  found.colour = found.interactive && (no_color == nullptr || *no_color == '\0');
  CONSOLE_SCREEN_BUFFER_INFO size{};
  if (::GetConsoleScreenBufferInfo(console, &size) != 0) found.columns = size.srWindow.Right - size.srWindow.Left + 1;
  return found;
}

}  // namespace clusterbench::os
