#pragma once

#include <string>

#include "cli/tool.h"

#include "places.h"

namespace clusterbench::test {

// A configuration of a few small cases on one of the project's own scenes.
inline std::string small_config(const std::string& more = "") {
  return R"({"name": "small", "scenes": [{"path": ")" + source_file("scenes/street.glb") + R"(", "frames": 3}],
    "viewport": [640, 360],
    "grids": [{"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices": {"scheme": "exponential-first", "count": 8, "far": 200}},
              {"kind": "world", "cells": [16, 4, 16]}],
    "assigners": ["aabb", "sphere-refinement", "world-grid"],
    "timing": {"sweep_mib": 4, "rounds": 3, "min_time_ms": 1, "frames": 2})" +
         more + "}";
}

}  // namespace clusterbench::test
