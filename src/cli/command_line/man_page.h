#pragma once
// The manual page, section 1, in the man macros of roff, generated from the command tree.

#include <string>

#include "cli/command_line/command_tree.h"

namespace clusterbench::cli {

std::string man_page(const CommandNode& root, const std::string& version);

}  // namespace clusterbench::cli
