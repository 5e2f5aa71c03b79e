#pragma once
// Errors in an engine's words: arguments of assign.h in place of keys of a configuration.

#include <string>

#include "core/error.h"

namespace clusterbench::library {

std::string short_number(double value);
[[noreturn]] void refuse(const std::string& where, const std::string& problem);

// The argument that a key of a grid is, "slices.near".
std::string grid_argument_of(const std::string& key);
std::string text_for_engines(const Error& error);

}  // namespace clusterbench::library
