#pragma once
// The abilities of a terminal.

#include <cstdint>

namespace clusterbench::os {

enum class StandardStream : std::uint8_t { input, output, error };

struct Terminal {
  bool interactive = false;  // can redraw a line
  bool colour = false;       // a terminal, and neither NO_COLOR nor TERM=dumb
  int columns = 80;
};
// Of a stream's target; all false if that is no terminal.
Terminal terminal(StandardStream stream);

// Also one with TERM=dumb.
bool is_terminal(StandardStream stream);

}  // namespace clusterbench::os
