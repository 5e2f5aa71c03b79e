#pragma once
// The shaders of a configuration (key `shaders`, flag --shader). Their methods are in the registry before it is read.

#include <string>
#include <vector>

#include "config/schema/json_text.h"

namespace clusterbench::config {

// Adds the methods of the key `shaders` to the registry, and returns their names. What is no list of texts is refused
// where the configuration is read. Throws Error.
std::vector<std::string> add_shaders(const JsonText& text);

// `assigners` with these methods behind the others, unless they are named there.
nlohmann::json with_shaders(nlohmann::json assigners, const std::vector<std::string>& shaders);

// A file of --shader as it is written into a configuration: relative to its folder.
std::string shader_path_for(const std::string& configuration, const std::string& given);

}  // namespace clusterbench::config
