#pragma once
// A file of configs/presets: one preset as JSON, with comments where one likes.

#include <string>

#include "config/presets.h"

namespace clusterbench::config {

// Throws Error with `file` and "line:column /pointer" for broken syntax, a key that is missing or not known, a value of
// another type, a word that is none of those allowed, and for a name that is not the file's.
Preset read_preset(const std::string& text, const std::string& file);

}  // namespace clusterbench::config
