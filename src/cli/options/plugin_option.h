#pragma once
// --plugin of commands that read no configuration.

#include <string>
#include <vector>

#include "cli/command_line/command.h"

namespace clusterbench::cli {

inline constexpr const char* k_plugin_flag = "--plugin";

void add_plugin_option(Command& command, std::vector<std::string>& plugins);
// Throws Error that names the flag.
void load_plugins(const std::vector<std::string>& plugins);

}  // namespace clusterbench::cli
