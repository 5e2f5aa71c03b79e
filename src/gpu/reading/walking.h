#pragma once
// How the invocations of a subgroup (a wave) walk the lights of their samples.

#include <cstdint>

namespace clusterbench::gpu {

enum class Walking : std::uint8_t {
  by_lane,   // each its own: the wave takes as long as its longest walk
  by_light,  // together, the union of their lights (subgroupMin over lists, subgroupOr over bits)
  by_cell    // together, one cell after the other (readFirstLane)
};

inline const char* name_of(Walking walking) {  // as in configurations and results
  switch (walking) {
    case Walking::by_lane:
      return "lane";
    case Walking::by_light:
      return "light";
    case Walking::by_cell:
      break;
  }
  return "cell";
}

}  // namespace clusterbench::gpu
