#pragma once
// A file of configs/presets: one preset as JSON, with optional comments.

#include <string>

#include "config/presets/preset.h"

namespace clusterbench::config {

// Throws Error with `file` and "line:column /pointer" for broken syntax, a missing or unknown key, a value of another
// type, a word that is not allowed, or a name that is not the file's.
Preset read_preset(const std::string& text, const std::string& file);

}  // namespace clusterbench::config
