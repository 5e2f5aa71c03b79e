#pragma once
// Completion scripts for shells, generated from the command tree. Each is self-contained: completing runs no program.

#include <span>
#include <string>

#include "cli/command_line/command_tree.h"

namespace clusterbench::cli {

std::string bash_completion(const CommandNode& root);
std::string zsh_completion(const CommandNode& root);
std::string fish_completion(const CommandNode& root);

// 'text' for any of the three shells.
std::string shell_word(const std::string& text);

// The first sentence, for the single line that a shell shows.
std::string first_sentence(const std::string& text);

}  // namespace clusterbench::cli
