#include "cli/completion/completion.h"

namespace clusterbench::cli {

// Inside quotes fish reads '\'' differently from bash and zsh. An apostrophe that ends the quotes, is escaped and
// begins them again is read by all three.
std::string shell_word(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string first_sentence(const std::string& text) {
  return text.substr(0, text.find_first_of(";\n"));
}

}  // namespace clusterbench::cli
