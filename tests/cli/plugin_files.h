#pragma once

#include <string>

#include "cli/tool.h"

namespace clusterbench::test {

// A plug-in that the tests build.
inline std::string plugin_file(const std::string& name) {
  return plugin_folder() + "/" + name + ".so";
}

inline bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace clusterbench::test
