#pragma once

#include <string>

#include "config/config.h"

namespace clusterbench::config::testing {

// A configuration of a scene; `rest`: further members, each after a comma.
inline Config parsed(const std::string& rest) {
  return parse_config(R"({"scenes": ["a.glb"])" + rest + "}", "configs/c.json");
}

}  // namespace clusterbench::config::testing
